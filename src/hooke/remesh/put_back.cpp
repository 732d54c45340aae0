#include "hooke/remesh/put_back.h"

#include <limits>
#include <numeric>
#include <vector>

#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/attempts.h"
#include "hooke/remesh/flaws.h"
#include "hooke/remesh/limiting_factors.h"

namespace hooke {
namespace {

/// Moves the vertices to their places in the input, and those within `rings` rings around them the less,
/// the farther away they are; not those at junctions, which might leave their curves.
void move_back(const AttemptMaker& maker, const std::vector<int>& vertices, int rings, Attempt& run) {
  const auto points = vertex_points(run.mesh);
  const auto input = vertex_points(maker.mesh());
  const Adjacency& c = maker.input().adjacency;
  std::vector<int> ring(c.vertex_count, rings), front = maker.with_copies(vertices);
  std::vector<char> at_junction(c.vertex_count, 0);
  for (int v : find_junctions(c, maker.input().joined).vertices) at_junction[v] = 1;
  for (int v : front) ring[v] = 0;
  for (size_t i = 0; i < front.size(); ++i)
    for (int n : c.vertex_neighbours[front[i]]) {
      const int next = ring[front[i]] + 1;
      if (next >= ring[n]) continue;
      ring[n] = next;
      front.push_back(n);
    }
  for (int v : front) {
    const int id = maker.id_of(v);
    const double share = static_cast<double>(ring[v]) / rings;
    if (share > 0 && at_junction[v]) continue;
    if (share == 0) run.result.vertex_limits[id] |= VertexLimit::put_back;
    maker.place(v, input.col(id) + share * (points.col(id) - input.col(id)), run);
  }
  maker.judge(run);
}

}  // namespace

void put_back_around_flaws(const AttemptMaker& maker, Attempt& run, int max_rings) {
  for (int rings = 1; rings <= max_rings && !maker.keeps_all(run); rings *= 2) {
    run.result.rescue = Rescue::put_back;
    const double margin = rings <= 2 ? 2 : 0;  // degrees; clearly worse polygons first
    move_back(maker,
              run.keeps_promises() ? maker.vertices_of_worse_polygons(run, margin)
                                   : vertices_to_put_back(maker, run),
              rings, run);
  }
}

void put_all_back(const AttemptMaker& maker, Attempt& run) {
  std::vector<int> all(maker.input().adjacency.vertex_count);
  std::iota(all.begin(), all.end(), 0);
  run.result.rescue = Rescue::put_back;
  move_back(maker, all, 1, run);
}

void leave_what_hardly_moved(const AttemptMaker& maker, Attempt& run) {
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * maker.input().extent.diagonal;
  auto points = vertex_points(run.mesh);
  const Mat3X before = maker.as_written(vertex_points(maker.mesh()));
  bool is_moved = false;
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    if (points.col(v) == before.col(v) || !((points.col(v) - before.col(v)).norm() <= rounding)) continue;
    points.col(v) = before.col(v);
    is_moved = true;
  }
  if (is_moved) maker.judge(run);
}

}  // namespace hooke
