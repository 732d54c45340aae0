#include "hooke/io/mesh_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/io/msh.h"
#include "hooke/io/obj.h"
#include "hooke/io/off.h"
#include "hooke/io/ply.h"
#include "hooke/io/stl.h"
#include "hooke/io/vtp.h"

namespace hooke {

std::string_view without_byte_order_mark(std::string_view bytes) {
  return bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes;
}

MeshFile parse_mesh_file(std::string_view bytes, const std::string& name, MeshFormat format) {
  bytes = without_byte_order_mark(bytes);
  refuse_other_content(bytes, name, format);
  switch (format) {
    case MeshFormat::obj:
      return read_obj(bytes, name);
    case MeshFormat::ply:
      return read_ply(bytes, name);
    case MeshFormat::off:
      return read_off(bytes, name);
    case MeshFormat::stl:
      return read_stl(bytes, name);
    case MeshFormat::msh:
    case MeshFormat::msh2:
      return read_msh(bytes, name);
    case MeshFormat::vtp:
      break;
  }
  return read_vtp(bytes, name);
}

namespace {

void check_corner_count(const MeshFile& file, size_t corners) {
  if (std::cmp_greater(corners, std::numeric_limits<int>::max()))
    throw LimitError(file.name + ": more than 2147483647 face corners; expected fewer; split the mesh");
}

}  // namespace

void append_faces(MeshFile& file, const std::vector<MeshFile>& parts) {
  size_t corners = file.polygons.items.size(), faces = file.polygons.first.size(), lines = file.lines.size();
  for (const MeshFile& part : parts) {
    corners += part.polygons.items.size();
    faces += part.polygons.first.size() - 1;
    lines += part.lines.size();
  }
  check_corner_count(file, corners);
  IntLists& all = file.polygons;
  all.items.reserve(corners);
  all.first.reserve(faces);
  file.lines.reserve(lines);
  for (const MeshFile& part : parts) {
    const int before = static_cast<int>(all.items.size());
    all.items.insert(all.items.end(), part.polygons.items.begin(), part.polygons.items.end());
    for (size_t f = 1; f < part.polygons.first.size(); ++f)
      all.first.push_back(before + part.polygons.first[f]);
    file.lines.insert(file.lines.end(), part.lines.begin(), part.lines.end());
  }
}

void end_polygon(MeshFile& file) {
  check_corner_count(file, file.polygons.items.size());
  file.polygons.first.push_back(static_cast<int>(file.polygons.items.size()));
}

namespace {

/// A warning that lists the kinds, the first 20 of them; none if there are none.
Warnings listing(const char* code, const std::string& text, const std::vector<std::string>& kinds) {
  if (kinds.empty()) return {};
  constexpr size_t max_listed = 20;
  const std::vector<std::string> named(
      kinds.begin(), kinds.begin() + static_cast<std::ptrdiff_t>(std::min(kinds.size(), max_listed)));
  const std::string others =
      kinds.size() > max_listed ? fmt::format(" and {} more kinds", kinds.size() - max_listed) : "";
  return {{code, fmt::format("{}: {}{}", text, fmt::join(named, ", "), others)}};
}

}  // namespace

void warn_not_kept(MeshFile& file, const std::vector<std::string>& kinds) {
  append(file.content.anew, listing("attributes_not_kept", file.name + ": not kept in the output", kinds));
}

void warn_carried_along(MeshFile& file, const std::vector<std::string>& kinds) {
  append(
      file.content.preserved,
      listing("carried_along",
              file.name + ": no part of the surface, and written as it was although vertices moved", kinds));
}

namespace {

/// Maximum of an 8-bit or 16-bit unsigned integer type; 1 for other types.
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
    if (is_integer(type))
      value = std::round(std::min(std::max(0., value), full_scale(type)));  // std::max turns NaN into 0
  }
  return result;
}

bool has_all(const VertexData& data, ChannelNames names) {
  const ChannelList channels = channels_named(data, names);
  return channels.size() == names.size() && std::ranges::all_of(channels, [](const VertexChannel* channel) {
           return std::ranges::all_of(channel->values, [](double value) { return std::isfinite(value); });
         });
}

bool is_one_of(const std::string& name, ChannelNames names) {
  return std::ranges::find(names, name) != names.end();
}

/// Renames texture coordinates to the names s and t.
VertexData with_common_names(VertexData data) {
  const ChannelList texture = texture_of(data);
  if (channels_named(data, texture_names).empty())
    for (size_t k = 0; k < texture.size(); ++k) find_channel(data, texture[k]->name)->name = texture_names[k];
  return data;
}

/// The colours, normals and texture coordinates in the data that a format can hold.
class CommonData {
 public:
  CommonData(const VertexData& data, MeshFormat format) {
    const bool holds_any =
        format == MeshFormat::obj || format == MeshFormat::ply || format == MeshFormat::off;
    if (!holds_any) return;
    const ChannelNames colours = colour_names, texture = texture_names;
    if (has_all(data, colours.first(3))) colours_ = colours.first(format == MeshFormat::obj ? 3 : 4);
    if (has_all(data, normal_names)) normals_ = normal_names;
    if (has_all(data, texture.first(2))) texture_ = texture.first(format == MeshFormat::off ? 2 : 3);
  }

  bool is_colour(const std::string& name) const { return is_one_of(name, colours_); }
  bool has(const std::string& name) const {
    return is_colour(name) || is_one_of(name, normals_) || is_one_of(name, texture_);
  }

 private:
  ChannelNames colours_, normals_, texture_;
};

}  // namespace

FormatData data_for_format(const VertexData& data, MeshFormat from, MeshFormat to) {
  if (from == to) return {data, {}};
  const VertexData named = with_common_names(data);
  const CommonData common(named, to);
  FormatData result;
  for (const VertexChannel& channel : named) {
    if (common.is_colour(channel.name))
      result.data.push_back(scaled(channel, to == MeshFormat::obj ? NumberType::float64 : NumberType::uint8));
    else if (to == MeshFormat::ply || common.has(channel.name))
      result.data.push_back(channel);
    else
      result.dropped.push_back(channel.name);
  }
  if (to == MeshFormat::off && common.is_colour("red") && !find_channel(named, "alpha"))
    result.data.push_back({"alpha", NumberType::uint8, std::vector(named.front().values.size(), 255.)});
  return result;
}

namespace {

constexpr std::array obj_channels = {object_channel, group_channel, material_channel, smoothing_channel};

bool holds(MeshFormat format, PlyEncoding encoding, const std::string& channel) {
  switch (format) {
    case MeshFormat::msh:
    case MeshFormat::msh2:
      return channel == group_channel || channel == entity_channel;
    case MeshFormat::stl:
      return channel == (encoding == PlyEncoding::ascii ? group_channel : attribute_channel);
    case MeshFormat::obj:
      return is_one_of(channel, obj_channels);
    case MeshFormat::ply:
      return true;
    case MeshFormat::off:
    case MeshFormat::vtp:
      break;
  }
  return false;
}

}  // namespace

FormatFaceData face_data_for_format(const FaceData& data, MeshFormat from, MeshFormat to,
                                    PlyEncoding encoding) {
  FormatFaceData result;
  for (const FaceChannel& channel : data) {
    const bool differs =
        std::ranges::any_of(channel.values, [&](int x) { return x != channel.values.front(); });
    const bool is_named = from == MeshFormat::obj && to != MeshFormat::obj && !channel.names.empty();
    if (holds(to, encoding, channel.name) && (differs || from == to || to != MeshFormat::ply)) {
      result.data.push_back(channel);
      if (to == MeshFormat::ply && !channel.names.empty())
        result.dropped.push_back("names of " + channel.name);
    } else if (differs || is_named) {
      result.dropped.push_back(channel.name);
    }
  }
  return result;
}

}  // namespace hooke
