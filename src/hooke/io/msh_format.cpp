#include "hooke/io/msh_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/scanner.h"

namespace hooke {
namespace {

// A type of elements. Source of their codes and nodes: C. Geuzaine, J.-F. Remacle, "Gmsh reference manual",
// section "MSH file format".
struct ElementType {
  int code;            // in the file
  int nodes;           // of an element
  const char* plural;  // "triangles"
};

constexpr int quadrangle_code = 3;

constexpr ElementType element_types[] = {
    {15, 1, "points"},
    {1, 2, "lines"},
    {8, 3, "second-order lines"},
    {26, 4, "third-order lines"},
    {27, 5, "fourth-order lines"},
    {28, 6, "fifth-order lines"},
    {triangle_code, 3, "triangles"},
    {9, 6, "second-order triangles"},
    {20, 9, "incomplete third-order triangles"},
    {21, 10, "third-order triangles"},
    {22, 12, "incomplete fourth-order triangles"},
    {23, 15, "fourth-order triangles"},
    {24, 15, "incomplete fifth-order triangles"},
    {25, 21, "fifth-order triangles"},
    {quadrangle_code, 4, "quadrangles"},
    {16, 8, "incomplete second-order quadrangles"},
    {10, 9, "second-order quadrangles"},
    {36, 16, "third-order quadrangles"},
    {4, 4, "tetrahedra"},
    {11, 10, "second-order tetrahedra"},
    {29, 20, "third-order tetrahedra"},
    {30, 35, "fourth-order tetrahedra"},
    {31, 56, "fifth-order tetrahedra"},
    {5, 8, "hexahedra"},
    {17, 20, "incomplete second-order hexahedra"},
    {12, 27, "second-order hexahedra"},
    {92, 64, "third-order hexahedra"},
    {93, 125, "fourth-order hexahedra"},
    {6, 6, "prisms"},
    {18, 15, "incomplete second-order prisms"},
    {13, 18, "second-order prisms"},
    {7, 5, "pyramids"},
    {19, 13, "incomplete second-order pyramids"},
    {14, 14, "second-order pyramids"},
};

// The type with this code; null if there is none.
const ElementType* element_type_of(long long code) {
  for (const ElementType& type : element_types)
    if (type.code == code) return &type;
  return nullptr;
}

// The words and numbers of a file, text or binary.
class MshInput {
 public:
  MshInput(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  bool old = false;  // these three as in MshContent
  bool binary = false;
  bool swapped = false;

  /// The next word of the text; empty at the end of the file.
  std::string_view word() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) step();
    const size_t first = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return bytes_.substr(first, at_ - first);
  }

  /// Where the next word or binary number begins.
  size_t offset() {
    while (!binary && at_ < bytes_.size() && is_space(bytes_[at_])) step();
    return at_;
  }

  /// The rest of this line.
  std::string_view rest_of_line() {
    const size_t first = at_;
    while (at_ < bytes_.size() && !is_line_end(bytes_[at_])) ++at_;
    return bytes_.substr(first, at_ - first);
  }

  /// Goes past the end of this line, to where binary numbers begin.
  void finish_line() {
    rest_of_line();
    if (at_ < bytes_.size()) step();
  }

  void expect(std::string_view keyword) {
    const std::string_view found = word();
    if (found != keyword) fail_instead_of(found, keyword);
  }

  /// Goes past the end of a section of that name that is not read.
  void skip_section(std::string_view name) {
    const std::string end = fmt::format("$End{}", name);
    const size_t found = bytes_.find(end, at_);
    if (found == bytes_.npos) fail(fmt::format("no {} follows; expected it; the file is truncated", end));
    while (at_ < found) step();
    at_ += end.size();
  }

  long long integer(std::string_view what) {
    return binary ? static_cast<long long>(raw<std::int32_t>(what)) : integer_in_text(what);
  }

  /// An integer that has 8 bytes in binary files of version 4.
  long long large(std::string_view what) {
    if (old || !binary) return integer(what);
    const auto value = raw<std::uint64_t>(what);
    if (value > static_cast<std::uint64_t>(std::numeric_limits<long long>::max()))
      fail(fmt::format("{} is {}; expected at most 63 bits; correct the file", what, value));
    return static_cast<long long>(value);
  }

  double real(std::string_view what) {
    double value = 0;
    if (binary) {
      value = raw<double>(what);
      if (std::isfinite(value)) return value;
      fail(fmt::format("{} is {}; expected a finite number; correct it", what, value));
    }
    const std::string_view token = number_word(what);
    if (parse_number(token, value) != NumberError::none)
      fail(fmt::format("{} is {}; expected a finite decimal number up to 1.8e308; correct it", what,
                       in_quotes(token)));
    return value;
  }

  long long count(std::string_view what) {
    const long long value = large(what);
    if (value < 0 || static_cast<unsigned long long>(value) > bytes_.size() - at_)
      fail(fmt::format(
          "{} is {}, but only {} bytes follow; expected as many as there are; the file is truncated or "
          "the count is wrong",
          what, value, bytes_.size() - at_));
    return value;
  }

  /// The integer in the text, also in binary files.
  long long integer_in_text(std::string_view what) {
    const std::string_view token = number_word(what);
    long long value = 0;
    if (parse_integer(token, value) != NumberError::none)
      fail(fmt::format("{} is {}; expected an integer; correct it", what, in_quotes(token)));
    return value;
  }

  int line() const { return line_; }

  [[noreturn]] void fail(std::string_view message) const {
    throw InputError(binary ? fmt::format("{}: byte {}: {}", name_, at_, message)
                            : fmt::format("{}:{}: {}", name_, line_, message));
  }

  [[noreturn]] void fail_instead_of(std::string_view found, std::string_view expected) const {
    if (found.empty()) fail(fmt::format("the file ends; expected {}; it is truncated", expected));
    fail(fmt::format("{}; expected {}; is a count wrong?", in_quotes(found), expected));
  }

 private:
  static bool is_space(char c) { return is_blank(c) || is_line_end(c); }

  void step() {
    const bool ends_line = bytes_[at_] == '\n' || (bytes_[at_] == '\r' && bytes_.substr(at_ + 1, 1) != "\n");
    line_ += ends_line ? 1 : 0;
    ++at_;
  }

  std::string_view number_word(std::string_view what) {
    const std::string_view token = word();
    if (token.empty()) fail(fmt::format("the file ends; expected {}; it is truncated", what));
    return token;
  }

  template <typename T>
  T raw(std::string_view what) {
    if (bytes_.size() - at_ < sizeof(T))
      fail(fmt::format("the file ends; expected {}; it is truncated", what));
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), bytes_.data() + at_, sizeof(T));
    if (swapped) std::ranges::reverse(bytes);
    at_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }

  std::string_view bytes_;
  std::string name_;
  size_t at_ = 0;
  int line_ = 1;
};

// The content with what its numbers mean.
struct MshBuilder : MshContent {
  std::unordered_map<long long, int> index;                 // of each node by its number
  std::vector<long long> corner_numbers;                    // of the nodes of the polygons, end to end
  std::vector<long long> point_numbers;                     // of the nodes of points
  std::vector<std::array<long long, 2>> segment_numbers;    // of those of straight lines
  std::map<long long, std::vector<int>> groups_of_surface;  // by the number of the surface
};

int to_int(const MshInput& in, long long value, std::string_view what) {
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    in.fail(fmt::format("{} is {}; expected 32 bits; renumber it", what, value));
  return static_cast<int>(value);
}

void read_format(MshInput& in) {
  const std::string_view version = in.word();
  in.old = version == "2" || version.starts_with("2.");
  if (!in.old && version != "4.1")
    in.fail(fmt::format(
        "version {} of the format; expected 2.2 or 4.1; save it anew with gmsh -save -format msh41",
        in_quotes(version)));
  const long long type = in.integer_in_text("file type"), size = in.integer_in_text("data size");
  if (type != 0 && type != 1) in.fail(fmt::format("file type {}; expected 0 (text) or 1 (binary)", type));
  if (size != 8) in.fail(fmt::format("data size {}; expected 8; save the file anew", size));
  if (type == 1) {
    in.finish_line();
    in.binary = true;
    const long long one = in.integer("the number 1");
    in.swapped = one == 1 << 24;
    if (one != 1 && !in.swapped) in.fail(fmt::format("{} instead of the number 1; the file is damaged", one));
  }
  in.expect("$EndMeshFormat");
}

void read_names(MshInput& in, MshBuilder& content) {
  const long long count = in.integer_in_text("number of names");
  for (long long k = 0; k < count; ++k) {
    const long long dimension = in.integer_in_text("dimension");
    const int group = to_int(in, in.integer_in_text("physical group"), "physical group");
    const std::string_view rest = in.rest_of_line();
    const size_t first = rest.find('"'), last = rest.rfind('"');
    if (first == last) in.fail(fmt::format("name {}; expected it in quotes; correct it", in_quotes(rest)));
    if (dimension == 2) content.groups.names[group] = std::string(rest.substr(first + 1, last - first - 1));
  }
  in.expect("$EndPhysicalNames");
}

// Reads the coordinates of a node.
void read_node(MshInput& in, MshBuilder& content, long long number) {
  if (!content.index.emplace(number, static_cast<int>(content.nodes.size())).second)
    in.fail(fmt::format("a second node {}; expected different numbers; renumber the nodes", number));
  if (std::cmp_equal(content.nodes.size(), std::numeric_limits<int>::max()))
    throw LimitError("more than 2147483647 nodes; expected fewer; split the mesh");
  content.coordinates.push_back(in.offset());
  const double x = in.real("x"), y = in.real("y"), z = in.real("z");
  content.nodes.emplace_back(x, y, z);
}

void require_type(const MshInput& in, const ElementType* type, long long code) {
  if (!type) in.fail(fmt::format("element type {}; expected one that Gmsh knows; is a count wrong?", code));
}

// Reads the nodes of an element; keeps them if it is a polygon.
void read_element(MshInput& in, const ElementType& type, int group, int entity, MshBuilder& content) {
  const bool polygon = type.code == triangle_code || type.code == quadrangle_code;
  if (!polygon) {
    OtherElements& others = content.other_elements[type.plural];
    others.is_straight = type.nodes <= 2;
    ++others.count;
    std::array<long long, 2> ends{};
    for (int k = 0; k < type.nodes; ++k) {
      const long long number = in.large("node of an element");
      if (others.is_straight) ends[k] = number;
    }
    if (type.nodes == 1) content.point_numbers.push_back(ends[0]);
    if (type.nodes == 2) content.segment_numbers.push_back(ends);
    return;
  }
  for (int k = 0; k < type.nodes; ++k) content.corner_numbers.push_back(in.large("node of an element"));
  content.sizes.push_back(type.nodes);
  if (!in.binary) content.lines.push_back(in.line());
  content.groups.values.push_back(group);
  content.entities.values.push_back(entity);
}

// Sections of version 2.

void read_old_nodes(MshInput& in, MshBuilder& content) {
  const long long count = in.binary ? in.integer_in_text("number of nodes") : in.count("number of nodes");
  if (in.binary) in.finish_line();
  for (long long k = 0; k < count; ++k) {
    const long long number = in.integer("node number");
    read_node(in, content, number);
  }
}

// Reads the tags of an element and then its nodes.
void read_old_element(MshInput& in, const ElementType& type, long long tags, MshBuilder& content) {
  if (tags < 0) in.fail(fmt::format("{} tags; expected 0 or more; correct the element", tags));
  int group = 0, entity = 0;
  for (long long t = 0; t < tags; ++t) {
    const int tag = to_int(in, in.integer("tag of an element"), "tag of an element");
    if (t == 0) group = tag;
    if (t == 1) entity = tag;
  }
  read_element(in, type, group, entity, content);
}

void read_old_elements(MshInput& in, MshBuilder& content) {
  const long long count =
      in.binary ? in.integer_in_text("number of elements") : in.count("number of elements");
  if (in.binary) in.finish_line();
  for (long long k = 0; k < count;) {
    if (!in.binary) in.integer("element number");
    const long long code = in.integer("element type");
    const ElementType* type = element_type_of(code);
    require_type(in, type, code);
    const long long elements = in.binary ? in.integer("number of elements") : 1,
                    tags = in.integer("number of tags");
    if (elements <= 0 || elements > count - k)
      in.fail(fmt::format("{} elements; expected 1 to {}; is a count wrong?", elements, count - k));
    for (long long e = 0; e < elements; ++e) {
      if (in.binary) in.integer("element number");
      read_old_element(in, *type, tags, content);
    }
    k += elements;
  }
}

// Sections of version 4.1.

void read_entities(MshInput& in, MshBuilder& content) {
  std::array<long long, 4> counts;
  for (long long& count : counts) count = in.count("number of entities");
  for (size_t dimension = 0; dimension < 4; ++dimension)
    for (long long k = 0; k < counts[dimension]; ++k) {
      const long long tag = in.integer("entity");
      for (int b = 0; b < (dimension == 0 ? 3 : 6); ++b) in.real("bound of an entity");
      const long long groups = in.count("number of physical groups");
      for (long long g = 0; g < groups; ++g) {
        const int group = to_int(in, in.integer("physical group"), "physical group");
        if (dimension == 2) content.groups_of_surface[tag].push_back(group);
      }
      if (dimension == 0) continue;
      const long long boundaries = in.count("number of bounding entities");
      for (long long b = 0; b < boundaries; ++b) in.integer("bounding entity");
    }
}

void read_nodes(MshInput& in, MshBuilder& content) {
  const long long blocks = in.count("number of node blocks");
  const long long total = in.count("number of nodes");
  in.large("smallest node number");
  in.large("largest node number");
  long long found = 0;
  std::vector<long long> numbers;
  for (long long b = 0; b < blocks; ++b) {
    const long long dimension = in.integer("dimension of an entity");
    in.integer("entity");
    const bool parametric = in.integer("parametric") != 0;
    content.has_parameters |= parametric;
    const long long count = in.count("number of nodes");
    if (dimension < 0 || dimension > 3) in.fail(fmt::format("dimension {}; expected 0 to 3", dimension));
    numbers.clear();
    for (long long k = 0; k < count; ++k) numbers.push_back(in.large("node number"));
    for (const long long number : numbers) {
      read_node(in, content, number);
      for (long long p = 0; parametric && p < dimension; ++p) in.real("parameter of a node");
    }
    found += count;
  }
  if (found != total)
    in.fail(fmt::format("{} nodes in blocks; expected {} by the count; correct it", found, total));
}

void read_elements(MshInput& in, MshBuilder& content) {
  const long long blocks = in.count("number of element blocks");
  const long long total = in.count("number of elements");
  in.large("smallest element number");
  in.large("largest element number");
  long long found = 0;
  for (long long b = 0; b < blocks; ++b) {
    const long long dimension = in.integer("dimension of an entity");
    const int entity = to_int(in, in.integer("entity"), "entity");
    const long long code = in.integer("element type");
    const ElementType* type = element_type_of(code);
    require_type(in, type, code);
    const long long count = in.count("number of elements");
    const auto groups = content.groups_of_surface.find(entity);
    const bool grouped = dimension == 2 && groups != content.groups_of_surface.end();
    const size_t before = content.sizes.size();
    for (long long k = 0; k < count; ++k) {
      in.large("element number");
      read_element(in, *type, grouped ? groups->second.front() : 0, entity, content);
    }
    if (grouped && groups->second.size() > 1)
      content.in_several_groups += static_cast<long long>(content.sizes.size() - before);
    found += count;
  }
  if (found != total)
    in.fail(fmt::format("{} elements in blocks; expected {} by the count; correct it", found, total));
}

// Reads one section after its name. Returns false if it is none that is read.
bool read_section(MshInput& in, std::string_view name, MshBuilder& content) {
  const bool own_count_in_text = in.old;  // then the binary numbers begin after the line of the count
  if (name != "Nodes" && name != "Elements" && (name != "Entities" || in.old)) return false;
  if (in.binary && !own_count_in_text) in.finish_line();
  if (name == "Entities")
    read_entities(in, content);
  else if (name == "Nodes")
    in.old ? read_old_nodes(in, content) : read_nodes(in, content);
  else
    in.old ? read_old_elements(in, content) : read_elements(in, content);
  in.expect(fmt::format("$End{}", name));
  return true;
}

void read_sections(MshInput& in, MshBuilder& content) {
  bool format = false;
  for (std::string_view word = in.word(); !word.empty(); word = in.word()) {
    if (!format && !word.starts_with('$'))
      in.fail(fmt::format(
          "{}; expected $MeshFormat first, as in a file of Gmsh; others name other formats .msh too, "
          "as FreeFem does: convert these",
          in_quotes(word)));
    if (!word.starts_with('$') || word.starts_with("$End"))
      in.fail(fmt::format("{}; expected a section such as $Nodes; is a count wrong?", in_quotes(word)));
    const std::string_view name = word.substr(1);
    if (name == "MeshFormat") {
      read_format(in);
      format = true;
    } else if (name == "Comments") {
      in.skip_section(name);
    } else if (!format) {
      in.fail(fmt::format("{}; expected $MeshFormat first; is this a file of Gmsh?", in_quotes(word)));
    } else if (name == "PhysicalNames") {
      read_names(in, content);
    } else if (!read_section(in, name, content)) {
      in.skip_section(name);
      if (std::ranges::find(content.other_sections, word) == content.other_sections.end())
        content.other_sections.emplace_back(word);
    }
  }
}

// Finds the nodes of the polygons by their numbers.
void find_corners(const std::string& name, MshBuilder& content) {
  content.vertex.assign(content.nodes.size(), -1);
  content.corners.reserve(content.corner_numbers.size());
  for (size_t f = 0; f < content.sizes.size(); ++f)
    for (int k = 0; k < content.sizes[f]; ++k) {
      const long long number = content.corner_numbers[content.corners.size()];
      const auto found = content.index.find(number);
      if (found == content.index.end()) {
        const std::string where = content.lines.empty() ? "" : fmt::format(":{}", content.lines[f]);
        throw InputError(fmt::format("{}{}: polygon {} has node {}; expected one of $Nodes; correct it", name,
                                     where, f, number));
      }
      content.corners.push_back(found->second);
      content.vertex[found->second] = 0;
    }
  int used = 0;
  for (int& v : content.vertex)
    if (v == 0) v = used++;
  for (const long long number : content.point_numbers)
    if (const auto found = content.index.find(number); found != content.index.end())
      content.points.push_back(found->second);
  for (const auto& [from, to] : content.segment_numbers)
    if (const auto a = content.index.find(from), b = content.index.find(to);
        a != content.index.end() && b != content.index.end())
      content.segments.push_back({a->second, b->second});
}

}  // namespace

MshContent read_msh_content(std::string_view bytes, const std::string& name) {
  MshInput in(bytes, name);
  MshBuilder content;
  read_sections(in, content);
  find_corners(name, content);
  content.old = in.old;
  content.binary = in.binary;
  content.swapped = in.swapped;
  return content;
}

}  // namespace hooke
