#include "hooke/mesh/attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hooke/core/parallel.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {
namespace {

double value_at(const MapEntry& entry, const std::vector<double>& values,
                const std::vector<Triangle>& faces) {
  if (entry.position.face < 0) return entry.vertex < 0 ? 0 : values[entry.vertex];
  const Triangle& corners = faces[entry.position.face];
  double value = 0, smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
  for (size_t k = 0; k < 3; ++k) {  // the value of a corner without weight may be NaN
    const double weight = entry.position.weights[static_cast<Eigen::Index>(k)];
    if (!(weight > 0)) continue;
    const double corner = values[corners[k]];
    value += weight * corner;
    smallest = std::min(smallest, corner);
    largest = std::max(largest, corner);
  }
  return std::isfinite(value) ? std::clamp(value, smallest, largest) : value;  // against rounding
}

/// The value of the corner with the greatest weight, of the first of these.
double nearest_value(const MapEntry& entry, const std::vector<double>& values,
                     const std::vector<Triangle>& faces) {
  if (entry.position.face < 0) return entry.vertex < 0 ? 0 : values[entry.vertex];
  Eigen::Index corner;
  entry.position.weights.maxCoeff(&corner);
  return values[faces[entry.position.face][static_cast<size_t>(corner)]];
}

}  // namespace

bool is_equal_at_most_sides(const VertexChannel& channel, const std::vector<Triangle>& faces) {
  std::size_t equal = 0;
  for (const Triangle& t : faces)
    for (std::size_t k = 0; k < 3; ++k) equal += channel.values[t[k]] == channel.values[t[(k + 1) % 3]];
  return 2 * equal >= 3 * faces.size();
}

namespace {

/// Are the numbers of the channel labels, between which there is nothing? Those of one or two bytes may be
/// brightness: they are labels if they are equal at most sides of faces.
bool has_labels(const VertexChannel& channel, const std::vector<Triangle>& faces) {
  if (!is_integer(channel.type) || std::ranges::find(colour_names, channel.name) != colour_names.end())
    return false;
  return channel.type == NumberType::int32 || channel.type == NumberType::uint32 ||
         is_equal_at_most_sides(channel, faces);
}

}  // namespace

const VertexChannel* find_channel(const VertexData& data, const std::string& name) {
  const auto found = std::ranges::find(data, name, &VertexChannel::name);
  return found == data.end() ? nullptr : &*found;
}

VertexChannel* find_channel(VertexData& data, const std::string& name) {
  const auto found = std::ranges::find(data, name, &VertexChannel::name);
  return found == data.end() ? nullptr : &*found;
}

ChannelList channels_named(const VertexData& data, ChannelNames names) {
  ChannelList channels;
  for (const char* name : names)
    if (const VertexChannel* channel = find_channel(data, name)) channels.push_back(channel);
  return channels;
}

VertexData interpolate(const VertexData& data, const std::vector<MapEntry>& map,
                       const std::vector<Triangle>& faces) {
  VertexData result;
  for (const VertexChannel& channel : data) {
    VertexChannel& to = result.emplace_back(VertexChannel{channel.name, channel.type, {}});
    to.values.resize(map.size());
    const auto at = has_labels(channel, faces) ? nearest_value : value_at;
    parallel_for(map.size(), 4096, [&](size_t begin, size_t end) {
      for (size_t v = begin; v < end; ++v) {
        const double value = at(map[v], channel.values, faces);
        to.values[v] = is_integer(channel.type) ? std::round(value) : value;
      }
    });
  }
  return result;
}

ChannelList texture_of(const VertexData& data) {
  constexpr std::array other_names = {"texture_u", "texture_v"};
  for (const ChannelNames names : {ChannelNames(texture_names), ChannelNames(other_names)})
    if (channels_named(data, names.first(2)).size() == 2) return channels_named(data, names);
  return {};
}

bool has_normals(const VertexData& data) {
  return channels_named(data, normal_names).size() == normal_names.size();
}

void set_normals(VertexData& data, const Mat3X& normals) {
  for (size_t k = 0; k < 3; ++k) {
    std::vector<double>& values = find_channel(data, normal_names[k])->values;
    for (Eigen::Index v = 0; v < normals.cols(); ++v) values[v] = normals(static_cast<Eigen::Index>(k), v);
  }
}

}  // namespace hooke
