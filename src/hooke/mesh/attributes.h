// Vertex attributes besides coordinates: colours, normals, any values of a file.
#pragma once

#include <array>
#include <span>
#include <string>

#include "hooke/core/types.h"

namespace hooke {

struct MapEntry;

/// How a number is stored in a file.
enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_integer(NumberType type) {
  return type < NumberType::float32;
}

/// One number per vertex.
struct VertexChannel {
  std::string name;  // as in PLY files: red, nx, quality
  NumberType type = NumberType::float64;
  std::vector<double> values = {};
};
using VertexData = std::vector<VertexChannel>;

/// Channels that all formats support, by their names in PLY files.
inline constexpr std::array colour_names = {"red", "green", "blue", "alpha"};
inline constexpr std::array normal_names = {"nx", "ny", "nz"};
inline constexpr std::array texture_names = {"s", "t", "p"};

/// The channel with this name; null if there is none.
VertexChannel* find_channel(VertexData& data, const std::string& name);
const VertexChannel* find_channel(const VertexData& data, const std::string& name);

/// The existing channels among these names, in the order of the names.
using ChannelNames = std::span<const char* const>;
using ChannelList = std::vector<const VertexChannel*>;
ChannelList channels_named(const VertexData& data, ChannelNames names);

/// The texture coordinates: s and t, and p if that is there, or texture_u and texture_v, as some PLY files
/// name them; none if only one is there.
ChannelList texture_of(const VertexData& data);

/// Interpolates all channels at the surface points of the map: linear in the faces, never beyond the values
/// of their corners, integers rounded. Integers that are labels are those of the corner with the greatest
/// weight: all but colours, and but those of one or two bytes that differ at most sides of faces. Vertices on
/// no face keep the value of their old vertex.
VertexData interpolate(const VertexData& data, const std::vector<MapEntry>& map,
                       const std::vector<Triangle>& faces);

/// Is the value the same at both ends of most sides of the faces, as labels are?
bool is_equal_at_most_sides(const VertexChannel& channel, const std::vector<Triangle>& faces);

/// Whether the channels nx, ny and nz exist.
bool has_normals(const VertexData& data);

/// Writes normals, 3 x |V|, to these channels. Pre-condition: has_normals().
void set_normals(VertexData& data, const Mat3X& normals);

}  // namespace hooke
