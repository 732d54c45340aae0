#include "mesh_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <system_error>

#include "hooke/core/error.h"
#include "hooke/io/files.h"
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

// Of the peaks measured with 10000 to 400000 vertices, in each mode. Reading takes 500 a vertex.
constexpr double program_bytes = 12 * megabyte, bytes_per_new_vertex = 1450;

double bytes_per_vertex(const Settings& s) {
  return s.check ? 900 : 2200;
}

std::string without_a_mesh() {
  return fmt::format("at least that; the program takes {:.0f} MB without a mesh", program_bytes / megabyte);
}

/// Bytes of a file for each vertex and its two faces, at most: text, with normals and other values. Without
/// bound where the file may be filled with volume elements or data.
double max_file_bytes_per_vertex(const Settings& s) {
  const MeshFormat format = s.input_format ? *s.input_format : input_format_of(s.input);
  if (format == MeshFormat::msh || format == MeshFormat::vtp) return std::numeric_limits<double>::infinity();
  return format == MeshFormat::stl ? 600 : 250;
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

void require_memory_for_file(const Settings& s) {
  if (s.memory_limit <= 0 || is_standard_input(s.input)) return;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(s.input, error);
  if (error) return;  // a pipe, or a file that reading it will complain about
  const double bytes = static_cast<double>(size), allowed = s.memory_limit * megabyte;
  const double needed = program_bytes + bytes + bytes_per_vertex(s) * bytes / max_file_bytes_per_vertex(s);
  if (needed <= allowed) return;
  const double fits = (allowed - program_bytes) / (needed - program_bytes) * bytes;
  throw LimitError(fmt::format(
      "{}: a file of {:.3g} MB needs at least about {:.0f} MB, --memory-limit allows {:g}; expected {}",
      name_of_input(s.input), bytes / megabyte, std::ceil(needed / megabyte), s.memory_limit,
      fits > 0 ? fmt::format("a file of at most about {:.3g} MB, or a higher limit", fits / megabyte)
               : without_a_mesh()));
}

double most_faces(const Settings& s) {
  return 2 * s.memory_limit * megabyte / bytes_per_new_vertex;
}

void require_memory(const Settings& s, std::size_t vertices, const RunRecord& record) {
  const double count = static_cast<double>(vertices);
  double added = 0;
  if (!s.check && !s.paper && s.remesh.connectivity == ConnectivityMode::adapt && record.target.mean > 0)
    added =
        std::max(record.target.faces, equilateral_faces(record.before.extent.area, record.target.mean)) / 2 -
        count;
  added = std::max(added, 0.);
  if (s.memory_limit <= 0 && added == 0) return;
  const double allowed = static_cast<double>(memory_allowed(s)),
               of_input = program_bytes + bytes_per_vertex(s) * count,
               needed = of_input + bytes_per_new_vertex * added;
  if (needed <= allowed) return;
  const auto remedy = [&]() -> std::string {
    if (const double fits = std::floor((allowed - of_input) / bytes_per_new_vertex); added > 0 && fits > 0)
      return fmt::format("a target length about {:.3g} times as long, or a higher limit",
                         std::sqrt((count + added) / (count + fits)));
    const double fits = std::floor((allowed - program_bytes) / (needed - program_bytes) * count);
    return fits >= 1 ? fmt::format("a mesh of at most about {:.0f} vertices, or a higher limit", fits)
                     : without_a_mesh();
  };
  throw LimitError(
      fmt::format("{}: needs about {:.0f} MB for {} vertices{}, {}; expected {}", name_of_input(s.input),
                  std::ceil(needed / megabyte), vertices,
                  added > 0 ? fmt::format(" and {:.0f} in the result", count + added) : "",
                  s.memory_limit > 0
                      ? fmt::format("--memory-limit allows {:g}", s.memory_limit)
                      : fmt::format("80 % of what is free are {:.0f} (--memory-limit)", allowed / megabyte),
                  remedy()));
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
