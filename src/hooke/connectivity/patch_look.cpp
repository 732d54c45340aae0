#include "hooke/connectivity/patch_look.h"

#include <algorithm>

#include "hooke/geometry/face_shape.h"
#include "hooke/geometry/least_angle.h"
#include "hooke/integrator/guards.h"

namespace hooke {
namespace {

void add_face(const Placement& p, const Triangle& t, const PatchLimits& limits, PatchLook& look) {
  const double cotangent = greatest_cotangent(p.points, t);
  const double lacks = std::max(0., limits.fair_angle - angle_with_cotangent(cotangent));
  const double alignment = face_alignment(p.points, p.normals, t);
  const double misses = limits.alignment - alignment;
  look.cotangent = std::max(look.cotangent, cotangent);
  look.area += .5 * doubled_area_vector(p.points, t).norm() * alignment;
  look.angle_cost += lacks * lacks;
  look.excess.alignment += std::max(0., misses);
  look.excess.folds += misses > 0;
}

void add_edge(const Placement& p, const Edge& edge, double target, const PatchLimits& limits,
              PatchLook& look) {
  const double length = (p.points.col(edge[1]) - p.points.col(edge[0])).norm() / target;
  const double sagitta = edge_sagitta(p.points, p.normals, edge) / target;
  look.length_errors += (length - 1) * (length - 1);
  look.excess.length = std::max(look.excess.length, length - limits.longest);
  look.excess.sagitta += std::max(0., sagitta - limits.sagitta);
}

void add_fold(const Placement& p, const Triangle& face, const Triangle& other, const PatchLimits& limits,
              PatchLook& look) {
  const double misses = limits.fold - cosine_between(p.points, face, other);
  look.excess.fold += std::max(0., misses);
  look.excess.folds += misses > 0;
}

}  // namespace

bool is_no_worse(const PatchExcess& now, const PatchExcess& before) {
  return now.alignment <= before.alignment && now.fold <= before.fold && now.sagitta <= before.sagitta &&
         now.length <= before.length && now.folds <= before.folds;
}

PatchLook look_at(const Placement& p, const Connectivity& c, const TargetLengths& targets,
                  const PatchLimits& limits) {
  PatchLook look;
  look.edges = c.edges.size();
  for (const Triangle& t : c.faces) add_face(p, t, limits, look);
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    add_edge(p, c.edges[e], targets.edge[e], limits, look);
    if (const auto [f, g] = c.edge_faces[e]; g >= 0)
      add_fold(p, c.faces[static_cast<std::size_t>(f)], c.faces[static_cast<std::size_t>(g)], limits, look);
  }
  return look;
}

}  // namespace hooke
