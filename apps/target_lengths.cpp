#include "target_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/ply.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/wedges.h"
#include "hooke/springs/sizing.h"
#include "hooke/springs/target_lengths.h"
#include "result_warnings.h"

namespace hooke::app {
namespace {

constexpr double max_relative_length = .1;  // maximum, relative to the diagonal of the bounding box

std::vector<double> read_property(const std::string& property, const std::filesystem::path& mesh_file,
                                  int count) {
  const std::string name = printable(mesh_file.native());
  if (input_format_of(mesh_file) != MeshFormat::ply)
    throw Error(fmt::format("{}: sizing by the property {}; expected a PLY file; name a file of lengths",
                            name, in_quotes(property)));
  const FileBytes file = read_regular_file(mesh_file);
  std::vector<double> lengths = read_ply_lengths(file.text(), name, property);
  if (lengths.size() != static_cast<size_t>(count))
    throw InputError(fmt::format("{}: {} vertices, and {} when it was first read; it has been changed", name,
                                 lengths.size(), count));
  return lengths;
}

/// Throws Error if the lengths differ from the natural length by more than a factor of 1e6, because numbers
/// may then overflow.
void require_reasonable(const Settings& s, double min_length, double max_length, double natural) {
  constexpr double limit = 1e6;
  if (min_length >= natural / limit && max_length <= limit * natural) return;
  const bool sized = s.sizing.kind != SizingSource::Kind::none;
  throw Error(
      fmt::format("{} '{}': target lengths from {:.3g} to {:.3g} for {}; expected {:.3g} to {:.3g}, {:.0e} "
                  "times less and more than the natural length",
                  sized ? "--sizing" : "--length", sized ? s.sizing_text : s.length_text, min_length,
                  max_length, printable(s.input.string()), natural / limit, limit * natural, limit));
}

/// The creases that these lengths show.
std::vector<Edge> creases_at(const std::vector<double>& lengths, const Mat3X& points, const Adjacency& c,
                             const CreaseOptions& features) {
  std::vector<Edge> creases;
  for (int e : detect_creases(points, c, lengths, features))
    creases.push_back(c.edges[static_cast<size_t>(e)]);
  return creases;
}

/// The values at these indices.
std::vector<double> taken(const std::vector<double>& values, const std::vector<int>& indices) {
  std::vector<double> result;
  result.reserve(indices.size());
  for (const int i : indices) result.push_back(values[static_cast<size_t>(i)]);
  return result;
}

}  // namespace

std::vector<double> read_sizing(const SizingSource& source, const std::filesystem::path& mesh_file,
                                const Mat3X& points, const MemoryOrder& memory_order,
                                const CreaseOptions& features, const MeshOrigin& origin) {
  const Adjacency& c = *memory_order.adjacency;
  const int file_count = origin.vertex.empty() ? c.vertex_count : static_cast<int>(origin.merged.size());
  const auto of_vertices = [&](const std::vector<double>& values) {
    return memory_order.order.gather(origin.vertex.empty() ? values : taken(values, origin.vertex));
  };
  switch (source.kind) {
    case SizingSource::Kind::none:
      break;
    case SizingSource::Kind::file:
      return of_vertices(read_length_list(source.name, file_count));
    case SizingSource::Kind::ply_property:
      return of_vertices(read_property(source.name, mesh_file, file_count));
    case SizingSource::Kind::curvature: {
      const double diagonal = box_diagonal(points);
      const double error = source.percent ? source.chord_error / 100 * diagonal : source.chord_error;
      const double longest = max_relative_length * diagonal;
      Adjacency creased = c;
      split_wedges(creased, creases_at(curvature_lengths(points, c, error, longest), points, c, features));
      return curvature_lengths(points, creased, error, longest);
    }
  }
  return {};
}

void set_target_lengths(const Settings& s, TriMesh& mesh, const MemoryOrder& memory_order,
                        const MeshOrigin& origin, const Mat3X& points, RunRecord& record) {
  const Adjacency& adjacency = *memory_order.adjacency;
  const Sizing sizing{
      read_sizing(s.sizing, s.input, points, memory_order, s.remesh.constraints.features, origin),
      s.gradation};
  const std::vector<double> lengths = resolve_vertex_lengths(s.length, sizing, points, adjacency);
  const double natural = resolve_length({}, points, adjacency);
  const auto [min_length, max_length] = std::ranges::minmax_element(lengths);
  require_reasonable(s, *min_length, *max_length, natural);
  set_vertex_values(mesh, target_length_property, memory_order.order.scatter(lengths));

  const TargetLengths targets = spread_target_lengths(adjacency, lengths);
  record.parameters.update({{"L", mean_length(points, adjacency, targets)},
                            {"L_min", *min_length},
                            {"L_max", *max_length},
                            {"L_spec", printable(s.length_text)},
                            {"L_natural", natural},
                            {"sizing", printable(s.sizing_text)}});
  const bool limited = s.sizing.kind != SizingSource::Kind::none && std::isfinite(s.gradation);
  record.parameters["gradation"] = limited ? nlohmann::ordered_json(s.gradation) : nlohmann::ordered_json();
  if (!s.check && s.remesh.connectivity != ConnectivityMode::adapt)
    warn_of_length(s, covering_length(points, adjacency, targets), natural, record);
}

}  // namespace hooke::app
