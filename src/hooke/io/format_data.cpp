#include "hooke/io/format_data.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hooke {
namespace {

constexpr std::array<const char*, 3> colours = {"red", "green", "blue"};

bool has_colours(const VertexData& data) {
  return std::ranges::all_of(colours, [&](const char* name) { return find_channel(data, name) != nullptr; });
}

/// Greatest value of an unsigned integer type; 1 for others.
double full_scale(NumberType type) {
  switch (type) {
    case NumberType::uint8:
      return 255;
    case NumberType::uint16:
      return 65535;
    default:
      return 1;
  }
}

VertexChannel scaled(const VertexChannel& channel, NumberType type) {
  VertexChannel result{channel.name, type, channel.values};
  for (double& value : result.values) {
    value *= full_scale(type) / full_scale(channel.type);
    if (is_integer(type)) value = std::round(std::clamp(value, 0., full_scale(type)));
  }
  return result;
}

}  // namespace

FormatData data_for_format(const VertexData& data, const std::string& from, const std::string& to) {
  if (from == to) return {data, {}};
  const bool from_obj = from == "obj";
  const bool coloured = to != "off" && has_colours(data);
  FormatData result;
  for (const VertexChannel& channel : data) {
    const bool is_colour = coloured && std::ranges::count(colours, channel.name) > 0;
    if (is_colour && (to == "obj" || from_obj))
      result.data.push_back(scaled(channel, to == "obj" ? NumberType::float64 : NumberType::uint8));
    else if (to == "ply")
      result.data.push_back(channel);
    else
      result.left_out.push_back(channel.name);
  }
  return result;
}

}  // namespace hooke
