// What a user chooses of the constraints on the motion of vertices, and of the creases among them.
#pragma once

#include <vector>

#include "hooke/core/types.h"

namespace hooke {

struct CreaseOptions {
  bool drops_noise = true;  // false: every sharp edge is a crease
  double angle = 40;        // degrees between the normals of two faces; sharp above; 180: no creases
};

enum class BoundaryRule { slide, fixed, free };

struct ConstraintOptions {
  BoundaryRule boundary = BoundaryRule::slide;
  std::vector<int> fixed_vertices = {};  // ids of vertices that stand still
  /// Ids of vertices that stand still, with the edges and faces between them; of junctions all copies.
  std::vector<int> frozen_vertices = {};
  /// Edges to be kept as creases are, though the surface is smooth across them: pairs of vertex ids.
  std::vector<Edge> seams = {};
  /// Edges to be kept likewise along rounded edges, in lines that have corners only where lines end or meet:
  /// pairs of vertex ids, sorted, smaller one first.
  std::vector<Edge> rounded_edges = {};
  /// Boundary edges and creases of junctions, which have curves of their own: pairs of vertex ids, sorted,
  /// smaller one first. Their ends must be among `fixed_vertices`.
  std::vector<Edge> junction_edges = {};
  /// Edges at which the input says that its surface is sharp: pairs of vertex ids. Where it bends enough to
  /// continue a crease they are creases, and never noise.
  std::vector<Edge> hard_edges = {};
  static constexpr double corner_angle =
      35;  // degrees; a curve that turns by more in space has a fixed corner
  /// Maximum ratio of the longest to the shortest edge of a crease whose vertices stand still at bends; below
  /// 1: none.
  double even_crease = 1.5;
  CreaseOptions features = {};
};

}  // namespace hooke
