// Sagittas: how far a smooth surface through the vertices of a mesh may rise over its faces; and how even the
// faces are.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// The arc that an edge and its two faces are chords of: the faces turn by theta at the edge, and the smaller
/// of their heights over the edge is the length of a chord.
struct EdgeArc {
  double sagitta = 0;  // (chord / 2) tan(theta / 4), a length; exact for a prism inscribed in a cylinder
  double chord = 0;    // a length
};

/// The arc of every edge of the mesh; without sagitta on the boundary, on creases, and next to faces without
/// area.
std::vector<EdgeArc> edge_arcs(const Mat3X& points, const Adjacency& adjacency);

/// How far a smooth surface may rise over each face: the sum of the sagittas of its edges, since a sphere's
/// faces rise from all sides, or that of a neighbour across an edge that is no crease, whichever is more. It
/// is 0 in flat regions.
std::vector<double> face_sagittas(const std::vector<EdgeArc>& arcs, const Adjacency& adjacency);

/// The greatest of these sagittas of the faces at each vertex.
std::vector<double> vertex_sagittas(const std::vector<double>& face_sagittas, const Adjacency& adjacency);

/// The longest edge of each face over the spacing of the vertices: the smallest, of its corners, of the
/// second shortest edges there.
std::vector<double> face_unevenness(const Mat3X& points, const Adjacency& adjacency);

/// Are the facets of the mesh meant, as those of CAD parts: do .85 of its faces lie in a plane with a
/// neighbour; or have such faces .75 of the area, and faces with an edge three times as long as others at its
/// corners .4; or are half of the faces so uneven, and needles a quarter of the area, or .3 of them and
/// needles .75, for the slivers of marching cubes or tetrahedra are many, but small; or have half of fewer
/// than 64 an edge sharper than 40 degrees? Where no edge is as sharp, as on a torus of quadrilaterals, it
/// takes three faces in a plane, or the area in faces 8 times as large as most, as on a part whose edges are
/// all rounded, and long edges do not count. Flat patches of a smooth surface never count, see
/// mesh/smooth_patches.h.
bool is_faceted(const Mat3X& points, const Adjacency& adjacency);

}  // namespace hooke
