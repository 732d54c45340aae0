#include "mesh_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <system_error>

#include "hooke/core/error.h"
#include "hooke/io/mesh_format.h"
#include "hooke/io/read_mesh.h"
#include "memory_limit.h"

namespace hooke::app {
namespace {

constexpr double megabyte = 1 << 20;

/// The number as a size; a greater one than any machine has becomes 2^60, so that sums fit too.
std::size_t whole_bytes(double bytes) {
  return static_cast<std::size_t>(std::min(bytes, 0x1p60));
}

double equilateral_faces(double area, double edge) {
  return 4 * area / (std::numbers::sqrt3 * edge * edge);
}

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

std::size_t memory_allowed(const Settings& s) {
  return s.memory_limit > 0 ? whole_bytes(s.memory_limit * megabyte) : memory_limit();
}

/// The estimate is of the peaks measured with 10000 to 400000 vertices, in each mode.
void require_memory(const Settings& s, std::size_t vertices, const RunRecord& record) {
  constexpr double program = 12 * megabyte, per_vertex = 1000, per_vertex_of_result = 1200;
  if (s.memory_limit <= 0) return;
  const double count = static_cast<double>(vertices);
  double result = count;
  if (!s.paper && s.remesh.connectivity == ConnectivityMode::adapt)
    result = std::max(count, equilateral_faces(record.before.extent.area, record.target.mean) / 2);
  const double needed = program + per_vertex * count + per_vertex_of_result * result;
  if (needed <= s.memory_limit * megabyte) return;
  const double fits = std::floor((s.memory_limit * megabyte - program) / (needed - program) * count);
  throw LimitError(fmt::format(
      "{}: needs about {:.0f} MB for {} vertices{}, --memory-limit allows {:g}; expected {}",
      name_of_input(s.input), std::ceil(needed / megabyte), vertices,
      result > count ? fmt::format(" and {:.0f} new ones", result) : "", s.memory_limit,
      fits >= 1
          ? fmt::format("a mesh of at most about {:.0f} vertices, or a higher limit", fits)
          : fmt::format("at least that; the program takes {:.0f} MB without a mesh", program / megabyte)));
}

std::size_t memory_for(const std::filesystem::path& mesh, const Settings& s) {
  constexpr double program = 64 << 20, per_vertex = 6000;  // 4200 measured with 100000 vertices
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(mesh, error);
  if (error) return whole_bytes(program);
  double vertices = static_cast<double>(size) / static_cast<double>(file_bytes_per_vertex(mesh));
  if (!s.check && !s.paper && s.remesh.connectivity == ConnectivityMode::adapt &&
      s.length.kind == LengthSpec::Kind::times_natural)
    vertices *= std::max(1., 1 / (s.length.value * s.length.value));
  return whole_bytes(program + per_vertex * vertices);
}

}  // namespace hooke::app
