#include "hooke/connectivity/merged_ring.h"

#include <algorithm>

#include "hooke/geometry/face_shape.h"
#include "hooke/geometry/least_angle.h"
#include "hooke/integrator/guards.h"

namespace hooke {
namespace {

/// The columns of a face's corners.
Triangle corners_of(size_t face) {
  const int first = static_cast<int>(3 * face);
  return {first, first + 1, first + 2};
}

void look_at_face(const AdaptingMesh& m, size_t face, WorstShape& worst) {
  const Mat3X& X = m.placement.points;
  const Triangle& corners = m.triangulation.faces()[face];
  const Triangle& sides = m.triangulation.sides()[face];
  worst.cotangent = std::max(worst.cotangent, greatest_cotangent(X, corners));
  worst.alignment = std::min(worst.alignment, face_alignment(X, m.placement.normals, corners, sides));
}

/// The edge of h, and the fold there. Creases are folds that shall be.
void look_at_edge(const AdaptingMesh& m, int h, WorstShape& worst) {
  const Triangulation& t = m.triangulation;
  const Mat3X& X = m.placement.points;
  const Edge edge = {t.from(h), t.to(h)}, sides = {t.side(h), t.side(Triangulation::next(h))};
  const double sagitta = edge_sagitta(X, m.placement.normals, edge, sides);
  worst.sagitta = std::max(worst.sagitta, sagitta / target_length(m, edge[0], edge[1]));
  if (t.is_border(h)) return;
  const auto face = static_cast<size_t>(h / 3), across = static_cast<size_t>(t.twin(h) / 3);
  worst.fold = std::min(worst.fold, cosine_between(X, t.faces()[face], t.faces()[across]));
}

}  // namespace

WorstShape worse_of(const WorstShape& a, const WorstShape& b) {
  return {std::max(a.cotangent, b.cotangent), std::min(a.alignment, b.alignment), std::min(a.fold, b.fold),
          std::max(a.sagitta, b.sagitta)};
}

bool is_within(const WorstShape& w, const WorstShape& limits) {
  return w.cotangent <= limits.cotangent && w.alignment >= limits.alignment && w.fold >= limits.fold &&
         w.sagitta <= limits.sagitta;
}

WorstShape worst_about(const AdaptingMesh& m, int half_edge) {
  const Triangulation& t = m.triangulation;
  WorstShape worst;
  for (int end : {t.from(half_edge), t.to(half_edge)})
    for (int spoke : t.outgoing(end)) {
      look_at_face(m, static_cast<size_t>(spoke / 3), worst);
      for (int h : {spoke, Triangulation::next(spoke), Triangulation::previous(spoke)})
        look_at_edge(m, h, worst);
    }
  return worst;
}

MergedRing::MergedRing(const AdaptingMesh& mesh, int half_edge, int stays)
    : m_(mesh), t_(mesh.triangulation), stays_(stays) {
  const int twin = t_.twin(half_edge);
  const int dying[] = {half_edge / 3, twin < 0 ? -1 : twin / 3};
  for (int v : {t_.from(half_edge), t_.to(half_edge)})
    for (int spoke : t_.outgoing(v))
      if (spoke / 3 != dying[0] && spoke / 3 != dying[1])
        add_face(spoke, t_.side_after_collapse(half_edge, stays, spoke));
  for (Face& face : faces_) face.next = face_after(face);
  copy_corners();
}

void MergedRing::add_face(int spoke, int side) {
  const int next = Triangulation::next(spoke), previous = Triangulation::previous(spoke);
  Face face{.spoke = spoke,
            .side = side,
            .first_target = target_length(m_, stays_, t_.from(next)),
            .last_target = target_length(m_, stays_, t_.from(previous)),
            .has_beyond = !t_.is_border(next),
            .beyond = Vec3::Zero(),
            .next = -1};
  if (face.has_beyond) {
    const auto across = static_cast<size_t>(t_.twin(next) / 3);
    face.beyond = doubled_area_vector(m_.placement.points, t_.faces()[across]);
  }
  faces_.push_back(face);
}

/// The face after it about the vertex that stays, also where two edges have become one.
int MergedRing::face_after(const Face& face) const {
  const int last = Triangulation::previous(face.spoke);
  const auto found =
      std::ranges::find_if(faces_, [&](const Face& other) { return t_.to(other.spoke) == t_.from(last); });
  if (found == faces_.end() || t_.is_constrained(last) || t_.is_constrained(found->spoke)) return -1;
  return static_cast<int>(found - faces_.begin());
}

void MergedRing::copy_corners() {
  const auto columns = static_cast<Eigen::Index>(3 * faces_.size());
  points_.resize(3, columns);
  normals_.resize(3, columns);
  areas_.resize(faces_.size());
  for (size_t f = 0; f < faces_.size(); ++f) {
    const int next = Triangulation::next(faces_[f].spoke),
              previous = Triangulation::previous(faces_[f].spoke);
    const auto [first, second, third] = corners_of(f);
    points_.col(second) = m_.placement.points.col(t_.from(next));
    points_.col(third) = m_.placement.points.col(t_.from(previous));
    normals_.col(first) = m_.placement.normals.col(faces_[f].side);  // put() knows two sides
    normals_.col(second) = m_.placement.normals.col(t_.side(next));
    normals_.col(third) = m_.placement.normals.col(t_.side(previous));
  }
}

void MergedRing::put(const VertexPlace& place) {
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Triangle corners = corners_of(f);
    points_.col(corners[0]) = place.point;
    if (faces_[f].side == stays_) normals_.col(corners[0]) = place.normal;
    if (faces_[f].side == place.other_side) normals_.col(corners[0]) = place.other_normal;
    areas_[f] = doubled_area_vector(points_, corners);
  }
}

WorstShape MergedRing::worst(const VertexPlace& place) {
  put(place);
  WorstShape worst;
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    look_at_face(f, worst);
    look_at_edge(f, 1, face.first_target, worst);
    look_at_edge(f, 2, face.last_target, worst);
    if (face.has_beyond) worst.fold = std::min(worst.fold, cosine_between(areas_[f], face.beyond));
    if (face.next >= 0)
      worst.fold = std::min(worst.fold, cosine_between(areas_[f], areas_[static_cast<size_t>(face.next)]));
  }
  return worst;
}

void MergedRing::look_at_face(size_t face, WorstShape& worst) const {
  const Triangle corners = corners_of(face);
  worst.cotangent = std::max(worst.cotangent, greatest_cotangent(points_, corners));
  worst.alignment = std::min(worst.alignment, face_alignment(points_, normals_, corners));
}

/// The edge from the first corner to another one.
void MergedRing::look_at_edge(size_t face, int corner, double target, WorstShape& worst) const {
  const int first = corners_of(face)[0];
  const double sagitta = edge_sagitta(points_, normals_, {first, first + corner});
  worst.sagitta = std::max(worst.sagitta, sagitta / target);
}

}  // namespace hooke
