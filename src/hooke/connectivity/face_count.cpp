#include "hooke/connectivity/face_count.h"

#include <algorithm>
#include <cmath>

#include "hooke/connectivity/edge_collapses.h"
#include "hooke/connectivity/edge_queue.h"
#include "hooke/connectivity/edge_splits.h"
#include "hooke/constraints/constraints.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

constexpr double largest_part = .02;   // maximum share of the edges changed in one call
constexpr double valence_weight = .1;  // of the valence excess against l / L when edges are chosen

CollapseOptions collapse_options() {
  return {.longest = 1.6, .valence = 8};
}

int face_count(const HalfedgeMesh& t) {
  int count = 0;
  for (int f = 0; f < t.half_edge_count() / 3; ++f) count += !t.is_removed(f);
  return count;
}

/// Valence excess of the vertex from which h starts, over 6, or 4 on the boundary; 0 at corners with a target
/// valence.
int valence_excess(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  if (m.vertices.corner_valences[t.wedge(h)] > 0) return 0;
  return t.valence(t.from(h)) - (t.on_boundary(t.from(h)) ? 4 : 6);
}

struct Candidate {
  double badness;
  int half_edge;
  bool operator<(const Candidate& other) const {
    return std::pair(badness, half_edge) < std::pair(other.badness, other.half_edge);
  }
};

/// The `count` inner edges that are best for a split or a collapse, or all if there are fewer; best first.
std::vector<Candidate> candidates(const WorkingMesh& m, bool split, size_t count, double weight) {
  const HalfedgeMesh& t = m.halfedges;
  std::vector<Candidate> edges;
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.is_removed(h / 3) || t.is_feature_edge(h) || t.twin(h) > h) continue;
    const int twin = t.twin(h);
    const int ends = valence_excess(m, h) + valence_excess(m, twin);
    const int opposite =
        valence_excess(m, HalfedgeMesh::previous(h)) + valence_excess(m, HalfedgeMesh::previous(twin));
    const double l = relative_length(m, h);
    edges.push_back({split ? -l + weight * opposite : l + weight * (ends - opposite), h});
  }
  count = std::min(count, edges.size());
  std::partial_sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(count), edges.end());
  edges.resize(count);
  return edges;
}

/// The number of equilateral faces with its target lengths that a face has the area of.
double target_face_count(const Mat3X& points, const std::vector<double>& vertex_length,
                         const Triangle& face) {
  double length = 0;
  for (int v : face) length += vertex_length[v] / 3;
  return 4 * face_shape(points, face).area / (std::sqrt(3.) * length * length);
}

}  // namespace

double target_face_count(const Mat3X& points, const std::vector<double>& vertex_length,
                         const std::vector<Triangle>& faces) {
  double count = 0;
  for (const Triangle& t : faces) count += target_face_count(points, vertex_length, t);
  return count;
}

double target_face_count(const VertexTable& vertices, const std::vector<Triangle>& faces) {
  double count = 0;
  for (const Triangle& t : faces)
    count += vertices.constraints.is_frozen(t)
                 ? 1
                 : target_face_count(vertices.positions.points, vertices.vertex_length, t);
  return count;
}

CountChanges match_curve_edges(WorkingMesh& m) {
  CountChanges changes;
  if (m.vertices.constraints.curves.empty()) return changes;
  const HalfedgeMesh& t = m.halfedges;
  const auto lacking = [&](int h) {  // edges missing on the curve of h
    const int curve = t.is_feature_edge(h) ? curve_of(m, h).curve : -1;
    if (curve < 0) return 0;
    return m.curve_edges.target[curve] - m.curve_edges.present[curve];
  };
  const auto feature_edge_length = [&](int h) { return t.is_feature_edge(h) ? relative_length(m, h) : 0; };

  const CollapseOptions collapse = collapse_options();
  EdgeQueue longest(t, feature_edge_length);
  for (int h = longest.pop(); h >= 0; h = longest.pop()) {
    if (lacking(h) <= 0) continue;
    const int v = split_edge(m, h);
    if (v < 0) continue;
    longest.push_around(v);
    ++changes.splits;
  }
  EdgeQueue shortest(t, [&](int h) { return t.is_feature_edge(h) ? 1 / (1e-9 + relative_length(m, h)) : 0; });
  for (int h = shortest.pop(); h >= 0; h = shortest.pop()) {
    if (lacking(h) >= 0) continue;
    const int v = collapse_edge(m, h, collapse);
    if (v < 0) continue;
    shortest.push_around(v);
    ++changes.collapses;
  }
  m.retraction.count();
  return changes;
}

int changes_towards(double target, double faces) {
  const int max_changes = std::max(1, static_cast<int>(largest_part * 1.5 * faces));
  const double missing = (target - faces) / 2;  // a split adds two faces, a collapse removes two
  return std::min(max_changes, static_cast<int>(std::lround(std::abs(missing))));
}

CountChanges approach_face_count(WorkingMesh& m, double target) {
  CountChanges changes;
  HalfedgeMesh& t = m.halfedges;
  const int faces = face_count(t);
  const bool split = target > faces;
  const CollapseOptions collapse = collapse_options();
  const int count = changes_towards(target, faces);
  std::vector<char> touched(t.id_count() + count, 0);
  int done = 0;
  for (const Candidate& c : candidates(m, split, 8 * static_cast<size_t>(count) + 64, valence_weight)) {
    if (done == count) break;
    const int h = c.half_edge;
    if (t.is_removed(h / 3) || t.twin(h) < 0) continue;
    const auto near = [&](int v) { return touched[v] != 0; };
    if (near(t.from(h)) || near(t.to(h))) continue;
    const int v = split ? split_edge(m, h) : collapse_edge(m, h, collapse);
    if (v < 0) continue;
    touched[v] = 1;
    for (int w : t.neighbours(v)) touched[w] = 1;
    ++done;
  }
  m.retraction.count();
  (split ? changes.splits : changes.collapses) = done;
  return changes;
}

}  // namespace hooke
