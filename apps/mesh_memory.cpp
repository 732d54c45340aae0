#include "mesh_memory.h"

#include <algorithm>
#include <system_error>

#include "hooke/core/error.h"
#include "hooke/io/mesh_format.h"

namespace hooke::app {
namespace {

/// Bytes of a file for each vertex and its two faces, at least: binary for formats that can be.
std::size_t file_bytes_per_vertex(const std::filesystem::path& mesh) {
  try {
    switch (input_format_of(mesh)) {
      case MeshFormat::ply:
        return 38;  // three floats, two faces of a byte and three integers
      case MeshFormat::stl:
        return 100;
      default:
        return 50;
    }
  } catch (const Error&) {
    return 50;
  }
}

}  // namespace

std::size_t memory_for(const std::filesystem::path& mesh, const Settings& s) {
  constexpr double program = 64 << 20, per_vertex = 6000;  // 4200 measured with 100000 vertices
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(mesh, error);
  if (error) return static_cast<std::size_t>(program);
  double vertices = static_cast<double>(size) / static_cast<double>(file_bytes_per_vertex(mesh));
  if (!s.check && !s.paper && s.remesh.connectivity == ConnectivityMode::adapt &&
      s.length.kind == LengthSpec::Kind::times_natural)
    vertices *= std::max(1., 1 / (s.length.value * s.length.value));
  return program + per_vertex * vertices;
}

}  // namespace hooke::app
