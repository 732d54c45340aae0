#include "hooke/io/ply_lengths.h"

#include <fmt/format.h>

#include "hooke/core/error.h"
#include "hooke/io/ply_body.h"
#include "hooke/io/printable.h"

namespace hooke {
namespace {

bool is_length(const PlyProperty& property) {
  const bool is_coordinate = property.name == "x" || property.name == "y" || property.name == "z";
  return !property.count_type && !is_integer(property.type) && !is_coordinate;
}

void require_length_property(const PlyElement& vertex, const std::string& property, const std::string& name) {
  std::string there;
  for (const PlyProperty& p : vertex.properties) {
    if (!is_length(p)) continue;
    if (p.name == property) return;
    there += (there.empty() ? " " : ", ") + in_quotes(p.name);
  }
  throw InputError(fmt::format(
      "{}: vertices have no float or double property {}; expected one of target lengths; there {}", name,
      in_quotes(property), there.empty() ? "is none" : "are" + there));
}

template <typename Body>
std::vector<double> read_lengths(Body body, const PlyHeader& header, const PlyElement& vertex,
                                 const std::string& property_name) {
  for (const PlyElement& element : header.elements) {
    body.begin_element(element);
    if (&element == &vertex) break;
    skip_element(body, element);
  }
  std::vector<double> lengths;
  lengths.reserve(static_cast<size_t>(vertex.count));
  for (long long row = 0; row < vertex.count; ++row) {
    body.begin_row(vertex, row);
    for (const PlyProperty& property : vertex.properties) {
      if (property.name != property_name) {
        skip_property(body, property);
        continue;
      }
      const double length = body.number(property.type, "target length");
      if (!(length > 0))
        body.fail(fmt::format("target length {}; expected a positive number; correct it", length));
      lengths.push_back(length);
    }
    body.end_row();
  }
  return lengths;
}

}  // namespace

std::vector<double> read_ply_lengths(std::string_view bytes, const std::string& name,
                                     const std::string& property) {
  const PlyHeader header = read_ply_header(bytes, name);
  const PlyElement& vertex = find_element(header, "vertex", name);
  require_length_property(vertex, property, name);
  if (header.encoding == PlyEncoding::ascii)
    return read_lengths(AsciiPlyBody(bytes, name, header), header, vertex, property);
  return read_lengths(BinaryPlyBody(bytes, name, header), header, vertex, property);
}

}  // namespace hooke
