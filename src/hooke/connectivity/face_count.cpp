#include "hooke/connectivity/face_count.h"

#include <algorithm>
#include <cmath>

#include "hooke/connectivity/edge_queue.h"
#include "hooke/constraints/constraints.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/working_mesh/working_mesh.h"

namespace hooke {
namespace {

int face_count(const HalfedgeMesh& t) {
  int count = 0;
  for (int f = 0; f < t.half_edge_count() / 3; ++f) count += !t.is_gone(f);
  return count;
}

/// How many edges more than six, four on a boundary, where h leaves; corners have what they want.
int excess(const WorkingMesh& m, int h) {
  const HalfedgeMesh& t = m.halfedges;
  if (m.corner_valences[static_cast<size_t>(t.wedge(h))] > 0) return 0;
  return t.valence(t.from(h)) - (t.on_boundary(t.from(h)) ? 4 : 6);
}

struct Candidate {
  double badness;
  int half_edge;
  bool operator<(const Candidate& other) const {
    return std::pair(badness, half_edge) < std::pair(other.badness, other.half_edge);
  }
};

/// Inner edges, the best for a split or a collapse first; at least `count` of them are sorted.
std::vector<Candidate> candidates(const WorkingMesh& m, bool split, size_t count, double weight) {
  const HalfedgeMesh& t = m.halfedges;
  std::vector<Candidate> edges;
  for (int h = 0; h < t.half_edge_count(); ++h) {
    if (t.is_gone(h / 3) || is_feature_edge(t, h) || t.twin(h) > h) continue;
    const int twin = t.twin(h);
    const int ends = excess(m, h) + excess(m, twin);
    const int apexes = excess(m, HalfedgeMesh::previous(h)) + excess(m, HalfedgeMesh::previous(twin));
    const double l = relative_length(m, h);
    edges.push_back({split ? -l + weight * apexes : l + weight * (ends - apexes), h});
  }
  count = std::min(count, edges.size());
  std::partial_sort(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(count), edges.end());
  edges.resize(count);
  return edges;
}

}  // namespace

double wanted_face_count(const Mat3X& points, const std::vector<Triangle>& faces,
                         const std::vector<double>& vertex_length) {
  double count = 0;
  for (const Triangle& t : faces) {
    double length = 0;
    for (int v : t) length += vertex_length[static_cast<size_t>(v)] / 3;
    count += 4 * face_shape(points, t).area / (std::sqrt(3.) * length * length);
  }
  return count;
}

CountChanges match_curve_edges(WorkingMesh& m, const CountOptions& options) {
  CountChanges changes;
  if (m.constraints.curves.empty()) return changes;
  const HalfedgeMesh& t = m.halfedges;
  const auto lacking = [&](int h) {  // edges on the curve of h
    const int curve = is_feature_edge(t, h) ? curve_of(m, h).curve : -1;
    if (curve < 0) return 0;
    return m.curve_edges.wanted[static_cast<size_t>(curve)] -
           m.curve_edges.present[static_cast<size_t>(curve)];
  };
  const auto rim_length = [&](int h) { return is_feature_edge(t, h) ? relative_length(m, h) : 0; };

  EdgeQueue longest(t, rim_length);
  for (int h = longest.pop(); h >= 0; h = longest.pop()) {
    if (lacking(h) <= 0) continue;
    const int v = split_edge(m, h, options.split);
    if (v < 0) continue;
    longest.push_about(v);
    ++changes.splits;
  }
  EdgeQueue shortest(t,
                     [&](int h) { return is_feature_edge(t, h) ? 1 / (1e-9 + relative_length(m, h)) : 0; });
  for (int h = shortest.pop(); h >= 0; h = shortest.pop()) {
    if (lacking(h) >= 0) continue;
    const int v = collapse_edge(m, h, options.collapse);
    if (v < 0) continue;
    shortest.push_about(v);
    ++changes.collapses;
  }
  m.retraction.count();
  return changes;
}

CountChanges approach_count(WorkingMesh& m, double wanted, const CountOptions& options) {
  CountChanges changes;
  HalfedgeMesh& t = m.halfedges;
  const int faces = face_count(t);
  const double missing = (wanted - faces) / 2;  // a split adds two faces, a collapse removes two
  const bool split = missing > 0;
  const int most = std::max(1, static_cast<int>(options.largest_part * 1.5 * faces));
  const int count = std::min(most, static_cast<int>(std::lround(std::abs(missing))));
  std::vector<char> touched(static_cast<size_t>(t.id_count() + count), 0);
  int done = 0;
  for (const Candidate& c :
       candidates(m, split, 8 * static_cast<size_t>(count) + 64, options.valence_weight)) {
    if (done == count) break;
    const int h = c.half_edge;
    if (t.is_gone(h / 3) || t.twin(h) < 0) continue;
    const auto near = [&](int v) { return touched[static_cast<size_t>(v)] != 0; };
    if (near(t.from(h)) || near(t.to(h))) continue;
    const int v = split ? split_edge(m, h, options.split) : collapse_edge(m, h, options.collapse);
    if (v < 0) continue;
    touched[static_cast<size_t>(v)] = 1;
    for (int w : t.neighbours(v)) touched[static_cast<size_t>(w)] = 1;
    ++done;
  }
  m.retraction.count();
  (split ? changes.splits : changes.collapses) = done;
  return changes;
}

}  // namespace hooke
