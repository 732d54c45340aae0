#include "hooke/mesh/wedges.h"

#include <algorithm>
#include <utility>

#include "hooke/core/lists.h"

namespace hooke {
namespace {

/// The sectors of faces between feature edges around one vertex.
class Sectors {
 public:
  Sectors(const Adjacency& c, int vertex) : c_(c), vertex_(vertex) {
    for (int f : c.vertex_faces[vertex])
      if (c.is_feature_edge(edge_at(f, 0))) starts_.push_back({neighbour_at(f), f});
    std::ranges::sort(starts_);
  }

  size_t count() const { return starts_.size(); }

  template <class Visit>
  void for_each_face(size_t sector, const Visit& visit) const {
    for (int f = starts_[sector][1];;) {
      visit(f);
      const int e = edge_at(f, 2);
      if (c_.is_feature_edge(e)) return;
      const auto& [left, right] = c_.edge_faces[e];
      f = left == f ? right : left;
    }
  }

 private:
  /// Edge of the face that leaves the vertex (0) or comes back to it (2).
  int edge_at(int face, size_t offset) const {
    const size_t f = face;
    return c_.face_edges[f][(corner_of(c_.faces[f], vertex_) + offset) % 3];
  }

  int neighbour_at(int face) const {
    const Triangle& t = c_.faces[face];
    return t[(corner_of(t, vertex_) + 1) % 3];
  }

  const Adjacency& c_;
  int vertex_;
  std::vector<std::array<int, 2>> starts_;  // neighbour and face
};

void mark(Adjacency& c, const std::vector<Edge>& creases) {
  c.creases.assign(c.edges.size(), 0);
  for (const Edge& crease : creases) {
    const int a = crease[0], b = crease[1];
    const auto edges = c.vertex_edges[a];
    const auto edge = std::ranges::find_if(edges, [&](int e) { return c.other_end(e, a) == b; });
    if (edge != edges.end()) c.creases[*edge] = 1;
  }
}

}  // namespace

void split_wedges(Adjacency& c, const std::vector<Edge>& creases) {
  if (creases.empty()) return;
  mark(c, creases);
  c.wedge_faces = c.faces;
  c.extra_wedges.clear();
  std::vector<int> touched;
  for (size_t e = 0; e < c.edges.size(); ++e)
    if (c.creases[e]) touched.insert(touched.end(), c.edges[e].begin(), c.edges[e].end());
  sort_unique(touched);
  for (int v : touched) {
    const Sectors sectors(c, v);
    for (size_t s = 1; s < sectors.count(); ++s) {
      const int wedge = c.wedge_count();
      sectors.for_each_face(s, [&](int f) { c.wedge_faces[f][corner_of(c.faces[f], v)] = wedge; });
      c.extra_wedges.push_back(v);
    }
  }
  c.wedge_edges.resize(c.edges.size());
  for (size_t e = 0; e < c.edges.size(); ++e) {
    const size_t f = c.edge_faces[e][0];
    for (size_t k = 0; k < 2; ++k)
      c.wedge_edges[e][k] = c.wedge_faces[f][corner_of(c.faces[f], c.edges[e][k])];
  }
}

Adjacency without_creases(Adjacency c) {
  c.creases.clear();
  c.wedge_faces.clear();
  c.wedge_edges.clear();
  c.extra_wedges.clear();
  return c;
}

std::vector<Edge> crease_edges(const Adjacency& c) {
  std::vector<Edge> creases;
  for (size_t e = 0; e < c.creases.size(); ++e)
    if (c.creases[e]) creases.push_back(c.edges[e]);
  return creases;
}

Adjacency cut_open(const Adjacency& c) {
  return make_adjacency(c.wedge_count(), c.wedges_of_faces());
}

std::vector<int> wedges_before(const Adjacency& c, const std::vector<Triangle>& wedges,
                               std::vector<int> vertices) {
  std::vector<int> before = std::move(vertices);
  before.resize(c.wedge_count(), -1);
  for (size_t f = 0; f < wedges.size(); ++f)
    for (size_t k = 0; k < 3; ++k) before[c.wedges_of_faces()[f][k]] = wedges[f][k];
  return before;
}

std::vector<int> other_wedges(std::size_t vertex_count, const std::vector<int>& extra_wedges) {
  if (extra_wedges.empty()) return {};
  std::vector<int> others(vertex_count, -1);
  for (size_t s = extra_wedges.size(); s-- > 0;) others[extra_wedges[s]] = static_cast<int>(vertex_count + s);
  return others;
}

Mat3X wedge_points(const Mat3X& points, const Adjacency& c) {
  Mat3X wedges(3, c.wedge_count());
  wedges.leftCols(points.cols()) = points;
  for (size_t s = 0; s < c.extra_wedges.size(); ++s)
    wedges.col(points.cols() + static_cast<Eigen::Index>(s)) = points.col(c.extra_wedges[s]);
  return wedges;
}

std::vector<int> label_components(const Adjacency& c) {
  std::vector<int> label(c.vertex_count, -1);
  int count = 0;
  for (int start = 0; start < c.vertex_count; ++start) {
    if (label[start] >= 0) continue;
    std::vector<int> front = {start};
    label[start] = count;
    while (!front.empty()) {
      const int v = front.back();
      front.pop_back();
      for (int w : c.vertex_neighbours[v])
        if (int& l = label[w]; l < 0) {
          l = count;
          front.push_back(w);
        }
    }
    ++count;
  }
  return label;
}

}  // namespace hooke
