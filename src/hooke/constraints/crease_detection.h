// Sharp edges that belong to the shape, told apart from noise: chains found with hysteresis.
// Hysteresis after J. Canny, "A computational approach to edge detection", 1986.
#pragma once

#include "hooke/mesh/adjacency.h"

namespace hooke {

struct CreaseOptions {
  double angle = 40;        // degrees between the normals of two faces; sharp above; 180: no creases
  double weak = .6;         // of that angle: edges that go on in the direction of a crease belong to it
  double turn = 35;         // degrees; greatest change of direction from edge to edge of a chain
  double bend = .25;        // least bend of a face beside a sharp edge, over the edge's; else it is a curve
  double chain_bend = .1;   // the same for the median of a chain with a loose end
  double sharp_share = .3;  // least part of sharp edges in a chain with a loose end
  int min_edges = 12;       // of a chain with a loose end
  double min_length = 8;    // of a chain with a loose end, in target lengths
  double min_curve = 5;     // mean number of edges from corner to corner in a network of chains, unless
  double flat_bend = .02;   // the median of its bends is below this: flat faces may have short edges; asked
                            // too of chains that may be short, or that lie in the midst of the surface
};

/// The crease edges, ascending. An edge counts when its faces meet at a sharp angle while each of them goes
/// on nearly flat across one of its other edges: a coarse mesh of a round body bends everywhere. Chains end
/// loosely where no other crease or chain goes on from their last vertex; such ones must be long, straight
/// and clean, since noise makes short ones; so must those from the boundary, unless all their edges are sharp
/// between flat faces and they lead to a crease or to the boundary. What is left hangs together in networks;
/// noise makes such of many corners between rough faces.
std::vector<int> detect_creases(const Mat3X& points, const Adjacency& adjacency,
                                const std::vector<double>& vertex_length, const CreaseOptions& options);

}  // namespace hooke
