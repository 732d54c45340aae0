#include "hooke/measure/preservation.h"

#include <gtest/gtest.h>

#include "hooke/mesh/adjacency.h"
#include "support/meshes.h"

namespace hooke::preservation_test {

/// A mesh and its measures.
struct Measured {
  explicit Measured(const test::Triangles& t)
      : adjacency(make_adjacency(static_cast<int>(t.points.cols()), t.faces)),
        surface(t.points, adjacency),
        quality(measure_quality(surface, std::vector<double>(adjacency.edges.size(), 1.))) {}

  Adjacency adjacency;
  MeasuredSurface surface;
  Quality quality;
};

Preservation compare(const test::Triangles& before, const test::Triangles& after,
                     const PreservationOptions& options = {}) {
  const Measured a(before), b(after);
  const std::vector<Edge> none;
  return measure_preservation({a.surface, a.quality, none}, {b.surface, b.quality, none},
                              measure_deviation(a.surface, b.surface), options);
}

TEST(Preservation, HoldsForTheMeshItself) {
  for (const auto& t : {test::sphere(2), test::sphere(2, .3, 1), test::grid(6, test::flat)}) {
    EXPECT_TRUE(compare(t, t).holds());
    EXPECT_TRUE(compare(t, t, {.keeps_facets = true}).holds());
    EXPECT_TRUE(compare(t, t, {.max_distance = 1e-12}).holds());
  }
}

TEST(Preservation, AVertexFarFromTheSurfaceBreaksIt) {
  const test::Triangles t = test::sphere(3);
  test::Triangles far = t;
  far.points.col(5) *= 1.5;
  const Preservation p = compare(t, far);
  ASSERT_EQ(p.far_vertices.size(), 1u);
  EXPECT_EQ(p.far_vertices[0].vertex, 5);
  EXPECT_NEAR(p.distance, .5, .05);
  EXPECT_TRUE(compare(t, far, {.max_distance = .6}).far_vertices.empty());
}

TEST(Preservation, ALostTipBreaksIt) {
  const test::Triangles t = test::sphere(3);
  test::Triangles spiked = t;
  spiked.points.col(5) *= 1.5;
  const Preservation p = compare(spiked, t);
  ASSERT_EQ(p.lost_vertices.size(), 1u);
  EXPECT_EQ(p.lost_vertices[0].vertex, 5);
}

TEST(Preservation, AFaceTurnedOverBreaksIt) {
  const test::Triangles t = test::grid(6, test::flat);
  test::Triangles folded = t;
  const auto [a, b, c] = t.faces[30];
  const Vec3 across = t.points.col(b) + t.points.col(c) - 2 * t.points.col(a);
  folded.points.col(a) += 1.6 * across;
  const Preservation p = compare(t, folded);
  EXPECT_GT(p.flipped_faces, 0u);
  EXPECT_GT(p.new_folds, 0u);
}

TEST(Preservation, AnotherTopologyBreaksIt) {
  test::Triangles t = test::sphere(2), open = t;
  open.faces.pop_back();
  EXPECT_FALSE(compare(t, open).topology_kept);
}

TEST(Preservation, FacetsAreMeantWhereTheyAreFlatOrLong) {
  const auto faceted = [](const test::Triangles& t) {
    return is_faceted(t.points, make_adjacency(static_cast<int>(t.points.cols()), t.faces));
  };
  EXPECT_TRUE(faceted(test::grid(6, test::flat)));
  EXPECT_FALSE(faceted(test::sphere(3)));
  EXPECT_FALSE(faceted(test::sphere(3, .3, 1)));
}

}  // namespace hooke::preservation_test
