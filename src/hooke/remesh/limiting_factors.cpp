#include "hooke/remesh/limiting_factors.h"

#include <algorithm>

#include "hooke/constraints/constraints.h"
#include "hooke/integrator/guards.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/working_mesh/workspace.h"

namespace hooke {
namespace {

/// Degrees below the bound up to which the bound counts as reached.
constexpr double bound_tolerance = 1;

unsigned char limit_of_curve(const Workspace& work, size_t vertex) {
  const int curve = work.vertices.constraints.curve[vertex];
  const int creases =
      static_cast<int>(work.vertices.constraints.curves.size()) - work.vertices.constraints.crease_curves;
  return curve < 0 ? not_limited : curve < creases ? limited_by_boundary : limited_by_crease;
}

}  // namespace

std::vector<unsigned char> vertex_limits_of_result(const Workspace& work, const Guards& guards,
                                                   const ConstraintOptions& asked) {
  std::vector<int> fixed_vertices = asked.fixed_vertices;
  std::ranges::sort(fixed_vertices);
  const Adjacency& c = *work.adjacency;
  std::vector<unsigned char> vertex_limits(work.vertices.origins.size());
  for (size_t v = 0; v < vertex_limits.size(); ++v) vertex_limits[v] = limit_of_curve(work, v);
  for (size_t e = 0; e < c.edges.size(); ++e)
    for (const int v : c.edges[e]) {
      auto& limit = vertex_limits[v];
      if (c.edge_faces[e][1] < 0) limit |= limited_by_boundary;
      if (c.is_crease(static_cast<int>(e))) limit |= limited_by_crease;
    }
  for (size_t v = 0; v < vertex_limits.size(); ++v) {
    if (work.vertices.constraints.freedom[v] != Freedom::fixed ||
        work.vertices.constraints.at_bend(static_cast<int>(v)) ||
        work.vertices.constraints.slides_with_copies(static_cast<int>(v)))
      continue;
    const bool requested =
        std::ranges::binary_search(fixed_vertices, work.vertex_of_input(static_cast<int>(v))) ||
        (asked.boundary == BoundaryRule::fixed && (vertex_limits[v] & limited_by_boundary));
    const bool is_frozen = work.vertices.constraints.is_frozen(static_cast<int>(v), static_cast<int>(v));
    if (is_frozen) vertex_limits[v] |= put_back;
    if (requested)
      vertex_limits[v] |= limited_by_request;
    else if (!is_frozen)
      vertex_limits[v] |= limited_at_corner;
  }
  for (const int v : guards.vertices_at_limits(work.vertices.positions)) vertex_limits[v] |= limited_by_guard;

  std::vector<unsigned char> of_result(vertex_limits.size());
  for (size_t v = 0; v < vertex_limits.size(); ++v) of_result[work.order.old_vertex[v]] = vertex_limits[v];
  return of_result;
}

std::vector<std::string> limiting_factors(const WorstFace& face,
                                          const std::vector<unsigned char>& vertex_limits) {
  const bool bounded = face.min_angle >= face.bound.degrees - bound_tolerance;
  unsigned char all = 0;
  bool inside = false;
  const auto add = [&](int v) {
    const unsigned char limit = vertex_limits[v];
    inside = inside || (limit & ~(limited_by_guard | put_back)) == not_limited;
    all |= limit;
  };
  if (bounded)
    std::ranges::for_each(face.bound.vertices, add);
  else
    std::ranges::for_each(face.vertices, add);

  std::vector<std::string> names;
  if (all & limited_at_corner) names.push_back("corner");
  if (all & limited_by_request) names.push_back("fixed");
  if (all & limited_by_crease) names.push_back("crease");
  if (all & limited_by_boundary) names.push_back("boundary");
  if (bounded && inside) names.push_back("valence");
  if (!bounded && (all & put_back)) names.push_back("put_back");
  if (!bounded && (all & limited_by_guard)) names.push_back("guard");
  if (names.empty()) names.push_back("lengths");
  return names;
}

}  // namespace hooke
