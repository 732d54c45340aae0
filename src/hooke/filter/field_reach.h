// A bound on how far a fitted surface may swing out from the faces it was fitted to: splines do where long
// faces lie beside short ones.
#pragma once

#include <vector>

#include "hooke/filter/near_faces.h"

namespace hooke {

/// How far the surface may be from the faces about each vertex: `reach` times the vertex's length (empty: 1),
/// and infinity where it could only come that far by bending several times more than the normals turn along
/// edges. Empty: no limit anywhere.
std::vector<float> reaches_of(const NearFaces& faces, double reach, const std::vector<double>& lengths);

/// The foot of x, unless it is beyond its anchor's reach: then a place on the same side at that distance from
/// the faces, above their point next to x when x is more than half as far from them, else above that next to
/// the foot.
Foot within_reach(const NearFaces& faces, const std::vector<float>& reaches, const Vec3& x, const Foot& foot);

}  // namespace hooke
