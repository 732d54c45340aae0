// Any bytes as a mesh file of the format HOOKE_FUZZ_FORMAT: they are read or refused with a message, and what
// is rewritten without motion is the same file.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "hooke/core/error.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/rewrite.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  constexpr MeshFormat format = MeshFormat::HOOKE_FUZZ_FORMAT;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const MeshFile file = parse_mesh_file(bytes, "input", format);
    if (!file.points.allFinite()) std::abort();
    for (const int corner : file.polygons.items)
      if (corner < 0 || corner >= file.points.cols()) std::abort();
    if (!can_rewrite(format)) return 0;
    const RewrittenMesh same = rewrite_mesh(bytes, "input", format, file.points);
    if (same.obstacle.empty() && same.bytes != bytes) std::abort();
    Mat3X moved = file.points;
    moved.array() += .5;
    const RewrittenMesh other = rewrite_mesh(bytes, "input", format, moved);
    if (!other.obstacle.empty()) return 0;
    const Mat3X again = parse_mesh_file(other.bytes, "output", format).points;
    if (again != (other.rounded.size() > 0 ? other.rounded : moved)) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
