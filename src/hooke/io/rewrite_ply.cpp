#include "hooke/io/rewrite_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "hooke/io/edited_copy.h"
#include "hooke/io/ply.h"
#include "hooke/io/ply_format.h"
#include "hooke/io/renewed_normals.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

// How numbers stand in the body, and how they are replaced in the copy.

struct TextNumbers {
  static double read(std::string_view raw, PlyType) {
    double value = 0;
    return parse_number(raw, value) == NumberError::none ? value : std::numeric_limits<double>::quiet_NaN();
  }
  static void write(EditedCopy& copy, std::string_view raw, PlyType type, double value) {
    if (is_integer(type))
      copy.replace_by_number(raw, static_cast<long long>(value));
    else if (type == PlyType::float32)
      copy.replace_by_number(raw, static_cast<float>(value));
    else
      copy.replace_by_number(raw, value);
  }

  // What a number of this type reads as once it is written: the shortest text of .1 in single precision is
  // .1.
  static double written(PlyType type, double value) {
    if (type != PlyType::float32) return value;
    std::string text;
    append_number(text, static_cast<float>(value));
    return read(text, type);
  }
};

struct BinaryNumbers {
  bool swap;

  double read(std::string_view raw, PlyType type) const { return binary_number(raw, type, swap); }
  void write(EditedCopy& copy, std::string_view raw, PlyType type, double value) const {
    char bytes[sizeof(double)];
    char* end = bytes;
    put_binary(end, type, value, swap);
    copy.replace(raw, {bytes, raw.size()});
  }
  static double written(PlyType, double value) { return value; }
};

// The value as the type holds it; none if the type cannot.
std::optional<double> as_type(PlyType type, double value) {
  const auto whole = [&](auto integer) -> std::optional<double> {
    using Limits = std::numeric_limits<decltype(integer)>;
    const bool fits = value == std::round(value) && value >= Limits::min() && value <= Limits::max();
    return fits ? std::optional(value) : std::nullopt;
  };
  switch (type) {
    case PlyType::int8:
      return whole(std::int8_t{});
    case PlyType::uint8:
      return whole(std::uint8_t{});
    case PlyType::int16:
      return whole(std::int16_t{});
    case PlyType::uint16:
      return whole(std::uint16_t{});
    case PlyType::int32:
      return whole(std::int32_t{});
    case PlyType::uint32:
      return whole(std::uint32_t{});
    case PlyType::float32:
      return std::abs(value) <= std::numeric_limits<float>::max() ? std::optional(static_cast<float>(value))
                                                                  : std::nullopt;
    case PlyType::float64:
      return value;
  }
  return std::nullopt;
}

// Index (0 to 2) of the component of a normal that the property is; -1 for none.
int normal_of(const PlyProperty& property) {
  const auto found = std::ranges::find(normal_names, property.name);
  return property.count_type || found == normal_names.end() ? -1
                                                            : static_cast<int>(found - normal_names.begin());
}

// Whether rows of the element have a normal of floating components.
bool has_normal(const PlyElement& element) {
  return std::ranges::count_if(element.properties, [](const PlyProperty& property) {
           return normal_of(property) >= 0 && !is_integer(property.type);
         }) == 3;
}

// A body being rewritten: what is new, and where it goes.
struct NewValues {
  const PlyElement& vertex;
  const PlyElement& face;
  const Mat3X& points;
  Mat3X& stored;  // the points as they then stand in the file
  std::optional<RenewedNormals> of_vertices, of_faces;
};

// Whether the types of a file could take the coordinates.
struct Fit {
  bool all_fit = true, any_rounded = false;
};

// Replaces values of one piece of a body.
template <typename Numbers>
class PlyRewriter {
 public:
  PlyRewriter(const NewValues& values, Numbers numbers, EditedCopy& copy)
      : values_(values), numbers_(numbers), copy_(copy) {}

  template <typename Body>
  void rewrite_rows(Body& body, const PlyElement& element, const PlyRows& rows) {
    const bool is_vertex = &element == &values_.vertex;
    const auto& normals = is_vertex ? values_.of_vertices : values_.of_faces;
    if (!is_vertex && (&element != &values_.face || !normals)) return skip_rows(body, element, rows);
    for (long long row = rows.begin; row < rows.end; ++row) {
      body.begin_row(element, row);
      for (const PlyProperty& property : element.properties) {
        const int coordinate = is_vertex && !property.count_type ? coordinate_of(property) : -1;
        const int component = normals ? normal_of(property) : -1;
        if (coordinate >= 0)
          set_coordinate(body.raw(property.type), property.type, values_.stored(coordinate, row));
        else if (component >= 0 && normals->renewed[row])
          set_normal(body.raw(property.type), property.type, normals->values(component, row));
        else
          skip_property(body, property);
      }
      body.end_row();
    }
  }

  const Fit& fit() const { return fit_; }

 private:
  // Replaces a value by the new one, which is then rounded to the type.
  void set_coordinate(std::string_view raw, PlyType type, double& value) {
    const double old = numbers_.read(raw, type);
    if (old == value) return;
    const std::optional<double> fresh = as_type(type, value);
    fit_.all_fit &= fresh.has_value();
    if (!fresh) return;
    const bool same = *fresh == as_type(type, old);
    if (!same) numbers_.write(copy_, raw, type, *fresh);
    fit_.any_rounded |= type == PlyType::float32;
    value = same ? old : numbers_.written(type, *fresh);
  }

  void set_normal(std::string_view raw, PlyType type, double value) {
    constexpr double precision = 1e-7;  // of a unit normal in single precision
    if (!(std::abs(numbers_.read(raw, type) - value) <= precision))
      numbers_.write(copy_, raw, type, static_cast<float>(value) + 0.f);  // no -0
  }

  const NewValues& values_;
  Numbers numbers_;
  EditedCopy& copy_;
  Fit fit_;
};

// Rewrites a body in one piece.
template <typename Body, typename Numbers>
std::string rewrite_whole(std::string_view bytes, Body body, Numbers numbers, const PlyHeader& header,
                          const NewValues& values, Fit& fit) {
  EditedCopy copy(bytes);
  PlyRewriter rewriter(values, numbers, copy);
  for (const PlyElement& element : header.elements) {
    body.begin_element(element);
    rewriter.rewrite_rows(body, element, {0, row_count(element)});
  }
  fit = rewriter.fit();
  return std::move(copy).finish();
}

// Rewrites a text with one row a line in parallel pieces.
std::string rewrite_lines(std::string_view bytes, const AsciiPlyBody& body, const PlyHeader& header,
                          const NewValues& values, Fit& fit) {
  const std::vector<TextPiece> pieces = remaining_pieces(body.scanner());
  std::vector<Fit> fits(pieces.size());
  std::string text = edited_text(bytes, pieces, [&](const TextPiece& piece, size_t p, EditedCopy& copy) {
    AsciiPlyBody rows_of_piece(piece.scanner);
    PlyRewriter rewriter(values, TextNumbers{}, copy);
    for_rows_of_piece(header, piece, [&](const PlyElement& element, const PlyRows& rows) {
      rewriter.rewrite_rows(rows_of_piece, element, rows);
    });
    fits[p] = rewriter.fit();
  });
  for (const Fit& of_piece : fits) {
    fit.all_fit &= of_piece.all_fit;
    fit.any_rounded |= of_piece.any_rounded;
  }
  return text;
}

std::string rewrite_body(std::string_view bytes, const std::string& name, const PlyHeader& header,
                         const NewValues& values, Fit& fit) {
  if (header.encoding != PlyEncoding::ascii)
    return rewrite_whole(bytes, BinaryPlyBody(bytes, name, header),
                         BinaryNumbers{swaps_bytes(header.encoding)}, header, values, fit);
  AsciiPlyBody body(bytes, name, header);
  return body.one_line() ? rewrite_whole(bytes, std::move(body), TextNumbers{}, header, values, fit)
                         : rewrite_lines(bytes, body, header, values, fit);
}

void renew_ply_normals(std::string_view bytes, const std::string& name, NewValues& values) {
  if (!has_normal(values.vertex) && !has_normal(values.face)) return;
  const MeshFile file = read_ply(bytes, name);
  const MovedPolygons moved{file.polygons, file.points, values.points};
  if (has_normal(values.vertex)) values.of_vertices = renew_vertex_normals(moved);
  if (has_normal(values.face)) values.of_faces = renew_polygon_normals(moved);
}

}  // namespace

RewrittenMesh rewrite_ply(std::string_view bytes, const std::string& name, const Mat3X& points) {
  const PlyHeader header = read_ply_header(bytes, name);
  Mat3X stored = points;
  NewValues values{
      find_element(header, "vertex", name), find_element(header, "face", name), points, stored, {}, {}};
  renew_ply_normals(bytes, name, values);
  Fit fit;
  RewrittenMesh result;
  result.bytes = rewrite_body(bytes, name, header, values, fit);
  if (!fit.all_fit) result.obstacle = out_of_range;
  if (fit.any_rounded) result.rounded = std::move(stored);
  return result;
}

}  // namespace hooke
