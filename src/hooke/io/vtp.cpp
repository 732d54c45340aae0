#include "hooke/io/vtp.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/scanner.h"
#include "hooke/io/vtk_arrays.h"

namespace hooke {
namespace {

using Attributes = std::map<std::string, std::string>;

std::string value_of(const Attributes& attributes, const std::string& name, const std::string& missing = "") {
  const auto found = attributes.find(name);
  return found == attributes.end() ? missing : found->second;
}

// An element DataArray.
struct Array {
  Attributes attributes;
  std::string text;  // of arrays in place
  int line = 1;      // of the element
};

using Arrays = std::map<std::string, std::optional<Array>>;  // by name

struct Piece {
  long long points = 0, polygons = 0;
  long long cells_before = 0, cells_after = 0;  // the polygons in the data of cells
  int line = 1;
  std::optional<Array> coordinates, connectivity, offsets;
  Arrays point_data, cell_data;
};

// What a file holds.
struct Document {
  VtkEncoding encoding;
  std::vector<Piece> pieces;
  std::vector<std::string> not_kept;
  std::vector<size_t> offsets;    // of all arrays in the appended data
  std::string_view appended;      // after the underscore
  bool appended_is_text = false;  // in base64
};

// Reads the elements by expat, which calls the handlers. As it is written in C, exceptions do not pass
// through it: they are kept until it has returned.
class DocumentReader {
 public:
  DocumentReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), on_start, on_end);
    XML_SetCharacterDataHandler(parser_.get(), on_text);
    XML_SetStartDoctypeDeclHandler(parser_.get(), on_document_type);
  }

  Document read() {
    constexpr size_t chunk = size_t{1} << 24;
    for (size_t at = 0; !done_;) {
      const size_t size = std::min(chunk, bytes_.size() - at);
      const bool last = at + size == bytes_.size();
      const XML_Status status =
          XML_Parse(parser_.get(), bytes_.data() + at, static_cast<int>(size), last ? XML_TRUE : XML_FALSE);
      if (error_) std::rethrow_exception(error_);
      if (status != XML_STATUS_OK && !done_)
        fail(fmt::format("{}; expected well-formed XML; the file is damaged or truncated",
                         XML_ErrorString(XML_GetErrorCode(parser_.get()))));
      at += size;
      if (last) break;
    }
    if (!file_) fail("no element VTKFile; expected one; is this a VTP file?");
    return std::move(document_);
  }

 private:
  static DocumentReader& self(void* data) { return *static_cast<DocumentReader*>(data); }

  template <typename Call>
  void guarded(const Call& call) {
    if (error_ || done_) return;
    try {
      call();
    } catch (...) {
      error_ = std::current_exception();
      XML_StopParser(parser_.get(), XML_FALSE);
    }
  }

  static void XMLCALL on_start(void* data, const char* element, const char** attributes) {
    self(data).guarded([&] {
      Attributes all;
      for (; *attributes; attributes += 2) all[attributes[0]] = attributes[1];
      self(data).start(element, std::move(all));
    });
  }
  static void XMLCALL on_end(void* data, const char*) {
    self(data).guarded([&] { self(data).end(); });
  }
  static void XMLCALL on_text(void* data, const char* text, int size) {
    self(data).guarded([&] { self(data).add(std::string_view(text, size)); });
  }
  static void XMLCALL on_document_type(void* data, const char*, const char*, const char*, int) {
    self(data).guarded([&] { self(data).fail("a document type; expected none in a VTP file; remove it"); });
  }

  int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser_.get())); }

  [[noreturn]] void fail(std::string_view message) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line(), message));
  }

  long long count(const Attributes& attributes, const std::string& name) const {
    const std::string text = value_of(attributes, name, "0");
    long long value = 0;
    if (parse_integer(text, value) != NumberError::none || value < 0)
      fail(fmt::format("{} is {}; expected a number from 0; correct it", name, in_quotes(text)));
    return value;
  }

  const std::string& parent() const { return path_[path_.size() - 2]; }

  void start(const std::string& element, Attributes attributes) {
    path_.push_back(element);
    if (path_.size() == 1 && element != "VTKFile")
      fail(fmt::format("element {}; expected VTKFile; is this a VTP file?", in_quotes(element)));
    if (element == "VTKFile") {
      start_file(attributes);
    } else if (element == "Piece") {
      start_piece(attributes);
    } else if (element == "DataArray" || element == "Array") {
      start_array(std::move(attributes));
    } else if (element == "AppendedData") {
      take_appended(attributes);
    }
  }

  void start_file(const Attributes& attributes) {
    file_ = true;
    const std::string type = value_of(attributes, "type"), compressor = value_of(attributes, "compressor"),
                      order = value_of(attributes, "byte_order", "LittleEndian");
    if (type != "PolyData")
      fail(fmt::format("a file of type {}; expected PolyData; extract its surface in ParaView",
                       in_quotes(type)));
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
      fail(fmt::format("compressor {}; expected vtkZLibDataCompressor or none; save it anew",
                       in_quotes(compressor)));
    document_.encoding = {order == "BigEndian", value_of(attributes, "header_type") == "UInt64",
                          !compressor.empty()};
  }

  void start_piece(const Attributes& attributes) {
    open_ = nullptr;  // it points into the pieces
    Piece& piece = document_.pieces.emplace_back();
    piece.points = count(attributes, "NumberOfPoints");
    piece.polygons = count(attributes, "NumberOfPolys");
    const auto others = [&](const char* name) { return std::min(count(attributes, name), 1LL << 60); };
    piece.cells_before = others("NumberOfVerts") + others("NumberOfLines");
    piece.cells_after = others("NumberOfStrips");
    piece.line = line();
    for (const auto& [attribute, kind] : {std::pair{"NumberOfVerts", "vertex cells"},
                                          {"NumberOfLines", "lines"},
                                          {"NumberOfStrips", "strips of triangles"}})
      if (const long long there = count(attributes, attribute); there > 0)
        note(fmt::format("{} {}", there, kind));
  }

  void note(std::string kind) {
    auto& kinds = document_.not_kept;
    if (std::ranges::find(kinds, kind) == kinds.end()) kinds.push_back(std::move(kind));
  }

  // Where an array is kept; null for those that are not.
  std::optional<Array>* place_of(const std::string& array_name) {
    if (document_.pieces.empty() || path_.size() < 3) return nullptr;
    Piece& piece = document_.pieces.back();
    if (parent() == "Points") return &piece.coordinates;
    if (parent() == "Polys" && array_name == "connectivity") return &piece.connectivity;
    if (parent() == "Polys" && array_name == "offsets") return &piece.offsets;
    if (parent() == "PointData") return &piece.point_data[array_name];
    if (parent() == "CellData") return &piece.cell_data[array_name];
    return nullptr;
  }

  void start_array(Attributes attributes) {
    if (attributes.contains("offset")) document_.offsets.push_back(count(attributes, "offset"));
    std::optional<Array>* place = place_of(value_of(attributes, "Name"));
    if (!place || place->has_value()) return;
    *place = Array{std::move(attributes), "", line()};
    open_ = place;
    depth_of_open_ = path_.size();
  }

  void take_appended(const Attributes& attributes) {
    const size_t index = XML_GetCurrentByteIndex(parser_.get());
    const size_t tag = bytes_.find('>', std::min(index, bytes_.size()));
    const size_t begin = tag == bytes_.npos ? tag : bytes_.find('_', tag);
    if (begin == bytes_.npos)
      fail("appended data without its underscore; expected it; the file is truncated");
    document_.appended = bytes_.substr(begin + 1);
    document_.appended_is_text = value_of(attributes, "encoding") == "base64";
    if (document_.appended_is_text)
      document_.appended = document_.appended.substr(0, document_.appended.find('<'));
    done_ = true;  // what follows may be no XML
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  void end() {
    if (open_ && path_.size() == depth_of_open_) open_ = nullptr;
    path_.pop_back();
  }

  void add(std::string_view text) {
    if (open_ && path_.size() == depth_of_open_) (*open_)->text += text;
  }

  std::string_view bytes_;
  std::string name_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  Document document_;
  std::vector<std::string> path_;         // open elements
  std::optional<Array>* open_ = nullptr;  // the array whose text is read
  size_t depth_of_open_ = 0;
  bool file_ = false, done_ = false;
  std::exception_ptr error_;
};

// The numbers of an array. Messages of errors begin with its line.
class ArrayReader {
 public:
  ArrayReader(const Document& document, const std::string& name) : document_(document), name_(name) {
    offsets_ = document.offsets;
    std::ranges::sort(offsets_);
  }

  std::vector<double> reals(const Array& array) const {
    return numbers<double>(
        array, [](const Scanner& in, std::string_view token) { return in.number(token, "number"); },
        [&](std::string_view content, const std::string& type) {
          return reals_of(content, type, document_.encoding.big_endian);
        });
  }

  std::vector<long long> integers(const Array& array) const {
    return numbers<long long>(
        array, [](const Scanner& in, std::string_view token) { return in.integer(token, "number"); },
        [&](std::string_view content, const std::string& type) {
          return integers_of(content, type, document_.encoding.big_endian);
        });
  }

 private:
  template <typename Number, typename Parse, typename Convert>
  std::vector<Number> numbers(const Array& array, const Parse& parse, const Convert& convert) const {
    const std::string format = value_of(array.attributes, "format", "ascii");
    if (format == "ascii") {
      std::vector<Number> result;
      Scanner in(array.text, name_, {}, array.line);
      while (in.next_line())
        for (std::string_view token = in.token(); !token.empty(); token = in.token())
          result.push_back(parse(in, token));
      return result;
    }
    try {
      return convert(unpack_vtk_array(stored(array, format), document_.encoding),
                     value_of(array.attributes, "type"));
    } catch (const Error& e) {
      throw InputError(fmt::format("{}:{}: {}", name_, array.line, e.what()));
    }
  }

  // The bytes at which a binary array begins.
  std::string stored(const Array& array, const std::string& format) const {
    if (format == "binary") return decode_base64(array.text);
    if (format != "appended")
      throw Error(fmt::format("format {}; expected ascii, binary or appended", in_quotes(format)));
    long long offset = -1;
    if (parse_integer(value_of(array.attributes, "offset"), offset) != NumberError::none || offset < 0 ||
        std::cmp_greater(offset, document_.appended.size()))
      throw Error(fmt::format("offset {} in {} bytes of appended data; expected less; the file is truncated",
                              in_quotes(value_of(array.attributes, "offset")), document_.appended.size()));
    const size_t begin = offset;
    const auto next = std::ranges::upper_bound(offsets_, begin);
    const size_t end =
        next == offsets_.end() ? document_.appended.size() : std::min(*next, document_.appended.size());
    const std::string_view bytes = document_.appended.substr(begin, end - begin);
    return document_.appended_is_text ? decode_base64(bytes) : std::string(bytes);
  }

  const Document& document_;
  std::string name_;
  std::vector<size_t> offsets_;  // ascending
};

[[noreturn]] void fail_at(const std::string& name, int line, const std::string& message) {
  throw InputError(fmt::format("{}:{}: {}", name, line, message));
}

const Array& required(const std::optional<Array>& array, const Piece& piece, const char* what,
                      const std::string& name) {
  if (!array)
    fail_at(name, piece.line, fmt::format("a piece without {}; expected a DataArray of them", what));
  return *array;
}

void add_points(const Piece& piece, const ArrayReader& reader, const std::string& name,
                std::vector<double>& all) {
  const Array& array = required(piece.coordinates, piece, "points", name);
  const std::vector<double> numbers = reader.reals(array);
  if (numbers.size() % 3 != 0 || static_cast<long long>(numbers.size() / 3) != piece.points)
    fail_at(name, array.line,
            fmt::format("{} coordinates; expected 3 of each of {} points; is the file truncated?",
                        numbers.size(), piece.points));
  const auto bad = std::ranges::find_if(numbers, [](double x) { return !std::isfinite(x); });
  if (bad != numbers.end())
    fail_at(name, array.line,
            fmt::format("point {} has a coordinate of {}; expected a finite number; correct it",
                        (bad - numbers.begin()) / 3, *bad));
  all.insert(all.end(), numbers.begin(), numbers.end());
}

void add_polygons(const Piece& piece, const ArrayReader& reader, long long first_point, MeshFile& file) {
  if (piece.polygons == 0) return;
  const Array& array = required(piece.offsets, piece, "offsets of polygons", file.name);
  const std::vector<long long> corners = reader.integers(
                                   required(piece.connectivity, piece, "corners of polygons", file.name)),
                               ends = reader.integers(array);
  if (static_cast<long long>(ends.size()) != piece.polygons)
    fail_at(file.name, array.line,
            fmt::format("{} offsets; expected one of each of {} polygons; is the file truncated?",
                        ends.size(), piece.polygons));
  long long begin = 0;
  for (size_t f = 0; f < ends.size(); ++f) {
    if (ends[f] - begin < 3 || ends[f] > static_cast<long long>(corners.size()))
      fail_at(file.name, array.line,
              fmt::format("polygon {} has corners {} to {} of {}; expected at least 3; correct the offsets",
                          f, begin, ends[f], corners.size()));
    for (; begin < ends[f]; ++begin) {
      const long long id = corners[begin];
      if (id < 0 || id >= piece.points)
        fail_at(
            file.name, piece.connectivity->line,
            fmt::format("polygon {} has point {}; expected 0 to {}; correct it", f, id, piece.points - 1));
      file.polygons.items.push_back(static_cast<int>(first_point + id));
    }
    end_polygon(file);
  }
}

std::optional<NumberType> number_type(const std::string& name) {
  static const std::map<std::string, NumberType> types = {
      {"Int8", NumberType::int8},      {"UInt8", NumberType::uint8},    {"Int16", NumberType::int16},
      {"UInt16", NumberType::uint16},  {"Int32", NumberType::int32},    {"UInt32", NumberType::uint32},
      {"Int64", NumberType::float64},  {"UInt64", NumberType::float64}, {"Float32", NumberType::float32},
      {"Float64", NumberType::float64}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

// A type of cell data that are labels, with its range; numbers of 64 bits are where they fit in 32.
struct LabelType {
  NumberType type;
  long long least, greatest;
};

const std::map<std::string, LabelType>& label_types() {
  constexpr long long least = std::numeric_limits<int>::min(), greatest = std::numeric_limits<int>::max();
  static const std::map<std::string, LabelType> types = {
      {"Int8", {NumberType::int8, -128, 127}},         {"UInt8", {NumberType::uint8, 0, 255}},
      {"Int16", {NumberType::int16, -32768, 32767}},   {"UInt16", {NumberType::uint16, 0, 65535}},
      {"Int32", {NumberType::int32, least, greatest}}, {"UInt32", {NumberType::uint32, 0, 4294967295}},
      {"Int64", {NumberType::int32, least, greatest}}, {"UInt64", {NumberType::int32, 0, greatest}}};
  return types;
}

// The names of the values of a vertex: those of PLY files for normals and texture coordinates, else that of
// the array with a number for each of several.
std::vector<std::string> channel_names(std::string array, size_t width) {
  if (array == "Normals" && width == 3) return {normal_names.begin(), normal_names.end()};
  if (array == "TCoords" && width == 2) return {texture_names[0], texture_names[1]};
  std::ranges::replace_if(
      array, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  static const std::set<std::string> taken = {"x", "y", "z", "vertex_indices", "vertex_index"};  // by PLY
  if (taken.contains(array)) array = "point_" + array;
  if (width == 1) return {array};
  std::vector<std::string> names;
  for (size_t k = 0; k < width; ++k) names.push_back(array + "_" + std::to_string(k));
  return names;
}

// Adds the array of point data that all pieces with points have, with numbers of one type. Returns whether
// that is so.
bool add_point_data(const std::vector<Piece>& pieces, const std::string& array_name,
                    const ArrayReader& reader, MeshFile& file) {
  if (array_name.empty()) return false;
  std::string type, width_text;
  std::vector<double> all;
  for (const Piece& piece : pieces) {
    if (piece.points == 0) continue;
    const auto found = piece.point_data.find(array_name);
    if (found == piece.point_data.end() || !found->second) return false;
    const Array& array = *found->second;
    const std::string own = value_of(array.attributes, "type"),
                      own_width = value_of(array.attributes, "NumberOfComponents", "1");
    if (all.empty()) {
      type = own;
      width_text = own_width;
    }
    long long width = 0;
    if (own != type || own_width != width_text || !number_type(own) ||
        parse_integer(own_width, width) != NumberError::none || width < 1 || width > 16)
      return false;
    const std::vector<double> numbers = reader.reals(array);
    if (static_cast<long long>(numbers.size()) != width * piece.points)
      fail_at(file.name, array.line,
              fmt::format("{} numbers; expected {} of each of {} points; is the file truncated?",
                          numbers.size(), width, piece.points));
    all.insert(all.end(), numbers.begin(), numbers.end());
  }
  if (all.empty()) return false;
  const size_t width = std::stoul(width_text);
  const std::vector<std::string> names = channel_names(array_name, width);
  if (std::ranges::any_of(names, [&](const std::string& n) { return find_channel(file.vertex_data, n); }))
    return false;
  for (size_t k = 0; k < width; ++k) {
    VertexChannel channel{names[k], *number_type(type), {}};
    for (size_t i = k; i < all.size(); i += width) channel.values.push_back(all[i]);
    file.vertex_data.push_back(std::move(channel));
  }
  return true;
}

// Adds the array of cell data that all pieces with polygons have, with an integer of one type for each cell.
// Numbers that differ in all polygons are ids, no labels. Returns whether that is so.
bool add_cell_data(const std::vector<Piece>& pieces, const std::string& array_name, const ArrayReader& reader,
                   MeshFile& file) {
  if (array_name.empty()) return false;
  std::string type;
  FaceChannel channel{channel_names(array_name, 1).front()};
  for (const Piece& piece : pieces) {
    if (piece.points == 0 || piece.polygons == 0) continue;
    const auto found = piece.cell_data.find(array_name);
    if (found == piece.cell_data.end() || !found->second) return false;
    const Array& array = *found->second;
    const std::string own = value_of(array.attributes, "type");
    if (channel.values.empty()) type = own;
    const auto label = label_types().find(own);
    if (own != type || label == label_types().end() ||
        value_of(array.attributes, "NumberOfComponents", "1") != "1")
      return false;
    channel.type = label->second.type;
    const std::vector<double> numbers = reader.reals(array);  // those of 64 bits may not fit in long long
    const long long cells = piece.cells_before + piece.polygons + piece.cells_after;
    if (static_cast<long long>(numbers.size()) != cells)
      fail_at(file.name, array.line,
              fmt::format("{} numbers; expected one of each of {} cells; is the file truncated?",
                          numbers.size(), cells));
    for (long long f = 0; f < piece.polygons; ++f) {
      const double number = numbers[piece.cells_before + f];
      const auto least = static_cast<double>(label->second.least),
                 greatest = static_cast<double>(label->second.greatest);
      if (!(number >= least && number <= greatest) || std::trunc(number) != number) return false;
      channel.values.push_back(static_cast<int>(static_cast<std::uint32_t>(static_cast<long long>(number))));
    }
  }
  if (channel.values.empty() || find_channel(file.face_data, channel.name)) return false;
  const std::set<int> different(channel.values.begin(), channel.values.end());
  if (channel.values.size() > 1 && different.size() == channel.values.size()) channel.kind = LabelKind::other;
  file.face_data.push_back(std::move(channel));
  return true;
}

// Adds the arrays of one kind to the file; those that cannot be added are not kept.
template <typename Add>
void add_arrays(Document& document, Arrays Piece::*kind, const char* what, const Add& add) {
  std::set<std::string> names;
  for (const Piece& piece : document.pieces)
    for (const auto& [name, array] : piece.*kind) names.insert(name);
  for (const std::string& name : names)
    if (!add(name)) document.not_kept.push_back(what + in_quotes(name));
}

}  // namespace

MeshFile read_vtp(std::string_view bytes, const std::string& name) {
  Document document = DocumentReader(bytes, name).read();
  const ArrayReader reader(document, name);
  MeshFile file;
  file.name = name;
  file.format = MeshFormat::vtp;
  std::vector<double> coordinates;
  for (const Piece& piece : document.pieces) {
    if (piece.points == 0) continue;
    const auto first_point = static_cast<long long>(coordinates.size() / 3);
    if (first_point + piece.points > std::numeric_limits<int>::max())
      throw LimitError(name + ": more than 2147483647 points; expected fewer; split the mesh");
    add_points(piece, reader, name, coordinates);
    add_polygons(piece, reader, first_point, file);
  }
  file.points =
      Eigen::Map<const Mat3X>(coordinates.data(), 3, static_cast<Eigen::Index>(coordinates.size() / 3));
  add_arrays(document, &Piece::point_data, "point data ",
             [&](const std::string& array) { return add_point_data(document.pieces, array, reader, file); });
  add_arrays(document, &Piece::cell_data, "cell data ",
             [&](const std::string& array) { return add_cell_data(document.pieces, array, reader, file); });
  warn_not_kept(file, document.not_kept);
  return file;
}

}  // namespace hooke
