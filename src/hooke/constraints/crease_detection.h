// Detects creases: chains of sharp edges that belong to the shape, as opposed to noise, by hysteresis
// thresholding; and tips.
// J. Canny, "A computational approach to edge detection", 1986.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

/// The bend ratio of an edge compares the flattest continuation of its faces with the edge itself: for each
/// face the smaller angle at its two other edges over the angle at the edge; the larger of both faces.
struct CreaseOptions {
  bool drops_noise = true;  // false: every sharp edge is a crease
  double angle = 40;        // degrees between the normals of two faces; sharp above; 180: no creases
  double hysteresis = .6;   // fraction of `angle` above which an edge may continue a crease
  static constexpr double max_turn = 35;  // degrees; maximum change of direction from edge to edge of a chain
  static constexpr double max_bend_ratio = .25;       // of a crease edge; above it the surface is round
  static constexpr double max_chain_bend_ratio = .1;  // maximum median bend ratio of a chain with a loose end
  double sharp_share = .3;  // minimum fraction of sharp edges in a chain with a loose end
  int min_edges = 12;       // minimum number of edges of a chain with a loose end
  double min_length = 8;    // minimum length of a chain with a loose end, in target lengths
  static constexpr double min_curve =
      5;                         // minimum mean number of edges between the corners of a network, unless flat
  double flat_bend_ratio = .02;  // maximum median bend ratio of a chain or network between flat faces
  /// Minimum length of a sharp edge, and minimum height of its faces, in target lengths, for the edge to be
  /// certainly no noise.
  static constexpr double resolved = 1.5;
  static constexpr double noise_width =
      .1;  // the same for the facets beside a sharp edge where facets are meant
  static constexpr double flat_angle =
      .2;  // degrees; an edge between resolved flat regions is a crease above it
  static constexpr double resolved_strip =
      1.9;  // the same between such regions, where one is a strip of a round body
  static constexpr double resolved_gentle_strip = 4;  // the same if no edge of the strip is sharp
  static constexpr double gentle_ratio = 2. / 3;      // and how much of the angle its next edge has
  static constexpr double resolved_facet = .5;        // and where none is
  static constexpr double strip_angle =
      .05;  // maximum relative difference of the angles at both edges of a strip
  static constexpr double strip_end_angle =
      .02;  // maximum difference of their ratio from 2 where a round begins
  static constexpr double facet_angle =
      1.4;  // minimum angle at all edges of a face that is a facet of its own, over `angle`
  /// Minimum share of faces in flat regions or with a resolved sharp edge, beyond which facets are meant.
  static constexpr double flat_share = .6;
  static constexpr double flatness =
      1e-6;  // maximum distance of a flat region from its plane, in diagonals of the mesh
};

/// The crease edges, ascending. An edge qualifies if its faces meet at a sharp angle while each of them
/// continues nearly flat across one of its other edges: a coarse mesh of a round body bends at every edge. A
/// chain has a loose end where no other crease or chain continues from its last vertex. Noise makes short
/// chains, so chains with a loose end must be long, straight and clean; so must chains from the boundary,
/// unless all their edges are sharp between flat faces and they lead to a crease or to the boundary. The
/// chains that remain form networks; networks with many corners between rough faces are noise.
/// Edges that the target length resolves are added whatever the chains: sharp ones, and weaker ones between
/// flat regions where most faces are in such regions. Lone edges are dropped. The steps of a binary mask that
/// the target length does not resolve are noise, see is_staircase().
/// `vertex_length` is the target length at each vertex. `hard_edges`, by their vertices, are creases
/// whatever the rest where they bend enough to continue one.
std::vector<int> detect_creases(const Mat3X& points, const Adjacency& adjacency,
                                const std::vector<double>& vertex_length, const CreaseOptions& options,
                                const std::vector<Edge>& hard_edges = {});

/// The tips of cones and pyramids, ascending: vertices without a crease or boundary edge whose faces span
/// less than a full turn by more than `tip_defect`, and whose edges the target length resolves.
std::vector<int> detect_tips(const Mat3X& points, const Adjacency& with_creases,
                             const std::vector<double>& vertex_length, const CreaseOptions& options);

}  // namespace hooke
