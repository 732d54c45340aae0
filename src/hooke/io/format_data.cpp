#include "hooke/io/format_data.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hooke {
namespace {

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
    if (is_integer(type)) value = std::round(std::min(std::max(0., value), full_scale(type)));  // no NaN
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

/// The texture coordinates of PLY files have two sets of names.
VertexData with_common_names(VertexData data) {
  constexpr std::array others = {"texture_u", "texture_v"};
  if (has_all(data, others) && channels_named(data, texture_names).empty())
    for (size_t k = 0; k < 2; ++k) find_channel(data, others[k])->name = texture_names[k];
  return data;
}

/// What a format holds of data that other formats hold too.
class CommonData {
 public:
  CommonData(const VertexData& data, const std::string& format) {
    const ChannelNames colours = colour_names, texture = texture_names;
    if (has_all(data, colours.first(3))) colours_ = colours.first(format == "obj" ? 3 : 4);
    if (has_all(data, normal_names)) normals_ = normal_names;
    if (has_all(data, texture.first(2))) texture_ = texture.first(format == "off" ? 2 : 3);
  }

  bool is_colour(const std::string& name) const { return is_one_of(name, colours_); }
  bool has(const std::string& name) const {
    return is_colour(name) || is_one_of(name, normals_) || is_one_of(name, texture_);
  }

 private:
  ChannelNames colours_, normals_, texture_;
};

}  // namespace

FormatData data_for_format(const VertexData& data, const std::string& from, const std::string& to) {
  if (from == to) return {data, {}};
  const VertexData named = with_common_names(data);
  const CommonData common(named, to);
  FormatData result;
  for (const VertexChannel& channel : named) {
    if (common.is_colour(channel.name))
      result.data.push_back(scaled(channel, to == "obj" ? NumberType::float64 : NumberType::uint8));
    else if (to == "ply" || common.has(channel.name))
      result.data.push_back(channel);
    else
      result.left_out.push_back(channel.name);
  }
  if (to == "off" && common.is_colour("red") && !find_channel(named, "alpha"))
    result.data.push_back({"alpha", NumberType::uint8, std::vector(named.front().values.size(), 255.)});
  return result;
}

}  // namespace hooke
