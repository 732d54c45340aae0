// Energy terms with a name, as parameters of tests, and their energy from its definition.
#pragma once

#include <cmath>
#include <ostream>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/springs/hooke_law.h"
#include "hooke/springs/ring_energy.h"
#include "hooke/springs/target_lengths.h"

namespace hooke::test {

struct NamedTerms {
  const char* name;
  RingTerms terms;
};
inline void PrintTo(const NamedTerms& t, std::ostream* out) {
  *out << t.name;
}

inline RingTerms only_strings() {
  RingTerms t;
  t.altitude = 0;
  return t;
}
inline RingTerms only_angles() {
  RingTerms t;
  t.altitude = 0;
  t.angle = 30;
  t.angle_threshold = .7;
  return t;
}

/// U(l; L) / L^2.
inline double relative_potential(double l, double L) {
  return spring_potential(l, L).value / (L * L);
}

/// The energy of a mesh whose faces have areas, `normals` one per vertex, term by term.
inline double energy_by_definition(const Mat3X& points, const Mat3X& normals, const Adjacency& c,
                                   const TargetLengths& targets, const RingTerms& terms) {
  double energy = 0;
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const double length = (points.col(c.edges[e][1]) - points.col(c.edges[e][0])).norm();
    energy += terms.string * relative_potential(length, targets.edge[e]);
  }
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    const Triangle& t = c.faces[f];
    const double h0 = altitude_ratio * targets.face[f];
    const Vec3 area = doubled_area_vector(points, t);
    if (terms.unfold > 0 && face_alignment(points, normals, t) < terms.unfold_below) {
      const Vec3 up = (normals.col(t[0]) + normals.col(t[1]) + normals.col(t[2])).normalized();
      const double d = terms.unfold_below, s = area.dot(up) / (h0 * targets.face[f]);
      energy += s < d ? 1.5 * terms.unfold * std::pow((d - s) / d, 2) : 0;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = points.col(t[(k + 1) % 3]) - points.col(t[k]);
      const Vec3 b = points.col(t[(k + 2) % 3]) - points.col(t[k]);
      const double height = area.norm() / (b - a).norm(), angle = std::atan2(area.norm(), a.dot(b));
      if (height < h0) energy += terms.altitude * relative_potential(height, h0);
      if (angle < terms.angle_threshold)
        energy += terms.angle * relative_potential(angle, terms.angle_threshold);
    }
  }
  return energy;
}

}  // namespace hooke::test
