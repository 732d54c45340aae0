#include "hooke/remesh/kept_faces.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/normals.h"
#include "hooke/springs/sizing.h"

namespace hooke {

KeptFaces::KeptFaces(AttemptMaker& maker)
    : maker_(maker),
      lengths_before_(maker.lengths.of_vertices),
      frozen_before_(maker.options.constraints.frozen_vertices),
      mean_edges_(mean_edge_lengths(maker.input().points, maker.input().adjacency)),
      rings_(maker.input().adjacency.vertex_count, 0) {}

KeptFaces::~KeptFaces() {
  maker_.options.constraints.frozen_vertices = frozen_before_;
}

bool KeptFaces::add_around(const std::vector<int>& vertices, int least_rings) {
  const Adjacency& c = maker_.input().adjacency;
  const std::vector<int> before = rings_;
  std::vector<int> front = maker_.with_copies(vertices), rings(c.vertex_count, 0), left(c.vertex_count, -1);
  for (int v : front) {
    int last = rings_[v];
    for (int n : c.vertex_neighbours[v]) last = std::max(last, rings_[n]);
    rings[v] = left[v] = std::max(least_rings, 2 * last);
  }
  for (std::size_t i = 0; i < front.size(); ++i) {
    const int v = front[i];
    if (left[v] == 0) continue;
    for (int n : c.vertex_neighbours[v]) {
      if (left[n] >= left[v] - 1) continue;
      left[n] = left[v] - 1;
      rings[n] = std::max(rings[n], rings[v]);
      front.push_back(n);
    }
  }
  for (int v = 0; v < c.vertex_count; ++v) rings_[v] = std::max(rings_[v], rings[v]);
  std::vector<int> kept;
  for (int v = 0; v < c.vertex_count; ++v)
    if (rings_[v] > 0) kept.push_back(v);
  for (int v : maker_.with_copies(kept)) rings_[v] = std::max(rings_[v], 1);
  return rings_ != before;
}

double KeptFaces::share_of_area() const {
  double all = 0, kept = 0;
  for (const Triangle& t : maker_.input().adjacency.faces) {
    const double area = face_shape(maker_.input().points, t).area;
    all += area;
    if (std::ranges::all_of(t, [&](int v) { return rings_[v] != 0; })) kept += area;
  }
  return kept / all;
}

void KeptFaces::hold() {
  const MeasuredSurface& input = maker_.input();
  std::vector<int>& frozen = maker_.options.constraints.frozen_vertices;
  frozen = frozen_before_;
  std::vector<double> longest(rings_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < rings_.size(); ++v) {
    if (rings_[v] == 0) continue;
    frozen.push_back(maker_.id_of(static_cast<int>(v)));
    longest[v] = std::min(lengths_before_[v], mean_edges_[static_cast<Eigen::Index>(v)]);
  }
  if (!maker_.adapts()) return;
  limit_gradation(input.points, input.adjacency, Sizing().gradation, longest);
  for (std::size_t v = 0; v < longest.size(); ++v)
    maker_.lengths.of_vertices[v] = std::min(lengths_before_[v], longest[v]);
}

}  // namespace hooke
