#include "hooke/io/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/obj_corner_data.h"
#include "hooke/io/scanner.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

// A kind of content that is ignored.
struct NotKept {
  std::string kind;
  bool unknown = false;
  bool has_shape = false;  // may describe a shape by vertices, which move
  bool operator==(const NotKept&) const = default;
};

// The coordinates of all elements in the text, one column per element.
struct ObjNumbers {
  Mat3X points, texture, normals;
};

// Kinds of labels that faces have in an OBJ file: keyword and channel.
struct ObjLabel {
  std::string_view keyword;
  const char* channel;
  LabelKind kind;
};
constexpr std::array<ObjLabel, 4> obj_labels = {{{"o", object_channel, LabelKind::group},
                                                 {"g", group_channel, LabelKind::group},
                                                 {"usemtl", material_channel, LabelKind::material},
                                                 {"s", smoothing_channel, LabelKind::group}}};
constexpr size_t smoothing_label = 3;  // its values are numbers, not names

// A statement that labels the faces after it.
struct LabelStatement {
  size_t label;           // index in obj_labels
  size_t face;            // number of faces before it in the piece
  std::string_view name;  // the rest of the line
};

// A piece of the text and the content read from it.
struct ObjReader {
  ObjReader(const Scanner& text, ObjNumbers& all)
      : scanner(text),
        vertices{.kind = "vertex", .values = all.points},
        texture{.kind = "texture coordinate", .values = all.texture, .min_numbers = 1},
        normals{.kind = "normal", .values = all.normals} {}

  Scanner scanner;
  MeshFile part{};
  ObjElements vertices, texture, normals;
  std::vector<NotKept> not_kept{};
  std::vector<LabelStatement> labels{};
  std::vector<std::string> libraries{};
  size_t face_count = 0;
  std::vector<Vec3> colours{};  // of the vertices that have a colour
  bool continued = false;       // whether the coordinates of a vertex stand on several lines
};

void note(std::vector<NotKept>& noted, NotKept content) {
  constexpr size_t named = 10;  // a file of another format would have hundreds
  if (content.unknown && noted.size() >= named) content.kind = "other unknown statements";
  if (std::ranges::find(noted, content) == noted.end()) noted.push_back(std::move(content));
}

void note(ObjReader& obj, const std::string& kind) {
  note(obj.not_kept, {kind});
}

void read_vertex(ObjReader& obj) {
  Scanner& in = obj.scanner;
  count_one(in, obj.vertices);
  double* coordinate = obj.vertices.values.col(obj.vertices.count - 1).data();
  const int line = in.line();
  for (const char* what : {"x", "y", "z"}) *coordinate++ = in.number(what);
  obj.continued |= in.line() != line;
  int extra = 0;
  Vec3 more = Vec3::Ones();
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++extra) {
    const double value = in.number(token, "vertex value");
    if (extra < 3) more[extra] = value;
  }
  if (extra == 1 && more[0] != 1)
    in.fail(fmt::format("vertex weight w is {}; expected 1; rational vertices cannot be read", more[0]));
  if (extra == 2) in.fail("vertex with 5 numbers; expected x y z, x y z w or x y z r g b; correct it");
  if (extra == 3) obj.colours.push_back(more);
  if (extra > 3) note(obj, "vertex colours");
}

int read_corner(ObjReader& obj, std::string_view corner) {
  const Scanner& in = obj.scanner;
  const size_t number = obj.part.polygons.items.size(), first = corner.find('/');
  const int vertex = read_index(in, corner.substr(0, first), corner, obj.vertices);
  if (first == corner.npos) return vertex;
  const std::string_view rest = corner.substr(first + 1);
  const size_t second = rest.find('/');
  const std::string_view texture = rest.substr(0, second),
                         normal = second == rest.npos ? "" : rest.substr(second + 1);
  if (!texture.empty()) read_corner_index(in, texture, corner, number, obj.texture);
  if (!normal.empty()) read_corner_index(in, normal, corner, number, obj.normals);
  return vertex;
}

void read_face(ObjReader& obj) {
  Scanner& in = obj.scanner;
  const int line = in.line();
  const size_t before = obj.part.polygons.items.size();
  for (std::string_view token = in.token(); !token.empty(); token = in.token())
    obj.part.polygons.items.push_back(read_corner(obj, token));
  std::vector<int>& corners = obj.part.polygons.items;
  if (corners.size() == before)
    in.fail_at(line, "face with 0 corners; expected 3 or more; correct or remove it");
  while (corners.size() < before + 3) corners.push_back(corners.back());  // a face that uses a vertex twice
  obj.part.lines.push_back(line);
  end_polygon(obj.part);
}

// The rest of the line, without blanks and comments at its end.
std::string_view rest_of_line(Scanner& in) {
  const std::string_view first = in.token();
  const char* end = first.data() + first.size();
  for (std::string_view token = in.token(); !token.empty(); token = in.token())
    end = token.data() + token.size();
  return {first.data(), static_cast<size_t>(end - first.data())};
}

void read_other(ObjReader& obj, std::string_view keyword) {
  static constexpr std::pair<std::string_view, const char*> shapes[] = {
      {"vp", "parameter space vertices"}, {"l", "lines"}, {"p", "points"}};
  for (size_t label = 0; label < obj_labels.size(); ++label)
    if (keyword == obj_labels[label].keyword) {
      obj.labels.push_back({label, obj.part.polygons.first.size() - 1, rest_of_line(obj.scanner)});
      return;
    }
  if (keyword == "mtllib") {
    obj.libraries.emplace_back(rest_of_line(obj.scanner));
    return;
  }
  for (const auto& [word, kind] : shapes)
    if (keyword == word) return note(obj.not_kept, {.kind = kind, .has_shape = true});
  note(obj.not_kept, {.kind = fmt::format("{} statements (line {})", in_quotes(keyword), obj.scanner.line()),
                      .unknown = true,
                      .has_shape = true});
}

void read_statement(ObjReader& obj, std::string_view keyword) {
  if (keyword == "v") {
    read_vertex(obj);
  } else if (keyword == "f" || keyword == "fo") {
    read_face(obj);
  } else if (keyword == "vt") {
    read_numbers(obj.scanner, obj.texture);
  } else if (keyword == "vn") {
    read_numbers(obj.scanner, obj.normals);
  } else {
    read_other(obj, keyword);
  }
}

// Extends the element ids to all corners of the piece (-1 for none), if the text has such elements.
void end_corners(const ObjReader& obj, ObjElements& elements) {
  if (elements.values.cols() > 0) elements.of_corners.resize(obj.part.polygons.items.size(), -1);
}

void read_piece(ObjReader& obj) {
  while (obj.scanner.next_line()) read_statement(obj, obj.scanner.token());
  end_corners(obj, obj.texture);
  end_corners(obj, obj.normals);
  obj.face_count = obj.part.polygons.first.size() - 1;
}

// Keywords of the elements that faces refer to by number, and their indices in TextPiece::rows_of.
constexpr std::array<std::string_view, 3> numbered = {"v", "vt", "vn"};
enum : size_t { of_vertices, of_texture, of_normals };

// Creates a reader per piece, with the element counts of the pieces before it, and allocates the coordinates.
std::vector<ObjReader> start_readers(const std::vector<TextPiece>& pieces, const std::string& name,
                                     ObjNumbers& all) {
  std::vector<ObjReader> readers;
  long long vertices = 0, texture = 0, normals = 0;
  const auto limited = [](long long count) {  // count_one() throws for larger counts
    return static_cast<int>(std::min<long long>(count, std::numeric_limits<int>::max()));
  };
  for (const TextPiece& piece : pieces) {
    ObjReader& reader = readers.emplace_back(piece.scanner, all);
    reader.part.name = name;
    reader.vertices.count = limited(vertices);
    reader.texture.count = limited(texture);
    reader.normals.count = limited(normals);
    vertices += piece.rows_of[of_vertices];
    texture += piece.rows_of[of_texture];
    normals += piece.rows_of[of_normals];
  }
  all = {Mat3X::Zero(3, limited(vertices)), Mat3X::Zero(3, limited(texture)),
         Mat3X::Zero(3, limited(normals))};
  return readers;
}

ObjElementPieces pieces_of(const std::vector<ObjReader>& readers, const ObjElements ObjReader::*kind) {
  ObjElementPieces pieces;
  for (const ObjReader& reader : readers) pieces.push_back(&(reader.*kind));
  return pieces;
}

// Adds the colours to the vertex data of the file if every vertex has one.
void keep_colours(const std::vector<ObjReader>& readers, MeshFile& file, std::vector<std::string>& not_kept) {
  size_t coloured = 0;
  for (const ObjReader& reader : readers) coloured += reader.colours.size();
  if (coloured == 0) return;
  if (std::cmp_less(coloured, file.points.cols())) {
    not_kept.emplace_back("vertex colours");
    return;
  }
  for (size_t k = 0; k < 3; ++k) {
    std::vector<double>& values = file.vertex_data.emplace_back(VertexChannel{colour_names[k]}).values;
    for (const ObjReader& reader : readers)
      for (const Vec3& colour : reader.colours) values.push_back(colour[static_cast<Eigen::Index>(k)]);
  }
}

// The number of a smoothing group; 0 for none, which is written as "off" or 0.
int smoothing_group(std::string_view name) {
  long long number = 0;
  const bool is_number = parse_integer(name, number) == NumberError::none;
  return is_number && number > 0 && number <= std::numeric_limits<int>::max() ? static_cast<int>(number) : 0;
}

// Numbers names from 1 in the order of their first use.
class Names {
 public:
  int number_of(std::string_view name, FaceChannel& channel) {
    const auto [found, is_new] = numbers_.try_emplace(name, static_cast<int>(numbers_.size()) + 1);
    if (is_new) channel.names[found->second] = name;
    return found->second;
  }

 private:
  std::map<std::string_view, int> numbers_;
};

// Adds the labels of the faces to the file: channels for those kinds that the text has.
void keep_labels(const std::vector<ObjReader>& readers, MeshFile& file) {
  const size_t faces = std::ssize(file.polygons.first) - 1;
  for (size_t label = 0; label < obj_labels.size(); ++label) {
    const auto has = [&](const ObjReader& reader) {
      return std::ranges::find(reader.labels, label, &LabelStatement::label) != reader.labels.end();
    };
    if (std::ranges::none_of(readers, has)) continue;
    FaceChannel channel{obj_labels[label].channel, {}, {}, obj_labels[label].kind};
    channel.values.reserve(faces);
    Names names;
    int value = 0;
    size_t before = 0;  // faces in earlier pieces
    for (const ObjReader& reader : readers) {
      for (const LabelStatement& statement : reader.labels) {
        if (statement.label != label) continue;
        channel.values.resize(before + statement.face, value);
        value = label == smoothing_label ? smoothing_group(statement.name)
                                         : names.number_of(statement.name, channel);
      }
      before += reader.face_count;
    }
    channel.values.resize(faces, value);
    if (std::ranges::any_of(channel.values, [](int x) { return x != 0; }))
      file.face_data.push_back(std::move(channel));
  }
}

constexpr CornerDataKind texture_kind = {.channels = texture_names,
                                         .type = NumberType::float64,
                                         .what = "texture coordinates",
                                         .element = "vt",
                                         .seams = "seams",
                                         .code = "texture_seams"};
constexpr CornerDataKind normal_kind = {
    .channels = normal_names,
    .type = NumberType::float32,  // recomputed on output, so single precision suffices
    .what = "normals",
    .element = "vn",
    .seams = "hard edges",
    .code = "hard_edges"};

// The kinds of content that is ignored, in the order of the text.
std::vector<NotKept> all_ignored(const std::vector<ObjReader>& readers) {
  std::vector<NotKept> noted;
  for (const ObjReader& reader : readers)
    for (const NotKept& content : reader.not_kept) note(noted, content);
  return noted;
}

// The whole content of a text. Movable, although its readers refer to the numbers.
struct ObjContent {
  MeshFile file;  // points and polygons
  std::unique_ptr<ObjNumbers> numbers;
  std::vector<ObjReader> readers;
};

ObjContent read_content(std::string_view text, const std::string& name) {
  ObjContent content{{}, std::make_unique<ObjNumbers>(), {}};
  content.file.name = name;
  content.file.format = MeshFormat::obj;
  const std::vector<TextPiece> pieces = remaining_pieces(Scanner(text, name, obj_syntax), numbered);
  std::vector<ObjReader>& readers = content.readers = start_readers(pieces, name, *content.numbers);
  read_pieces(pieces, [&](const TextPiece&, size_t p) { read_piece(readers[p]); });
  for (const auto kind : {&ObjReader::vertices, &ObjReader::texture, &ObjReader::normals})
    check_max_index(name, pieces_of(readers, kind));
  if (content.numbers->points.cols() == 0)
    throw InputError(name + ": no vertices; expected v lines; is this an OBJ file?");
  content.file.points = std::move(content.numbers->points);
  std::vector<MeshFile> parts;
  parts.reserve(readers.size());
  for (ObjReader& reader : readers) parts.push_back(std::move(reader.part));
  append_faces(content.file, parts);
  return content;
}

}  // namespace

MeshFile read_obj(std::string_view text, const std::string& name) {
  ObjContent content = read_content(text, name);
  MeshFile& file = content.file;
  std::vector<std::string> not_kept;
  keep_colours(content.readers, file, not_kept);
  keep_elements(pieces_of(content.readers, &ObjReader::texture), texture_kind, file, file.texture, not_kept);
  keep_elements(pieces_of(content.readers, &ObjReader::normals), normal_kind, file, file.normals, not_kept);
  keep_labels(content.readers, file);
  for (const ObjReader& reader : content.readers)
    file.material_libraries.insert(file.material_libraries.end(), reader.libraries.begin(),
                                   reader.libraries.end());
  std::vector<std::string> shapes;
  for (const NotKept& ignored : all_ignored(content.readers)) {
    if (std::ranges::find(not_kept, ignored.kind) == not_kept.end()) not_kept.push_back(ignored.kind);
    if (ignored.has_shape) shapes.push_back(ignored.kind);
  }
  warn_not_kept(file, not_kept);
  warn_carried_along(file, shapes);
  if (std::ranges::any_of(content.readers, &ObjReader::continued))
    file.misread = "vertices whose lines are continued by '\\'";
  return std::move(file);
}

ObjCorners read_obj_corners(std::string_view text, const std::string& name) {
  ObjContent content = read_content(text, name);
  const auto corners = [&](Mat3X& values, ObjElements ObjReader::*kind) {
    PolygonCorners data{std::move(values)};
    for (const ObjReader& reader : content.readers)
      data.corners.insert(data.corners.end(), (reader.*kind).of_corners.begin(),
                          (reader.*kind).of_corners.end());
    return data;
  };
  return {std::move(content.file.points), std::move(content.file.polygons),
          corners(content.numbers->texture, &ObjReader::texture),
          corners(content.numbers->normals, &ObjReader::normals)};
}

std::string write_obj(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const VertexData& data) {
  const ChannelList texture = channels_named(data, texture_names);
  const ChannelList normals = channels_named(data, normal_names);
  std::vector<const char*> repeats;  // indices of vt and vn, equal to that of the vertex
  if (!texture.empty()) repeats.push_back("/");
  if (!normals.empty()) repeats.push_back(texture.empty() ? "//" : "/");
  std::string text;
  append_vertex_rows(text, points, "v ", channels_named(data, colour_names));
  append_value_rows(text, "vt", texture);
  append_value_rows(text, "vn", normals);
  append_face_rows(text, triangles, "f", 1, repeats);
  return text;
}

namespace {

// The lines of faces with data of faces and corners.
class FaceLines {
 public:
  FaceLines(const std::vector<Triangle>& triangles, const ObjData& data)
      : triangles_(triangles),
        corners_(data.corners),
        texture_of_vertices_(!channels_named(data.vertices, texture_names).empty()),
        normals_of_vertices_(!channels_named(data.vertices, normal_names).empty()) {
    for (size_t label = 0; label < obj_labels.size(); ++label)
      labels_[label] = find_channel(data.faces, obj_labels[label].channel);
  }

  void append_to(std::string& text) {
    for (size_t f = 0; f < triangles_.size(); ++f) {
      append_labels(text, f);
      text += 'f';
      for (size_t k = 0; k < 3; ++k) append_corner(text, f, k);
      text += '\n';
    }
  }

 private:
  void append_labels(std::string& text, size_t face) {
    for (size_t label = 0; label < labels_.size(); ++label) {
      if (!labels_[label]) continue;
      const int value = labels_[label]->values[face];
      if (value == std::exchange(current_[label], value)) continue;
      text += obj_labels[label].keyword;
      append_name(text, label, value);
      text += '\n';
    }
  }

  void append_name(std::string& text, size_t label, int value) const {
    const FaceChannel& channel = *labels_[label];
    text += ' ';
    if (label == smoothing_label)
      text += value == 0 ? "off" : fmt::format("{}", value);
    else if (const auto name = channel.names.find(value); name == channel.names.end())
      text += fmt::format("{}_{}", channel.name, value);
    else if (name->second.empty())
      text.pop_back();
    else
      text += name->second;
  }

  void append_corner(std::string& text, size_t face, size_t k) const {
    const int vertex = triangles_[face][k],
              vt = index_of(corners_.texture, texture_of_vertices_, vertex, face, k),
              vn = index_of(corners_.normals, normals_of_vertices_, vertex, face, k);
    text += ' ';
    append_number(text, vertex + 1);
    if (vt < 0 && vn < 0) return;
    text += '/';
    if (vt >= 0) append_number(text, vt + 1);
    if (vn < 0) return;
    text += '/';
    append_number(text, vn + 1);
  }

  static int index_of(const CornerValues& values, bool of_vertices, int vertex, size_t face, size_t k) {
    return !values.empty() ? values.corners[face][k] : of_vertices ? vertex : -1;
  }

  const std::vector<Triangle>& triangles_;
  const CornerData& corners_;
  bool texture_of_vertices_, normals_of_vertices_;
  std::array<const FaceChannel*, obj_labels.size()> labels_{};
  std::array<int, obj_labels.size()> current_{};
};

void append_values(std::string& text, const char* keyword, const CornerValues& values) {
  for (const auto value : values.values.colwise()) {
    text += keyword;
    for (int k = 0; k < values.width; ++k) {
      text += ' ';
      append_number(text, value[k]);
    }
    text += '\n';
  }
}

}  // namespace

std::string write_obj(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const ObjData& data) {
  const bool has_labels = std::ranges::any_of(
      obj_labels, [&](const ObjLabel& label) { return find_channel(data.faces, label.channel); });
  std::string text;
  for (const std::string& library : data.material_libraries) text += "mtllib " + library + "\n";
  if (!has_labels && data.corners.empty()) return text + write_obj(points, triangles, data.vertices);
  append_vertex_rows(text, points, "v ", channels_named(data.vertices, colour_names));
  if (data.corners.texture.empty())
    append_value_rows(text, "vt", channels_named(data.vertices, texture_names));
  else
    append_values(text, "vt", data.corners.texture);
  if (data.corners.normals.empty())
    append_value_rows(text, "vn", channels_named(data.vertices, normal_names));
  else
    append_values(text, "vn", data.corners.normals);
  FaceLines(triangles, data).append_to(text);
  return text;
}

}  // namespace hooke
