#include "hooke/io/binary_off.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/io/binary_numbers.h"

namespace hooke {
namespace {

constexpr size_t word_size = 4;  // bytes of every number

// A cursor in the bytes.
class Words {
 public:
  Words(std::string_view bytes, size_t offset, const std::string& name)
      : bytes_(bytes), offset_(offset), name_(name) {}

  size_t offset() const { return offset_; }
  size_t remaining() const { return bytes_.size() - offset_; }
  std::string_view rest() const { return bytes_.substr(offset_); }

  int integer() { return static_cast<int>(number(NumberType::int32)); }
  double real() { return number(NumberType::float32); }
  void skip(size_t words) {
    if (remaining() / word_size < words)
      fail("the file ends here; expected more values; it is cut or a count is wrong");
    offset_ += words * word_size;
  }

  [[noreturn]] void fail(std::string_view message) const {
    throw InputError(fmt::format("{}: byte {}: {}", name_, offset_, message));
  }

 private:
  double number(NumberType type) {
    const size_t at = offset_;
    skip(1);
    return binary_number(bytes_.substr(at, word_size), type, swaps_bytes(std::endian::big));
  }

  std::string_view bytes_;
  size_t offset_;
  const std::string& name_;
};

int read_binary_count(Words& words, const char* what, size_t least_size) {
  const int count = words.integer();
  if (count < 0 || std::cmp_greater(count, words.remaining() / least_size))
    words.fail(
        fmt::format("{} is {}, but only {} bytes follow; expected as many as there are; the file is cut or "
                    "the count is wrong",
                    what, count, words.remaining()));
  return count;
}

// The offset of the counts, after the line of the keyword.
size_t start_of_body(std::string_view bytes, const Scanner& in) {
  const std::string_view rest = in.rest();
  const size_t end = rest.find('\n');
  if (end == rest.npos || rest.substr(0, end).find_first_not_of(" \t\r") != rest.npos)
    in.fail("text after BINARY; expected a line end and then the numbers; correct the keyword line");
  return bytes.size() - rest.size() + end + 1;
}

VertexData allocate_binary_data(const OffHeader& header) {
  VertexData data;
  const auto add = [&](ChannelNames names) {
    for (const char* name : names)
      data.push_back({name, NumberType::float32, std::vector<double>(header.vertices)});
  };
  if (header.normals) add(normal_names);
  if (header.colours) add(colour_names);
  if (header.texture) add(ChannelNames(texture_names).first(2));
  return data;
}

void read_binary_vertices(Words& words, MeshFile& file) {
  for (Eigen::Index v = 0; v < file.points.cols(); ++v) {
    for (int k = 0; k < 3; ++k) {
      file.points(k, v) = words.real();
      if (!std::isfinite(file.points(k, v)))
        words.fail(fmt::format("vertex {} is not finite; expected finite numbers; correct it", v));
    }
    for (VertexChannel& channel : file.vertex_data) channel.values[v] = words.real();
  }
}

// Returns whether a face has a colour.
bool read_binary_faces(Words& words, int faces, MeshFile& file) {
  bool coloured = false;
  const auto vertices = static_cast<int>(file.points.cols());
  for (int f = 0; f < faces; ++f) {
    const int corners = words.integer();
    if (corners < 3)
      words.fail(
          fmt::format("face {} with {} corners; expected 3 or more; correct or remove it", f, corners));
    for (int k = 0; k < corners; ++k) {
      const int id = words.integer();
      if (id < 0 || id >= vertices)
        words.fail(fmt::format("face {} has vertex index {}; expected 0 to {}; correct the index", f, id,
                               vertices - 1));
      file.polygons.items.push_back(id);
    }
    end_polygon(file);
    const int colours = words.integer();
    if (colours < 0 || colours > 4)
      words.fail(fmt::format("face {} with a colour of {} numbers; expected 0 to 4; is the face size right?",
                             f, colours));
    words.skip(colours);
    coloured |= colours > 0;
  }
  return coloured;
}

}  // namespace

BinaryOffLayout binary_off_layout(std::string_view bytes, const std::string& name) {
  Scanner in(bytes, name, off_syntax);
  BinaryOffLayout layout{read_off_header(in)};
  OffHeader& header = layout.header;
  Words words(bytes, start_of_body(bytes, in), name);
  const size_t extra = (header.normals ? 3u : 0u) + (header.colours ? 4u : 0u) + (header.texture ? 2u : 0u);
  constexpr size_t least_face = 5 * word_size;  // size, three corners, colour
  layout.vertex_size = (3 + extra) * word_size;
  header.vertices = read_binary_count(words, "vertex count", layout.vertex_size);
  header.faces = read_binary_count(words, "face count", least_face);
  words.skip(1);  // the edge count
  layout.vertices = words.offset();
  if (std::cmp_greater(header.vertices, words.remaining() / layout.vertex_size))
    words.fail("the file ends before its last vertex; it is cut or the count is wrong");
  return layout;
}

MeshFile read_binary_off(std::string_view bytes, const std::string& name) {
  const BinaryOffLayout layout = binary_off_layout(bytes, name);
  Words words(bytes, layout.vertices, name);
  MeshFile file;
  file.name = name;
  file.format = MeshFormat::off;
  file.points.resize(3, layout.header.vertices);
  file.vertex_data = allocate_binary_data(layout.header);
  read_binary_vertices(words, file);
  const bool face_colours = read_binary_faces(words, layout.header.faces, file);
  if (std::ranges::any_of(words.rest(), [](char c) { return !is_line_end(c); }))
    words.fail(
        fmt::format("{} bytes after the last face; expected the end of the file; is the face count right?",
                    words.remaining()));
  if (face_colours) warn_not_kept(file, {"face colours"});
  return file;
}

}  // namespace hooke
