// Repair of triangles that form no oriented manifold: welding, dropping, orienting, cutting, filling. Every
// change is told.
#pragma once

#include <string>
#include <vector>

#include "hooke/core/types.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/mesh/validation.h"

namespace hooke {

/// Vertices closer than this, in diagonals of the box, are in the same place but for rounding to 32-bit
/// floats.
inline constexpr double rounding_share = 1e-7;

struct RepairOptions {
  bool repair = false;          // make an oriented manifold
  double weld = -1;             // merge vertices closer than this, in file units; negative: off
  double weld_share = -1;       // the same in diagonals of the box
  double drop_components = 0;   // with `repair`: drop components of less than this share of the area
  int fill_holes = 0;           // with `repair`: fill holes of at most so many edges
  bool collapse = false;        // collapse the edges without length of an oriented manifold
  bool drop_strays = false;     // drop faces that use a vertex twice, and all vertices in no face
  bool separate = false;        // give solids that only touch vertices of their own
  bool keep_junctions = false;  // sheets that meet in edges and vertices are known to be one, see junctions.h

  bool any() const {
    return repair || weld >= 0 || weld_share >= 0 || collapse || drop_strays || separate || keep_junctions;
  }
};

/// Where the vertices and faces of a repaired mesh come from. Empty: they are the old ones.
struct MeshOrigin {
  std::vector<int> vertex;    // for each vertex, the old one
  std::vector<int> merged;    // for each old vertex, the one it was merged with, or itself
  std::vector<int> face;      // for each face the old one; for one over a hole a neighbour's
  std::vector<char> flipped;  // for each face, whether its second and third corner are swapped
  std::vector<int> joined;  // for each vertex, the first of its copies; empty: none has any, see junctions.h
  size_t filled = 0;        // the last faces are over holes
};

struct Repaired {
  Mat3X points;
  std::vector<Triangle> triangles;
  MeshOrigin origin;
  Notes changes;  // what was done, how often, and the first places, in old ids
};

/// With `drop_strays` faces that use a vertex twice are dropped, and in the end the vertices in no face. With
/// `separate` solids that touch are taken apart, see touching_solids.h. With `weld`, vertices closer than
/// that are merged, and faces that lose a corner by it are dropped. With `repair`:
/// - vertices at boundaries are merged where they are within welding_share of the shortest boundary edge
/// there;
/// - faces that use a vertex twice are dropped; so are flaps (see flaps.h) that are no thicker than rounding,
/// or that welding made of one closed body, and solids that touch are taken apart as with `separate`; neither
/// if `keep_junctions` is set, where faces back to back may be two walls that come together;
/// - of faces with the same vertices that are left all but the first are dropped;
/// - surfaces are oriented, cut and split as make_sheets() does;
/// - components that are too small are dropped, holes that are small enough are filled;
/// - closed components that are inside out and in no other are turned outward;
/// - vertices in no face are dropped.
/// With `collapse`, after these, edges without length are collapsed, as those of marching cubes where a value
/// at a grid point is that of the level, and of cuts that miss a vertex by a rounding; not
/// where that would change the topology or turn a face over, between the two sides of a foil, nor in a mesh
/// that is no oriented manifold. No vertex moves by more than rounding_share.
/// With `keep_junctions` edges of three faces and more and vertices in which parts only touch stay: they are
/// cut last, after all else, if nothing but them keeps the mesh from being an oriented manifold; with
/// `repair` also the edges at which a surface with one side cannot be oriented. Small components are then
/// those of the joined mesh, and components with junctions are not turned.
/// The vertices that stay keep their order; copies of split ones come last. Pre-condition: corners are
/// vertices. The result may still be invalid, for instance without faces. Its origin is empty if nothing was
/// changed.
Repaired repair(const Mat3X& points, std::vector<Triangle> triangles, const RepairOptions& options,
                const MeshSource& source);

/// The vertices that these old ones are now, copies included, ascending. `lost` becomes the first of the old
/// ones that was dropped, -1 if none was. Pre-condition: the origin is not empty.
std::vector<int> vertices_from(const MeshOrigin& origin, const std::vector<int>& old, int* lost = nullptr);

/// The map of a result to the repaired mesh, as a map to the old one: what lies over a filled hole is on no
/// face. An empty origin changes nothing.
std::vector<MapEntry> map_to_old(std::vector<MapEntry> map, const MeshOrigin& origin);

}  // namespace hooke
