#include "hooke/mesh/halfedge_mesh.h"

#include <algorithm>
#include <cassert>

#include "hooke/core/parallel.h"
#include "hooke/mesh/disjoint_sets.h"
#include "hooke/mesh/memory_order.h"

namespace hooke {

HalfedgeMesh::HalfedgeMesh(const Adjacency& c)
    : faces_(c.faces),
      wedges_(c.wedge_faces),
      twins_(3 * c.faces.size(), -1),
      outgoing_halfedge_(c.wedge_count(), -1),
      valences_(c.wedge_count(), -1),
      on_boundary_(c.wedge_count(), 0),
      constrained_(3 * c.faces.size(), 0) {
  std::fill_n(valences_.begin(), c.vertex_count, 0);
  std::vector<int> first(c.edges.size(), -1);
  for (size_t f = 0; f < faces_.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int h = static_cast<int>(3 * f + k);
      outgoing_halfedge_[faces_[f][k]] = h;
      int& other = first[c.face_edges[f][k]];
      if (other < 0)
        other = h;
      else
        link(h, other);
    }
  for (size_t e = 0; e < c.edges.size(); ++e)
    for (int v : c.edges[e]) {
      ++valences_[v];
      if (c.is_boundary_edge(static_cast<int>(e))) on_boundary_[v] = 1;
    }
  for (size_t h = 0; h < twins_.size(); ++h)
    if (c.is_crease(c.face_edges[h / 3][h % 3])) constrained_[h] = 1;
}

int HalfedgeMesh::first_outgoing(int vertex) const {
  const int any = outgoing_halfedge_[vertex];
  int start = any;
  if (any >= 0 && on_boundary(vertex))  // rotate clockwise to the boundary
    for (int t = twin(start); t >= 0 && next(t) != any; t = twin(start)) start = next(t);
  return start;
}

SmallIntList HalfedgeMesh::outgoing(int vertex) const {
  SmallIntList halfedges;
  const int first = first_outgoing(vertex);
  for (int h = first; h >= 0;) {
    halfedges.push_back(h);
    h = twin(previous(h));
    if (h == first) break;
  }
  return halfedges;
}

SmallIntList HalfedgeMesh::neighbours(int vertex) const {
  SmallIntList ring;
  const int first = first_outgoing(vertex);
  for (int h = first; h >= 0;) {
    ring.push_back(to(h));
    const int back = previous(h);
    h = twin(back);
    if (h < 0) ring.push_back(from(back));
    if (h == first) break;
  }
  return ring;
}

SmallIntList HalfedgeMesh::wedge_halfedges(int h) const {
  const int any = h;
  while (!is_feature_edge(h) && next(twin(h)) != any) h = next(twin(h));
  SmallIntList halfedges = {h};
  for (int halfedge = previous(h); !is_feature_edge(halfedge) && twin(halfedge) != halfedges.front();
       halfedge = previous(twin(halfedge)))
    halfedges.push_back(twin(halfedge));
  return halfedges;
}

bool HalfedgeMesh::on_crease(int vertex) const {
  return std::ranges::any_of(outgoing(vertex), [&](int h) { return is_crease(h) || is_crease(previous(h)); });
}

int HalfedgeMesh::half_edge(int from, int to) const {
  for (int h : outgoing(from))
    if (this->to(h) == to) return h;
  return -1;
}

bool HalfedgeMesh::adjacent(int a, int b) const {
  for (int h : outgoing(a))
    if (to(h) == b || opposite_vertex(h) == b) return true;
  return false;
}

void HalfedgeMesh::link(int h, int twin) {
  if (h >= 0) twins_[h] = twin;
  if (twin >= 0) twins_[twin] = h;
}

void HalfedgeMesh::flip(int h) {
  const int t = twin(h);
  assert(t >= 0 && !is_crease(h));
  const int a = from(h), b = to(h), c = opposite_vertex(h), d = opposite_vertex(t);
  const int ca = twin(previous(h)), bc = twin(next(h)), ad = twin(next(t)), db = twin(previous(t));
  const int f = h / 3, g = t / 3;
  const auto mark = [this](int halfedge) { return constrained_[halfedge]; };
  const std::array<char, 4> marks = {mark(previous(h)), mark(next(t)), mark(previous(t)), mark(next(h))};
  if (!wedges_.empty()) {  // both faces stay in their wedges
    const int sa = wedge(h), sb = wedge(t), sc = wedge(previous(h)), sd = wedge(previous(t));
    wedges_[f] = {sc, sa, sd};
    wedges_[g] = {sd, sb, sc};
  }
  faces_[f] = {c, a, d};
  faces_[g] = {d, b, c};
  link(3 * f, ca);
  link(3 * f + 1, ad);
  link(3 * f + 2, 3 * g + 2);
  link(3 * g, db);
  link(3 * g + 1, bc);
  for (size_t i = 0; i < 4; ++i) constrained_[(i < 2 ? 3 * f : 3 * g) + i % 2] = marks[i];
  constrained_[3 * f + 2] = constrained_[3 * g + 2] = 0;
  outgoing_halfedge_[c] = 3 * f;
  outgoing_halfedge_[a] = 3 * f + 1;
  outgoing_halfedge_[d] = 3 * g;
  outgoing_halfedge_[b] = 3 * g + 1;
  --valences_[a];
  --valences_[b];
  ++valences_[c];
  ++valences_[d];
}

/// Splits the face of h between its opposite vertex and the new vertex, whose wedge there is `wedge`. h then
/// ends at the new vertex; the other half is a new face at the end.
void HalfedgeMesh::split(int h, int vertex, int wedge) {
  const int b = to(h), c = opposite_vertex(h), across = twin(next(h));
  const size_t f = h / 3, cut = next(h);
  const int g = static_cast<int>(twins_.size());  // first half-edge of the new face
  if (!wedges_.empty()) {
    wedges_.push_back({wedge, this->wedge(next(h)), this->wedge(previous(h))});
    wedges_[f][cut % 3] = wedge;
  }
  faces_[f][cut % 3] = vertex;
  faces_.push_back({vertex, b, c});
  twins_.insert(twins_.end(), 3, -1);
  constrained_.insert(constrained_.end(), {constrained_[h], constrained_[cut], 0});
  constrained_[cut] = 0;
  link(g + 1, across);
  link(g + 2, next(h));
  outgoing_halfedge_[vertex] = g;
  outgoing_halfedge_[b] = g + 1;
  ++valences_[vertex];
  ++valences_[c];
}

int HalfedgeMesh::split(int h) {
  const int t = twin(h), a = from(h);
  const int vertex = id_count(), right_wedge = is_crease(h) ? vertex + 1 : vertex;
  valences_.push_back(2);
  if (right_wedge != vertex) valences_.push_back(-1);
  outgoing_halfedge_.resize(valences_.size(), -1);
  on_boundary_.resize(valences_.size(), t < 0);
  split(h, vertex, vertex);
  const int back_half = half_edge_count() - 3;  // from the vertex to the old end of h
  outgoing_halfedge_[a] = h;
  if (t < 0) return vertex;
  split(t, vertex, right_wedge);
  link(h, half_edge_count() - 3);
  link(t, back_half);
  return vertex;
}

bool HalfedgeMesh::keeps_topology(int h) const {
  const int a = from(h), b = to(h), t = twin(h);
  if (t >= 0 && on_boundary(a) && on_boundary(b)) return false;
  const auto may_lose = [this](int v) { return valence(v) > (on_boundary(v) ? 2 : 3); };
  for (int halfedge : {h, t})
    if (halfedge >= 0 && (!may_lose(opposite_vertex(halfedge)) ||
                          (is_feature_edge(next(halfedge)) && is_feature_edge(previous(halfedge)))))
      return false;
  const SmallIntList ring = neighbours(a);
  int common = 0;
  for (int v : neighbours(b)) common += std::ranges::count(ring, v) > 0;
  return common == (t < 0 ? 1 : 2);
}

void HalfedgeMesh::mark_junctions(const std::vector<int>& places) {
  place_ = places;
  sheet_.assign(places.size(), -1);
  sheets_at_.clear();
  if (places.empty()) return;
  sheets_at_.resize(std::ranges::max(places) + 1);
  DisjointSets sheets(id_count());
  for (const Triangle& t : faces_)
    if (t[0] >= 0) {
      sheets.join({t[0], t[1]});
      sheets.join({t[0], t[2]});
    }
  for (std::size_t v = 0; v < places.size(); ++v) {
    if (places[v] < 0) continue;
    sheet_[v] = sheets.root(static_cast<int>(v));
    sheets_at_[places[v]].push_back(sheet_[v]);
  }
}

void HalfedgeMesh::mark_junction(int vertex, int place) {
  const std::size_t v = vertex, p = place;
  const SmallIntList ring = neighbours(vertex);
  const int other = *std::ranges::find_if(ring, [this](int n) { return at_junction(n); });
  if (place_.size() <= v) {
    place_.resize(v + 1, -1);
    sheet_.resize(v + 1, -1);
  }
  if (sheets_at_.size() <= p) sheets_at_.resize(p + 1);
  place_[v] = place;
  sheet_[v] = sheet_[other];
  sheets_at_[p].push_back(sheet_[v]);
}

/// Is one of the vertices at no junction, or have their places one sheet in common and one copy each in it?
bool HalfedgeMesh::may_join_places(int a, int b) const {
  if (!at_junction(a) || !at_junction(b)) return true;
  std::ptrdiff_t pairs = 0;
  for (int sheet : sheets_at_[place_[a]]) pairs += std::ranges::count(sheets_at_[place_[b]], sheet);
  return pairs == 1;
}

/// What may_collapse() says of places at junctions.
bool HalfedgeMesh::keeps_places(int h) const {
  const int a = from(h), b = to(h);
  if (at_junction(a) == at_junction(b)) return !at_junction(a);
  const int stays = at_junction(a) ? a : b, goes = at_junction(a) ? b : a;
  const auto is_allowed = [&](int outgoing) {
    const int p = to(outgoing), q = opposite_vertex(outgoing);
    if (p == stays || q == stays) return true;
    for (int v : {p, q})
      if (!adjacent(stays, v) && !may_join_places(stays, v)) return false;
    return may_join_places(stays, p) || may_join_places(stays, q) || may_join_places(p, q);
  };
  return std::ranges::all_of(outgoing(goes), is_allowed);
}

/// Removes the face of h and links the faces across its other two edges.
void HalfedgeMesh::close(int h) {
  const int b = to(h), c = opposite_vertex(h);
  const int left = twin(next(h)), right = twin(previous(h));
  const bool marked = is_crease(next(h)) || is_crease(previous(h));
  if (left >= 0) twins_[left] = right;
  if (right >= 0) twins_[right] = left;
  for (int halfedge : {left, right})
    if (halfedge >= 0) constrained_[halfedge] = marked;
  outgoing_halfedge_[b] = left >= 0 ? next(left) : right;
  outgoing_halfedge_[c] = left >= 0 ? left : next(right);
  --valences_[c];
  faces_[h / 3] = {-1, -1, -1};
  for (int halfedge : {h, next(h), previous(h)}) {
    twins_[halfedge] = -1;
    constrained_[halfedge] = 0;
  }
}

int HalfedgeMesh::wedge_after_collapse(int h, int stays, int out) const {
  if (from(out) == stays) return wedge(out);
  const auto at = [this](int along, int end) { return wedge(from(along) == end ? along : next(along)); };
  const bool on_the_left = twin(h) < 0 || wedge(out) == at(h, from(out));
  return at(on_the_left ? h : twin(h), stays);
}

void HalfedgeMesh::collapse(int h, int stays) {
  assert(keeps_topology(h));
  const int removed = from(h) == stays ? to(h) : from(h), t = twin(h);
  const SmallIntList halfedges = outgoing(removed);
  SmallIntList wedges;
  for (int out : halfedges) wedges.push_back(wedge_after_collapse(h, stays, out));
  for (size_t i = 0; i < halfedges.size(); ++i) {
    const size_t f = halfedges[i] / 3, k = halfedges[i] % 3;
    faces_[f][k] = stays;
    if (!wedges_.empty()) wedges_[f][k] = wedges[i];
  }
  // `stays` gains the edges of `removed`, except those to `stays` and to the opposite vertices.
  valences_[stays] += valences_[removed] - (t < 0 ? 3 : 4);
  on_boundary_[stays] |= on_boundary_[removed];
  close(h);
  if (t >= 0) close(t);
  outgoing_halfedge_[removed] = -1;
  valences_[removed] = -1;
}

void HalfedgeMesh::set_wedges(const Adjacency& c) {
  wedges_ = c.wedge_faces;
  valences_.resize(c.wedge_count(), -1);
  outgoing_halfedge_.resize(valences_.size(), -1);
  on_boundary_.resize(valences_.size(), 0);
}

Adjacency adjacency_of(const HalfedgeMesh& t, int vertex_count) {
  const std::vector<Triangle>& faces = t.faces();
  return make_adjacency(faces, {.faces = inverse(vertex_count, faces), .twins = t.twins()});
}

namespace {

void for_each_index(size_t count, const auto& use) {
  parallel_for(count, 8192, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) use(i);
  });
}

}  // namespace

std::vector<int> HalfedgeMesh::compact() {
  const auto old_face_count = static_cast<int>(faces_.size());
  std::vector<int> left;
  left.reserve(faces_.size());
  for (int f = 0; f < old_face_count; ++f)
    if (!is_removed(f)) left.push_back(f);
  std::vector<Triangle> faces(left.size());
  for_each_index(left.size(), [&](size_t i) { faces[i] = faces_[left[i]]; });

  std::vector<int> kept = bfs_cluster_order(id_count(), faces);
  std::erase_if(kept, [this](int v) { return valence(v) < 0; });
  std::vector<int> vertex_id(valences_.size(), -1);
  for (size_t i = 0; i < kept.size(); ++i) vertex_id[kept[i]] = static_cast<int>(i);

  std::vector<std::array<int, 1>> first_corners(left.size());  // smallest vertex of each face
  for_each_index(left.size(), [&](size_t i) {
    for (int& v : faces[i]) v = vertex_id[v];
    first_corners[i][0] = std::ranges::min(faces[i]);
  });
  const std::vector<int> order = inverse(static_cast<int>(kept.size()), first_corners).items;
  std::vector<int> face_id(faces_.size(), -1);
  for_each_index(order.size(), [&](size_t g) { face_id[left[order[g]]] = static_cast<int>(g); });

  const auto renumber = [&](int h) { return h < 0 ? -1 : 3 * face_id[h / 3] + h % 3; };
  const HalfedgeMesh old = std::move(*this);
  faces_.resize(order.size());
  wedges_.resize(old.wedges_.empty() ? 0 : order.size());
  twins_.resize(3 * order.size());
  constrained_.resize(3 * order.size());
  for_each_index(order.size(), [&](size_t g) {
    const size_t i = order[g], f = left[i];
    faces_[g] = faces[i];
    if (!wedges_.empty()) wedges_[g] = old.wedges_[f];
    for (size_t k = 0; k < 3; ++k) {
      twins_[3 * g + k] = renumber(old.twins_[3 * f + k]);
      constrained_[3 * g + k] = old.constrained_[3 * f + k];
    }
  });
  outgoing_halfedge_.resize(kept.size());
  valences_.resize(kept.size());
  on_boundary_.resize(kept.size());
  for_each_index(kept.size(), [&](size_t i) {
    const size_t v = kept[i];
    outgoing_halfedge_[i] = renumber(old.outgoing_halfedge_[v]);
    valences_[i] = old.valences_[v];
    on_boundary_[i] = old.on_boundary_[v];
  });
  std::vector<int> places;
  if (!old.place_.empty())
    for (const int v : kept) places.push_back(old.at_junction(v) ? old.place_[v] : -1);
  mark_junctions(places);
  return kept;
}

}  // namespace hooke
