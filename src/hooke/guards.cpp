#include "hooke/guards.h"

#include <algorithm>
#include <cmath>

#include "hooke/least_angle.h"
#include "hooke/parallel.h"

namespace hooke {
namespace {

constexpr size_t block = 2048;

void sort_unique(std::vector<int>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// Faces or edges (`lists`) around the vertices, each once.
std::vector<int> around(const IntLists& lists, const std::vector<int>& vertices) {
  std::vector<int> ids;
  for (int v : vertices) ids.insert(ids.end(), lists[v].begin(), lists[v].end());
  sort_unique(ids);
  return ids;
}

Vec3 doubled_area_vector(const Mat3X& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]);
  return (points.col(t[1]) - a).cross(points.col(t[2]) - a);
}

double cosine(const Vec3& a, const Vec3& b, double otherwise) {
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? a.dot(b) / lengths : otherwise;
}

Vec3 sum_of_normals(const Mat3X& normals, const Triangle& sides) {
  return normals.col(sides[0]) + normals.col(sides[1]) + normals.col(sides[2]);
}

}  // namespace

double face_alignment(const Mat3X& points, const Mat3X& normals, const Triangle& face,
                      const Triangle& sides) {
  return cosine(doubled_area_vector(points, face), sum_of_normals(normals, sides), 0);
}

double edge_sagitta(const Mat3X& points, const Mat3X& normals, const Edge& edge, const Edge& sides) {
  const double c = std::clamp(normals.col(sides[0]).dot(normals.col(sides[1])), -1., 1.);
  const double tan_quarter = std::sqrt(.5 * (1 - c)) / (1 + std::sqrt(.5 * (1 + c)));
  return .5 * (points.col(edge[1]) - points.col(edge[0])).norm() * tan_quarter;
}

double cosine_between(const Mat3X& points, const Triangle& face, const Triangle& other) {
  return cosine(doubled_area_vector(points, face), doubled_area_vector(points, other), 1);
}

Guards::Guards(const Connectivity& connectivity, const TargetLengths& targets, const GuardOptions& options)
    : connectivity_(connectivity), targets_(targets), options_(options) {
  area_vector_.resize(3, static_cast<Eigen::Index>(connectivity.faces.size()));
  for (Measures* m : {&accepted_, &trial_}) {
    m->area.resize(connectivity.faces.size());
    m->alignment.resize(connectivity.faces.size());
    if (std::isfinite(options.cotangent)) m->cotangent.resize(connectivity.faces.size());
    m->sagitta.resize(connectivity.edges.size());
    m->fold.resize(connectivity.edges.size());
  }
}

void Guards::measure_face(const Placement& p, size_t face) {
  const Triangle& t = connectivity_.faces[face];
  const Vec3 n = doubled_area_vector(p.points, t);
  area_vector_.col(static_cast<Eigen::Index>(face)) = n;
  trial_.area[face] = .5 * n.norm();
  trial_.alignment[face] = cosine(n, sum_of_normals(p.normals, connectivity_.sides_of_faces()[face]), 0);
  if (!trial_.cotangent.empty()) trial_.cotangent[face] = greatest_cotangent(p.points, t);
}

/// Pre-condition: the faces have been measured.
double Guards::fold_at(size_t edge) const {
  const auto [left, right] = connectivity_.edge_faces[edge];
  if (right < 0) return 1;
  return cosine(area_vector_.col(left), area_vector_.col(right), 1);
}

void Guards::measure_edge(const Placement& p, size_t edge) {
  trial_.sagitta[edge] =
      edge_sagitta(p.points, p.normals, connectivity_.edges[edge], connectivity_.sides_of_edges()[edge]);
  trial_.fold[edge] = fold_at(edge);
}

bool Guards::face_breaks(size_t f) const {
  return hooke::face_breaks(options_, accepted_.area[f], trial_.area[f], accepted_.alignment[f],
                            trial_.alignment[f]) ||
         (!trial_.cotangent.empty() &&
          angle_breaks(options_, accepted_.alignment[f], accepted_.cotangent[f], trial_.cotangent[f]));
}

bool Guards::fold_breaks(size_t e) const {
  const double before = accepted_.fold[e], after = trial_.fold[e];
  return connectivity_.is_crease(static_cast<int>(e)) ? crease_fold_breaks(options_, before, after)
                                                      : hooke::fold_breaks(options_, before, after);
}

bool Guards::edge_breaks(size_t e) const {
  return sagitta_breaks(options_, targets_.edge[e], accepted_.sagitta[e], trial_.sagitta[e]) ||
         fold_breaks(e);
}

void Guards::accept(const Placement& placement) {
  offenders_among_all(placement);
  accept_step();
}

/// The vertices that can mend a broken edge: its ends, and for a fold all corners of the two faces.
void Guards::add_offenders(size_t edge, std::vector<int>& vertices) const {
  vertices.insert(vertices.end(), connectivity_.edges[edge].begin(), connectivity_.edges[edge].end());
  if (!fold_breaks(edge)) return;
  for (int f : connectivity_.edge_faces[edge]) {
    const Triangle& t = connectivity_.faces[static_cast<size_t>(f)];
    vertices.insert(vertices.end(), t.begin(), t.end());
  }
}

std::vector<int> Guards::offenders_among_all(const Placement& trial) {
  const size_t faces = connectivity_.faces.size();
  const size_t edges = connectivity_.edges.size();
  std::vector<char> bad(faces + edges, 0);
  parallel_for(faces, block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      measure_face(trial, f);
      bad[f] = face_breaks(f);
    }
  });
  parallel_for(edges, block, [&](size_t begin, size_t end) {
    for (size_t e = begin; e < end; ++e) {
      measure_edge(trial, e);
      bad[faces + e] = edge_breaks(e);
    }
  });
  std::vector<int> vertices;
  for (size_t f = 0; f < faces; ++f)
    if (bad[f]) vertices.insert(vertices.end(), connectivity_.faces[f].begin(), connectivity_.faces[f].end());
  for (size_t e = 0; e < edges; ++e)
    if (bad[faces + e]) add_offenders(e, vertices);
  sort_unique(vertices);
  return vertices;
}

std::vector<int> Guards::offenders_around(const Placement& trial, const std::vector<int>& moved) {
  std::vector<int> vertices;
  std::vector<int> edges;  // of the faces around: those across from a moved vertex fold too
  for (int f : around(connectivity_.vertex_faces, moved)) {
    const auto face = static_cast<size_t>(f);
    edges.insert(edges.end(), connectivity_.face_edges[face].begin(), connectivity_.face_edges[face].end());
    measure_face(trial, face);
    if (!face_breaks(face)) continue;
    vertices.insert(vertices.end(), connectivity_.faces[face].begin(), connectivity_.faces[face].end());
  }
  sort_unique(edges);
  for (int e : edges) {
    const auto edge = static_cast<size_t>(e);
    measure_edge(trial, edge);
    if (edge_breaks(edge)) add_offenders(edge, vertices);
  }
  sort_unique(vertices);
  return vertices;
}

std::vector<int> Guards::step(Retraction& retraction, const Placement& from, Mat3X& displacement,
                              Placement& to, Stopwatch* stopwatch) {
  timed(stopwatch, "projection", [&] { retraction.step(from, displacement, to); });
  std::vector<int> offenders = offenders_among_all(to);
  if (offenders.empty()) return {};

  std::vector<unsigned char> halvings(static_cast<size_t>(connectivity_.vertex_count), 0);
  std::vector<int> held;
  while (!offenders.empty()) {
    std::vector<int> slowed;
    for (int v : offenders) {
      auto u = displacement.col(v);
      if (u.isZero(0)) continue;
      auto& count = halvings[static_cast<size_t>(v)];
      if (++count == 1) held.push_back(v);
      if (count > options_.max_halvings)
        u.setZero();
      else
        u *= .5;
      slowed.push_back(v);
    }
    if (slowed.empty()) break;  // nothing there moves any more: it is as it was
    timed(stopwatch, "projection", [&] { retraction.step(from, displacement, slowed, to); });
    offenders = offenders_around(to, slowed);
  }
  return held;
}

std::vector<int> Guards::vertices_at_limits() const {
  constexpr double cosine_margin = .02, sagitta_part = .95;
  std::vector<int> vertices;
  for (size_t f = 0; f < accepted_.alignment.size(); ++f)
    if (accepted_.alignment[f] < options_.alignment + cosine_margin)
      vertices.insert(vertices.end(), connectivity_.faces[f].begin(), connectivity_.faces[f].end());
  for (size_t e = 0; e < accepted_.fold.size(); ++e) {
    const bool folds =
        !connectivity_.is_crease(static_cast<int>(e)) && accepted_.fold[e] < options_.fold + cosine_margin;
    if (!folds && accepted_.sagitta[e] < sagitta_part * options_.sagitta * targets_.edge[e]) continue;
    vertices.insert(vertices.end(), connectivity_.edges[e].begin(), connectivity_.edges[e].end());
    if (!folds) continue;
    for (const int f : connectivity_.edge_faces[e]) {
      const Triangle& t = connectivity_.faces[static_cast<size_t>(f)];
      vertices.insert(vertices.end(), t.begin(), t.end());
    }
  }
  sort_unique(vertices);
  return vertices;
}

std::vector<int> Guards::folded_faces() const {
  std::vector<int> faces;
  for (size_t f = 0; f < accepted_.alignment.size(); ++f)
    if (accepted_.alignment[f] < options_.alignment) faces.push_back(static_cast<int>(f));
  return faces;
}

}  // namespace hooke
