#include "target_lengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hooke/constraints/crease_detection.h"
#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/ply.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/wedges.h"
#include "hooke/springs/narrow_regions.h"
#include "hooke/springs/sizing.h"
#include "hooke/springs/target_lengths.h"
#include "mesh_memory.h"
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
  if (std::cmp_not_equal(lengths.size(), count))
    throw InputError(fmt::format("{}: {} vertices, and {} when it was first read; it has been changed", name,
                                 lengths.size(), count));
  return lengths;
}

/// Throws InputError unless each target length of a face is shorter than the other two together.
void require_triangles(const std::string& name, const std::vector<double>& of_edges, const Adjacency& c,
                       const MeshIds& ids) {
  for (size_t f = 0; f < c.faces.size(); ++f) {
    std::array<double, 3> l{};
    for (size_t k = 0; k < 3; ++k) l[k] = of_edges[c.face_edges[f][k]];
    if (2 * std::ranges::max(l) < l[0] + l[1] + l[2]) continue;
    const Triangle corners = ids.corners(c.faces[f]);
    throw InputError(fmt::format(
        "{}: lengths {:.6g}, {:.6g} and {:.6g} for the edges of face {} ({} {} {}); expected each "
        "shorter than the other two together; lengthen the short ones",
        name, l[0], l[1], l[2], ids.face(static_cast<int>(f)), corners[0], corners[1], corners[2]));
  }
}

/// The target lengths of all edges: those of the file, and of others the mean of their ends.
std::vector<double> lengths_of_edges(const Settings& s, const std::vector<double>& of_vertices,
                                     const MemoryOrder& memory_order) {
  const Adjacency& c = *memory_order.adjacency;
  const std::string name = printable(s.edge_lengths.native());
  std::vector<double> lengths = spread_target_lengths(c, of_vertices).edge.values();
  const std::vector<EdgeLength> given =
      s.edge_length_list ? *s.edge_length_list : read_edge_lengths(s.edge_lengths, c.vertex_count);
  std::vector<int> ends, line_of_edge(lengths.size(), 0);
  for (const EdgeLength& edge : given) ends.insert(ends.end(), edge.ends.begin(), edge.ends.end());
  ends = memory_order.order.new_vertices(ends);
  for (size_t k = 0; k < given.size(); ++k) {
    const int v = ends[2 * k], w = ends[2 * k + 1];
    const auto around = c.vertex_edges[v];
    const auto edge = std::ranges::find_if(around, [&](int e) { return c.other_end(e, v) == w; });
    const auto fail = [&](const std::string& problem) {
      throw InputError(fmt::format("{}:{}: {}", name, given[k].line, problem));
    };
    if (edge == around.end())
      fail(fmt::format("no edge from vertex {} to {}; expected an edge of the mesh; remove the line",
                       given[k].ends[0], given[k].ends[1]));
    int& line = line_of_edge[*edge];
    if (line > 0)
      fail(fmt::format("edge {} {} a second time, after line {}; expected it once; remove one",
                       given[k].ends[0], given[k].ends[1], line));
    line = given[k].line;
    lengths[*edge] = given[k].length;
  }
  require_triangles(name, lengths, c, memory_order.order.old_ids());
  return lengths;
}

/// The mean target length of the edges at each vertex, and of an isolated vertex its own.
std::vector<double> means_at_vertices(const std::vector<double>& of_edges, const Adjacency& c,
                                      std::vector<double> lengths) {
  for (int v = 0; v < c.vertex_count; ++v) {
    const auto around = c.vertex_edges[v];
    if (around.empty()) continue;
    double sum = 0;
    for (int e : around) sum += of_edges[e];
    lengths[v] = sum / static_cast<double>(around.size());
  }
  return lengths;
}

/// Throws Error if the lengths differ from the natural length by more than a factor of 1e6, because numbers
/// may then overflow.
void require_reasonable(const Settings& s, double min_length, double max_length, double natural) {
  constexpr double limit = 1e6;
  if (min_length >= natural / limit && max_length <= limit * natural) return;
  const bool sized = s.sizing.kind != SizingSource::Kind::none, edges = !s.edge_lengths.empty();
  throw Error(fmt::format(
      "{} '{}': target lengths from {:.3g} to {:.3g} for {}; expected {:.3g} to {:.3g}, {:.0e} "
      "times less and more than the natural length",
      edges   ? "--edge-lengths"
      : sized ? "--sizing"
              : "--length",
      edges   ? printable(s.edge_lengths.native())
      : sized ? s.sizing_text
              : s.length_text,
      min_length, max_length, printable(s.input.string()), natural / limit, limit * natural, limit));
}

/// The creases that these lengths show.
std::vector<Edge> creases_at(const std::vector<double>& lengths, const Mat3X& points, const Adjacency& c,
                             const CreaseOptions& features, const std::vector<Edge>& hard_edges = {}) {
  std::vector<Edge> creases;
  for (int e : detect_creases(points, c, lengths, features, hard_edges)) creases.push_back(c.edges[e]);
  return creases;
}

/// The values at these indices.
std::vector<double> taken(const std::vector<double>& values, const std::vector<int>& indices) {
  std::vector<double> result;
  result.reserve(indices.size());
  for (const int i : indices) result.push_back(values[i]);
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
    case SizingSource::Kind::values:
      return of_vertices(source.values);
    case SizingSource::Kind::file:
      return of_vertices(read_length_list(source.name, file_count));
    case SizingSource::Kind::ply_property:
      return of_vertices(read_property(source.name, mesh_file, file_count));
    case SizingSource::Kind::curvature: {
      const double diagonal = box_of_faces(points, c.faces).diagonal().norm();
      const double error = source.percent ? source.chord_error / 100 * diagonal : source.chord_error;
      const double longest = max_relative_length * diagonal;
      Adjacency creased = c;
      split_wedges(creased, creases_at(curvature_lengths(points, c, error, longest), points, c, features));
      return curvature_lengths(points, creased, error, longest);
    }
    case SizingSource::Kind::input:
      return input_lengths(points, c);
  }
  return {};
}

void set_target_lengths(const Settings& s, TriMesh& mesh, const MemoryOrder& memory_order,
                        const MeshOrigin& origin, RunRecord& record) {
  const Adjacency& adjacency = *memory_order.adjacency;
  const Mat3X points = memory_order.order.gather(vertex_points(mesh));
  const Sizing sizing{
      read_sizing(s.sizing, s.input, points, memory_order, s.remesh.constraints.features, origin),
      s.remesh.gradation};
  std::vector<double> lengths =
      resolve_vertex_lengths(s.length, sizing, points, adjacency, joined_vertices(mesh, memory_order.order));
  std::vector<double> of_edges;
  if (!s.edge_lengths.empty()) {
    of_edges = lengths_of_edges(s, lengths, memory_order);
    lengths = means_at_vertices(of_edges, adjacency, std::move(lengths));
    set_edge_values(mesh, edge_length_property, memory_order.order, adjacency, of_edges);
  }
  const double natural = resolve_length({}, points, adjacency);
  const auto [min_length, max_length] = std::ranges::minmax_element(of_edges.empty() ? lengths : of_edges);
  require_reasonable(s, *min_length, *max_length, natural);
  set_vertex_values(mesh, target_length_property, memory_order.order.scatter(lengths));

  const TargetLengths targets = of_edges.empty() ? spread_target_lengths(adjacency, lengths)
                                                 : from_edge_lengths(adjacency, std::move(of_edges));
  record.target = {mean_length(points, adjacency, targets), *min_length, *max_length, natural};
  const double covering = covering_length(points, adjacency, targets);
  record.target.faces = static_cast<double>(adjacency.faces.size()) * std::pow(natural / covering, 2);
  record.parameters.update({{"L_spec", printable(s.length_text)},
                            {"sizing", printable(s.sizing_text)},
                            {"edge_lengths", nullptr}});
  if (!s.edge_lengths.empty()) record.parameters["edge_lengths"] = printable(s.edge_lengths.native());
  const double gradation = s.remesh.gradation;
  const bool limited =
      (s.sizing.kind != SizingSource::Kind::none || s.min_length) && std::isfinite(gradation);
  record.parameters["gradation"] = limited ? nlohmann::ordered_json(gradation) : nlohmann::ordered_json();
  if (!s.check && s.edge_lengths.empty() && s.remesh.connectivity != ConnectivityMode::adapt &&
      s.length.kind != LengthSpec::Kind::natural)
    warn_of_length(s, covering, natural, record);
}

void set_min_length(Settings& s, const TriMesh& mesh, const MemoryOrder& memory_order, const Mat3X& points,
                    RunRecord& record) {
  record.parameters["min_length"] = nullptr;
  if (!s.min_length) return;
  const Adjacency& c = *memory_order.adjacency;
  const double shortest = resolve_length(*s.min_length, points, c);
  s.remesh.min_length = shortest;
  record.parameters["min_length"] = shortest;
  constexpr double least_share = 1e-4;  // of the longest; less takes too many pieces of long narrow regions
  if (shortest >= record.target.max || shortest < least_share * record.target.max)
    throw Error(fmt::format(
        "--min-length {}: {:.6g} for {}, whose target length is up to {:.6g}; expected less than that, and "
        "at "
        "least {:.0e} of it",
        in_quotes(s.min_length_text), shortest, printable(s.input.string()), record.target.max, least_share));
  if (s.memory_limit <= 0 || s.check) return;
  const std::vector<double> lengths = memory_order.order.gather(vertex_values(mesh, target_length_property));
  Adjacency creased = c;
  const ConstraintOptions& kept = s.remesh.constraints;
  std::vector<Edge> creases =
      creases_at(lengths, points, c, kept.features, memory_order.order.new_edges(kept.hard_edges));
  const std::vector<Edge> seams = memory_order.order.new_edges(kept.seams);
  creases.insert(creases.end(), seams.begin(), seams.end());
  split_wedges(creased, creases);
  const std::vector<PlacedLength> widths = lengths_of_narrow_regions(points, creased, lengths, shortest);
  record.target.faces = PlacedLengths(widths, shortest, s.remesh.gradation)
                            .covering_faces(points, c.faces, lengths, most_faces(s));
}

}  // namespace hooke::app
