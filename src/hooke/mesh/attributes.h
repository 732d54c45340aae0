// Numbers that belong to the vertices besides their coordinates: colours, normals, any values of a file.
#pragma once

#include <array>
#include <span>
#include <string>

#include "hooke/mesh/surface_point.h"

namespace hooke {

/// How a number is written in a file.
enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_integer(NumberType type) {
  return type < NumberType::float32;
}

/// One number per vertex.
struct VertexChannel {
  std::string name;  // as PLY files have it: red, nx, quality
  NumberType type = NumberType::float64;
  std::vector<double> values = {};
};
using VertexData = std::vector<VertexChannel>;

/// Channels that all formats know, by the names that PLY files have for them.
inline constexpr std::array colour_names = {"red", "green", "blue", "alpha"};
inline constexpr std::array normal_names = {"nx", "ny", "nz"};
inline constexpr std::array texture_names = {"s", "t", "p"};

/// The channel of that name; null without.
VertexChannel* find_channel(VertexData& data, const std::string& name);
const VertexChannel* find_channel(const VertexData& data, const std::string& name);

/// The channels of these names that there are, in the order of the names.
using ChannelNames = std::span<const char* const>;
using ChannelList = std::vector<const VertexChannel*>;
ChannelList channels_named(const VertexData& data, ChannelNames names);

/// The values at the places of the map, linear in the faces there and never beyond the values of their
/// corners; integers rounded. Vertices on no face keep the value of the vertex that they were.
VertexData interpolate(const VertexData& data, const std::vector<MapEntry>& map,
                       const std::vector<Triangle>& faces);

/// Are there nx, ny and nz?
bool has_normals(const VertexData& data);

/// Writes normals to these channels. Pre-condition: has_normals().
void set_normals(VertexData& data, const Mat3X& normals);

}  // namespace hooke
