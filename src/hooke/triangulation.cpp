#include "hooke/triangulation.h"

#include <algorithm>
#include <cassert>

namespace hooke {

Triangulation::Triangulation(const Connectivity& c)
    : faces_(c.faces),
      sides_(c.side_faces),
      twins_(3 * c.faces.size(), -1),
      leaving_(static_cast<size_t>(c.vertex_count), -1),
      valences_(static_cast<size_t>(c.vertex_count), 0),
      on_boundary_(static_cast<size_t>(c.vertex_count), 0),
      constrained_(3 * c.faces.size(), 0) {
  std::vector<int> first(c.edges.size(), -1);
  for (size_t f = 0; f < faces_.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int h = static_cast<int>(3 * f + k);
      leaving_[static_cast<size_t>(faces_[f][k])] = h;
      int& other = first[static_cast<size_t>(c.face_edges[f][k])];
      if (other < 0)
        other = h;
      else
        link(h, other);
    }
  for (size_t e = 0; e < c.edges.size(); ++e)
    for (int v : c.edges[e]) {
      ++valences_[static_cast<size_t>(v)];
      if (c.is_boundary_edge(static_cast<int>(e))) on_boundary_[static_cast<size_t>(v)] = 1;
    }
  for (size_t h = 0; h < twins_.size(); ++h)
    if (c.is_crease(c.face_edges[h / 3][h % 3])) constrained_[h] = 1;
}

std::vector<int> Triangulation::outgoing(int vertex) const {
  std::vector<int> spokes;
  const int any = leaving_[static_cast<size_t>(vertex)];
  if (any < 0) return spokes;
  int start = any;  // as far clockwise as there are faces
  for (int t = twin(start); t >= 0 && next(t) != any; t = twin(start)) start = next(t);
  if (twin(start) >= 0) start = any;
  for (int h = start; h >= 0;) {
    spokes.push_back(h);
    h = twin(previous(h));
    if (h == start) break;
  }
  return spokes;
}

std::vector<int> Triangulation::sector(int h) const {
  const auto is_border = [&](int side) { return twin(side) < 0 || is_constrained(side); };
  const int any = h;
  while (!is_border(h) && next(twin(h)) != any) h = next(twin(h));
  std::vector<int> spokes = {h};
  for (int side = previous(h); !is_border(side) && twin(side) != spokes.front(); side = previous(twin(side)))
    spokes.push_back(twin(side));
  return spokes;
}

bool Triangulation::on_crease(int vertex) const {
  return std::ranges::any_of(outgoing(vertex),
                             [&](int h) { return is_constrained(h) || is_constrained(previous(h)); });
}

bool Triangulation::adjacent(int a, int b) const {
  for (int h : outgoing(a))
    if (to(h) == b || apex(h) == b) return true;
  return false;
}

void Triangulation::link(int h, int twin) {
  if (h >= 0) twins_[static_cast<size_t>(h)] = twin;
  if (twin >= 0) twins_[static_cast<size_t>(twin)] = h;
}

void Triangulation::constrain(int h) {
  constrained_[static_cast<size_t>(h)] = 1;
  if (const int t = twin(h); t >= 0) constrained_[static_cast<size_t>(t)] = 1;
}

void Triangulation::flip(int h) {
  const int t = twin(h);
  assert(t >= 0 && !is_constrained(h));
  const int a = from(h), b = to(h), c = apex(h), d = apex(t);
  const int ca = twin(previous(h)), bc = twin(next(h)), ad = twin(next(t)), db = twin(previous(t));
  const int f = h / 3, g = t / 3;
  const auto mark = [this](int side) { return constrained_[static_cast<size_t>(side)]; };
  const std::array<char, 4> marks = {mark(previous(h)), mark(next(t)), mark(previous(t)), mark(next(h))};
  if (!sides_.empty()) {  // neither face leaves its sector
    const int sa = side(h), sb = side(t), sc = side(previous(h)), sd = side(previous(t));
    sides_[static_cast<size_t>(f)] = {sc, sa, sd};
    sides_[static_cast<size_t>(g)] = {sd, sb, sc};
  }
  faces_[static_cast<size_t>(f)] = {c, a, d};
  faces_[static_cast<size_t>(g)] = {d, b, c};
  link(3 * f, ca);
  link(3 * f + 1, ad);
  link(3 * f + 2, 3 * g + 2);
  link(3 * g, db);
  link(3 * g + 1, bc);
  for (size_t i = 0; i < 4; ++i) constrained_[static_cast<size_t>(i < 2 ? 3 * f : 3 * g) + i % 2] = marks[i];
  constrained_[static_cast<size_t>(3 * f + 2)] = constrained_[static_cast<size_t>(3 * g + 2)] = 0;
  leaving_[static_cast<size_t>(c)] = 3 * f;
  leaving_[static_cast<size_t>(a)] = 3 * f + 1;
  leaving_[static_cast<size_t>(d)] = 3 * g;
  leaving_[static_cast<size_t>(b)] = 3 * g + 1;
  --valences_[static_cast<size_t>(a)];
  --valences_[static_cast<size_t>(b)];
  ++valences_[static_cast<size_t>(c)];
  ++valences_[static_cast<size_t>(d)];
}

}  // namespace hooke
