#include "hooke/flip_patch.h"

#include <gtest/gtest.h>

#include "flipping_scene.h"

namespace hooke {
namespace {

/// Faces with their least corner first, in order.
std::vector<Triangle> sorted(std::vector<Triangle> faces) {
  for (Triangle& f : faces) std::ranges::rotate(f, std::ranges::min_element(f));
  std::ranges::sort(faces);
  return faces;
}

std::vector<Triangle> in_mesh(const FlipPatch& patch, std::vector<Triangle> faces) {
  for (Triangle& f : faces)
    for (int& v : f) v = patch.sides[static_cast<size_t>(v)];
  return sorted(faces);
}

TEST(FlipPatch, HoldsAllFacesOfItsMovableVertices) {
  test::FlippingScene s(test::sphere(3, .3, 2), test::unit_sphere());
  const int h = 3 * 100;
  const FlipPatch patch = *cut_patch(s.mesh, h, 2, 200);
  EXPECT_EQ(patch.sides[0], s.triangulation.from(h));
  EXPECT_EQ(patch.sides[1], s.triangulation.to(h));
  std::vector<Triangle> faces;
  for (const Triangle& f : s.triangulation.faces())
    if (std::ranges::any_of(f, [&](int v) {
          const auto at = std::ranges::find(patch.sides, v) - patch.sides.begin();
          return at < static_cast<std::ptrdiff_t>(patch.movable);
        }))
      faces.push_back(f);
  EXPECT_EQ(in_mesh(patch, patch.faces), sorted(faces));
  for (size_t i = 0; i < patch.sides.size(); ++i)
    EXPECT_EQ(patch.placement.points.col(static_cast<Eigen::Index>(i)),
              s.placement.points.col(patch.sides[i]));
}

TEST(FlipPatch, FlippedFacesAreThoseOfTheFlippedMesh) {
  for (int rings : {-1, 1, 2}) {
    test::FlippingScene s(test::sphere(2, .3, 2), test::unit_sphere());
    const int h = 3 * 17 + 1, twin = s.triangulation.twin(h);
    const FlipPatch patch = rings < 0 ? cut_pair(s.mesh, h) : *cut_patch(s.mesh, h, rings, 200);
    s.triangulation.flip(h);
    std::vector<Triangle> pair = {s.triangulation.faces()[static_cast<size_t>(h / 3)],
                                  s.triangulation.faces()[static_cast<size_t>(twin / 3)]};
    const std::vector<Triangle> flipped = in_mesh(patch, flipped_faces(patch));
    EXPECT_TRUE(std::ranges::includes(flipped, sorted(pair)));
    EXPECT_EQ(flipped.size(), patch.faces.size());
    const std::vector<Triangle> all = sorted(s.triangulation.faces());
    EXPECT_TRUE(std::ranges::includes(all, flipped));
  }
}

TEST(FlipPatch, EndsAtCreases) {
  // The middle line of a grid is a crease: what lies beyond is not seen, and its vertices stand still.
  const int n = 6, middle = 3 * (n + 1);
  std::vector<Edge> creases;
  for (int i = 0; i < n; ++i) creases.push_back({middle + i, middle + i + 1});
  test::FlippingScene s(test::grid(n, test::flat), test::plane(), creases);
  const int h = test::half_edge(s.triangulation, 2 * (n + 1) + 3, 2 * (n + 1) + 4);
  ASSERT_GE(h, 0);
  const FlipPatch patch = *cut_patch(s.mesh, h, 2, 200);
  for (size_t i = 0; i < patch.sides.size(); ++i) {
    const double y = patch.placement.points(1, static_cast<Eigen::Index>(i));
    EXPECT_LE(y, .5 + 1e-12);
    if (y > .5 - 1e-12 && i < patch.movable) {
      EXPECT_EQ(patch.constraints.freedom[i], Freedom::fixed);
    }
  }
}

TEST(FlipPatch, FoldsAtItsRimAreSeen) {
  test::FlippingScene s(test::grid(8, test::flat), test::plane());
  const int h = test::half_edge(s.triangulation, 4 * 9 + 3, 4 * 9 + 4);
  FlipPatch patch = *cut_patch(s.mesh, h, 1, 200);
  EXPECT_FALSE(patch.rim.empty());
  EXPECT_FALSE(folds_at_rim(patch, s.mesh, {}));
  for (size_t i = 0; i < patch.movable; ++i)  // turned over, beyond the rim
    patch.placement.points.col(static_cast<Eigen::Index>(i)) += Vec3(2, 0, .1);
  EXPECT_TRUE(folds_at_rim(patch, s.mesh, {}));
}

TEST(FlipPatch, IsNotCutWhereTooManyVerticesWouldMove) {
  test::FlippingScene s(test::sphere(3, .3, 2), test::unit_sphere());
  const size_t movable = cut_patch(s.mesh, 0, 2, 200)->movable;
  EXPECT_TRUE(cut_patch(s.mesh, 0, 2, movable).has_value());
  EXPECT_FALSE(cut_patch(s.mesh, 0, 2, movable - 1).has_value());
}

}  // namespace
}  // namespace hooke
