#include "hooke/remesh/details.h"

#include <gtest/gtest.h>

#include "hooke/mesh/mesh.h"
#include "hooke/remesh/preserving_remesh.h"
#include "support/crease_solids.h"
#include "support/remeshed.h"

namespace hooke::details_test {

TEST(DetailsOfRemeshed, RoundedEdgesAreNotCutToSawTeeth) {
  constexpr double radius = .5;
  const test::Triangles box = test::rounded_box({20, 15, 6}, radius, 3);
  for (const double length : {4., 8.}) {
    RemeshOptions options;
    options.connectivity = ConnectivityMode::adapt;
    TriMesh mesh = test::with_length(box, length);
    const RemeshResult result = preserving_remesh(mesh, find_memory_order(mesh), options, {.faceted = true});
    const Deviation& d = result.measures->deviation;
    const double chord = (1 - std::sqrt(.5)) * radius;  // from the middle of an edge to its side
    EXPECT_LT(d.to_reference.max, 1.5 * chord) << length;
    EXPECT_LT(d.from_reference.max, 1.5 * chord) << length;
    EXPECT_GT(result.measures->quality.min_angle.min, 20) << length;
    EXPECT_GT(result.sharp_bends, 0) << length;  // still told
  }
}

}  // namespace hooke::details_test
