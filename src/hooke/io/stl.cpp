#include "hooke/io/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/geometry/triangle.h"
#include "hooke/io/scanner.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL files are little-endian");

constexpr size_t header_size = 80, start_of_facets = 84, facet_size = 50;

// Numbers different points in the order in which they are first met.
class PointNumbers {
 public:
  explicit PointNumbers(size_t expected) : slots_(std::bit_ceil(expected + 16), -1) {}

  int operator()(const Vec3& point) {
    if (2 * (points_.size() + 1) > slots_.size()) grow();
    int& slot = slot_of(point);
    if (slot < 0) {
      slot = static_cast<int>(points_.size());
      points_.push_back(point);
    }
    return slot;
  }

  const std::vector<Vec3>& points() const { return points_; }

 private:
  static std::uint64_t mixed(std::uint64_t x) {  // the finalizer of splitmix64
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  int& slot_of(const Vec3& point) {
    std::uint64_t hash = 0;
    for (const double x : point)
      hash = mixed(hash + std::bit_cast<std::uint64_t>(x + 0.) + 1);  // -0 + 0 is 0
    for (size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1))
      if (slots_[i] < 0 || points_[slots_[i]] == point) return slots_[i];
  }

  void grow() {
    slots_.assign(2 * slots_.size(), -1);
    for (size_t p = 0; p < points_.size(); ++p) slot_of(points_[p]) = static_cast<int>(p);
  }

  std::vector<Vec3> points_;
  std::vector<int> slots_;  // as many as a power of two, at most half of them taken
};

void add_facet(MeshFile& file, PointNumbers& numbers, const std::array<Vec3, 3>& corners) {
  for (const Vec3& corner : corners) file.polygons.items.push_back(numbers(corner));
  end_polygon(file);
}

void take_points(MeshFile& file, const PointNumbers& numbers) {
  file.points.resize(3, static_cast<Eigen::Index>(numbers.points().size()));
  for (Eigen::Index v = 0; v < file.points.cols(); ++v) file.points.col(v) = numbers.points()[v];
  file.notes.push_back({"corners_welded", file.polygons.items.size(),
                        fmt::format("{}: {} corners of facets are {} different points, its vertices",
                                    file.name, file.polygons.items.size(), file.points.cols())});
}

// Text. Line ends are blanks, but for the names of solids.

class StlText {
 public:
  StlText(std::string_view text, const std::string& name) : in_(text, name, {}) {}

  /// The next word; empty at the end of the text.
  std::string_view word() {
    std::string_view token = in_.token();
    while (token.empty() && in_.next_line()) token = in_.token();
    return token;
  }

  /// The rest of this line without the blanks around it.
  std::string rest_of_line() {
    std::string_view line = in_.rest().substr(0, in_.rest().find_first_of("\r\n"));
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    while (!in_.token().empty()) continue;
    return std::string(line);
  }

  void expect(std::string_view keyword) { require(word(), keyword); }

  void require(std::string_view found, std::string_view keyword) const {
    if (!equal_ignoring_case(found, keyword)) fail_instead_of(found, keyword);
  }

  [[noreturn]] void fail_instead_of(std::string_view found, std::string_view expected) const {
    if (found.empty()) in_.fail(fmt::format("the file ends; expected {}; it is truncated", expected));
    in_.fail(fmt::format("{}; expected {}; correct the file, or export it anew", in_quotes(found), expected));
  }

  double number(std::string_view what) {
    const std::string_view token = word();
    if (token.empty()) fail_instead_of(token, what);
    return in_.number(token, what);
  }

  int line() const { return in_.line(); }

 private:
  Scanner in_;
};

// Whether the bytes begin with a solid in text: its line, and then a facet or the end of the solid.
bool is_text(std::string_view bytes, const std::string& name) {
  StlText in(bytes, name);
  if (!equal_ignoring_case(in.word(), "solid")) return false;
  in.rest_of_line();
  const std::string_view next = in.word();
  return next.empty() || equal_ignoring_case(next, "facet") || equal_ignoring_case(next, "endsolid");
}

// Reads a facet after its first word.
std::array<Vec3, 3> read_facet(StlText& in) {
  in.expect("normal");
  for (int k = 0; k < 3; ++k) in.word();  // ignored; some programs write nan
  in.expect("outer");
  in.expect("loop");
  std::array<Vec3, 3> corners;
  for (Vec3& corner : corners) {
    in.expect("vertex");
    corner[0] = in.number("x");
    corner[1] = in.number("y");
    corner[2] = in.number("z");
  }
  in.expect("endloop");
  in.expect("endfacet");
  return corners;
}

MeshFile read_text(std::string_view bytes, const std::string& name) {
  MeshFile file;
  file.encoding = PlyEncoding::ascii;
  file.name = name;
  PointNumbers numbers(bytes.size() /
                       600);  // a facet takes some 250 bytes, and there are half as many vertices
  FaceChannel solids{group_channel, {}, {}, LabelKind::group};
  StlText in(bytes, name);
  int solid = 0;
  for (std::string_view word = in.word(); !word.empty() || solid == 0; word = in.word()) {
    in.require(word, "solid");
    ++solid;
    if (std::string title = in.rest_of_line(); !title.empty()) solids.names[solid] = std::move(title);
    for (word = in.word(); !equal_ignoring_case(word, "endsolid"); word = in.word()) {
      if (!equal_ignoring_case(word, "facet")) in.fail_instead_of(word, "facet or endsolid");
      file.lines.push_back(in.line());
      solids.values.push_back(solid);
      add_facet(file, numbers, read_facet(in));
    }
    in.rest_of_line();
  }
  take_points(file, numbers);
  if (solid > 1 || !solids.names.empty()) file.face_data.push_back(std::move(solids));
  return file;
}

// Binary files.

std::uint32_t facet_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + header_size, sizeof count);
  return count;
}

size_t size_of_facets(std::uint32_t count) {
  return start_of_facets + facet_size * static_cast<size_t>(count);
}

void require_size(std::string_view bytes, const std::string& name) {
  if (bytes.size() < start_of_facets)
    throw InputError(fmt::format(
        "{}: {} bytes; expected at least 84 of a binary STL file, or text that begins with solid; the "
        "file is truncated or of another kind",
        name, bytes.size()));
  const std::uint32_t count = facet_count(bytes);
  if (is_binary_stl(bytes)) return;
  const bool cut = bytes.size() < size_of_facets(count);
  throw InputError(
      fmt::format("{}: {} bytes; expected {} for the {} facets in the header of a binary STL file; {}", name,
                  bytes.size(), size_of_facets(count), count,
                  cut ? "the file is truncated or of another kind" : "the count or the end is wrong"));
}

MeshFile read_binary(std::string_view bytes, const std::string& name) {
  require_size(bytes, name);
  MeshFile file;
  file.encoding = PlyEncoding::binary_little_endian;
  file.name = name;
  file.stl_header = bytes.substr(0, header_size);
  const size_t count = facet_count(bytes);
  if (std::cmp_greater(count, std::numeric_limits<int>::max() / 3))
    throw LimitError(
        fmt::format("{}: {} facets; expected fewer than 715827883; split the mesh", name, count));
  PointNumbers numbers(count);
  FaceChannel attributes{attribute_channel, std::vector<int>(count)};
  file.polygons.items.reserve(3 * count);
  file.polygons.first.reserve(count + 1);
  bool any_attribute = false;
  for (size_t f = 0; f < count; ++f) {
    const size_t offset = start_of_facets + facet_size * f;
    std::array<float, 12> numbers_of_facet;  // the normal and the corners
    std::uint16_t attribute = 0;
    std::memcpy(numbers_of_facet.data(), bytes.data() + offset, sizeof numbers_of_facet);
    std::memcpy(&attribute, bytes.data() + offset + sizeof numbers_of_facet, sizeof attribute);
    std::array<Vec3, 3> corners;
    for (size_t k = 0; k < 9; ++k) {
      const float x = numbers_of_facet[3 + k];
      if (!std::isfinite(x))
        throw InputError(
            fmt::format("{}: facet {}, byte {}: a coordinate is {}; expected a finite number; correct it",
                        name, f, offset + 4 * (3 + k), x));
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] = static_cast<double>(x);
    }
    add_facet(file, numbers, corners);
    attributes.values[f] = attribute;
    any_attribute |= attribute != 0;
  }
  take_points(file, numbers);
  if (any_attribute) file.face_data.push_back(std::move(attributes));
  return file;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= start_of_facets && bytes.size() == size_of_facets(facet_count(bytes));
}

MeshFile read_stl(std::string_view bytes, const std::string& name) {
  MeshFile file =
      !is_binary_stl(bytes) && is_text(bytes, name) ? read_text(bytes, name) : read_binary(bytes, name);
  file.format = MeshFormat::stl;
  return file;
}

namespace {

Vec3 normal_of(const Eigen::Ref<const Mat3X>& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]), u = points.col(t[1]) - a, v = points.col(t[2]) - a;
  const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
  if (!(longest > 0)) return Vec3::Zero();
  const Vec3 n = (u / longest).cross(v / longest);
  const double height = n.norm();
  return height > 0 ? Vec3(n / height) : Vec3::Zero();
}

// The group of each face; none without such data.
struct Groups {
  const FaceChannel* channel = nullptr;
  bool several = false;

  explicit Groups(const FaceData& data) : channel(find_channel(data, group_channel)) {
    if (!channel) return;
    for (const int value : channel->values) several |= value != channel->values.front();
  }
  int of(size_t face) const { return channel ? channel->values[face] : 0; }
  std::string title(int group) const {
    if (!channel) return "";
    const auto named = channel->names.find(group);
    if (named != channel->names.end()) return ' ' + named->second;
    return several ? fmt::format(" group_{}", group) : "";
  }
};

std::string write_text(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                       const Groups& groups) {
  std::string text;
  const auto begin = [&](size_t face) { text += "solid" + groups.title(groups.of(face)) + '\n'; };
  const auto end = [&](size_t face) { text += "endsolid" + groups.title(groups.of(face)) + '\n'; };
  if (triangles.empty()) return "solid\nendsolid\n";
  for (size_t f = 0; f < triangles.size(); ++f) {
    const bool first = f == 0 || groups.of(f) != groups.of(f - 1);
    if (first && f > 0) end(f - 1);
    if (first) begin(f);
    text += "facet normal ";
    append_three(text, Eigen::Vector3f(normal_of(points, triangles[f]).cast<float>()));
    text += "\n outer loop\n";
    for (const int v : triangles[f]) {
      text += "  vertex ";
      append_three(text, points.col(v));
      text += '\n';
    }
    text += " endloop\nendfacet\n";
  }
  end(triangles.size() - 1);
  return text;
}

/// Does it begin with the word of text files, in upper or lower case, after blanks?
bool passes_for_text(const std::string& header) {
  constexpr std::string_view word = "solid";
  const auto begin = std::ranges::find_if_not(header, [](unsigned char c) { return std::isspace(c) != 0; });
  return std::equal(word.begin(), word.end(), begin,
                    begin + std::min<std::ptrdiff_t>(5, header.end() - begin),
                    [](char a, unsigned char b) { return a == std::tolower(b); });
}

std::string write_binary(const Mat3X& points, const std::vector<Triangle>& triangles,
                         const FaceChannel* attributes, const std::string& header) {
  std::string bytes = header.empty() || passes_for_text(header) ? "binary STL" : header;
  bytes.resize(header_size, ' ');
  bytes.reserve(size_of_facets(static_cast<std::uint32_t>(triangles.size())));
  const auto append = [&](auto value) {
    const auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
    bytes.append(raw.data(), raw.size());
  };
  append(static_cast<std::uint32_t>(triangles.size()));
  for (size_t f = 0; f < triangles.size(); ++f) {
    for (const double x : normal_of(points, triangles[f])) append(static_cast<float>(x));
    for (const int v : triangles[f])
      for (const double x : points.col(v)) append(static_cast<float>(x));
    append(static_cast<std::uint16_t>(attributes ? attributes->values[f] : 0));
  }
  return bytes;
}

void require_floats(const Eigen::Ref<const Mat3X>& points) {
  const double largest = points.size() > 0 ? points.cwiseAbs().maxCoeff() : 0;
  if (largest > static_cast<double>(std::numeric_limits<float>::max()))
    throw OutputError(fmt::format(
        "a coordinate of {:.3g} in a binary STL file; expected at most 3.4e38, as its numbers have 32 "
        "bits; write another format, or scale the mesh",
        largest));
}

}  // namespace

std::string write_stl(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      PlyEncoding encoding, const FaceData& data, const std::string& header) {
  if (encoding == PlyEncoding::ascii) return write_text(points, triangles, Groups(data));
  require_floats(points);
  return write_binary(rounded_to_floats(points), triangles, find_channel(data, attribute_channel), header);
}

Warnings losses_in_stl(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                       PlyEncoding encoding, const std::string& name) {
  std::vector<char> used(points.cols(), 0);
  for (const Triangle& triangle : triangles)
    for (const int v : triangle) used[v] = 1;
  const Mat3X written = encoding == PlyEncoding::ascii ? Mat3X(points) : rounded_to_floats(points);
  PointNumbers numbers(used.size());
  size_t count = 0;
  for (size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    ++count;
    numbers(written.col(static_cast<Eigen::Index>(v)));
  }
  Warnings warnings;
  if (const size_t lost = count - numbers.points().size(); lost > 0)
    warnings.push_back(
        {"vertices_coincide",
         fmt::format("{}: {} vertices have the coordinates of another in this STL file{}; who reads it "
                     "will join them; use PLY",
                     name, lost, encoding == PlyEncoding::ascii ? "" : ", whose numbers have 32 bits")});
  if (encoding != PlyEncoding::ascii) {
    const auto turned = count_turned_faces(points, written, triangles);
    if (turned > 0)
      warnings.push_back(
          {"faces_turned_by_rounding",
           fmt::format("{}: {} faces turn over or lose their area in this STL file, whose numbers have 32 "
                       "bits; use PLY, or move the mesh to the origin",
                       name, turned)});
  }
  if (const size_t loose = used.size() - count; loose > 0)
    warnings.push_back(
        {"attributes_not_kept",
         fmt::format("{}: STL files cannot hold the {} vertices in no face; use PLY", name, loose)});
  return warnings;
}

}  // namespace hooke
