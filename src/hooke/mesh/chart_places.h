// Where the faces and corners of a remeshed surface lie on the surface it was made from, on their own side of
// each feature edge, so that data of faces and corners can be carried over.
#pragma once

#include <vector>

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/surface_point.h"

namespace hooke {

/// A surface divided into charts. `adjacency` has its feature edges marked, see split_wedges().
struct ChartedSurface {
  const Mat3X& points;
  const Adjacency& adjacency;
};

/// Places on the input.
struct ChartPlaces {
  std::vector<int> faces;            // of each face: the face of the input at its centre
  std::vector<SurfacePoint> wedges;  // of each wedge; on no face where there is none at the wedge
};

/// Finds the places of the result on the input. A chart of the result, which its faces form across edges that
/// are no features, lies in one chart of the input: that of most of its larger faces. From the largest of
/// these on, places are found from neighbour to neighbour on the input cut open along its feature edges, so
/// that none gets across one, not even where a chart borders on itself. `near`, if not empty, has a face of
/// the input near each vertex of the result, -1 for none: it tells surfaces apart that nearly touch.
ChartPlaces find_chart_places(const ChartedSurface& input, const ChartedSurface& result,
                              const std::vector<int>& near = {});

}  // namespace hooke
