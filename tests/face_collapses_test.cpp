#include "hooke/connectivity/collapse_passes.h"

#include <gtest/gtest.h>

#include "adapting_scene.h"
#include "hooke/mesh/topology.h"

namespace hooke {
namespace {

constexpr int cells = 8;

/// A grid whose middle vertex has been moved by so many cells.
test::Triangles with_moved_middle(double cells_in_x, double cells_in_y) {
  test::Triangles t = test::grid(cells, test::flat);
  const Eigen::Index middle = cells / 2 * (cells + 2);
  t.points.col(middle) += Vec3(cells_in_x, cells_in_y, 0) / cells;
  return t;
}

/// Of the faces that are left.
struct Look {
  int faces = 0;
  double least_alignment = 1;
};

Look look_at(const AdaptingMesh& m) {
  Look look;
  for (size_t f = 0; f < m.triangulation.faces().size(); ++f) {
    if (m.triangulation.is_gone(static_cast<int>(f))) continue;
    const Triangle& t = m.triangulation.faces()[f];
    ++look.faces;
    look.least_alignment =
        std::min(look.least_alignment, face_alignment(m.placement.points, m.placement.normals, t));
  }
  return look;
}

void expect_a_disk(test::AdaptingScene& s) {
  compact(s.adapting);
  const Connectivity c =
      make_connectivity(static_cast<int>(s.placement.points.cols()), s.triangulation.faces());
  EXPECT_EQ(measure_topology(c).euler, 1);
  EXPECT_EQ(measure_topology(c).boundary_loops, 1);
}

TEST(FaceCollapses, TakeOutFoldedFaces) {
  test::AdaptingScene s(with_moved_middle(1.4, 0), test::plane());
  ASSERT_LT(look_at(s.adapting).least_alignment, 0);
  EXPECT_GE(collapse_folded_faces(s.adapting, folded_face_options()), 1);
  const Look after = look_at(s.adapting);
  EXPECT_GT(after.least_alignment, .99);
  EXPECT_GE(after.faces, 2 * cells * cells - 4);
  expect_a_disk(s);
}

TEST(FaceCollapses, LeaveGoodFacesAlone) {
  test::AdaptingScene s(test::grid(cells, test::flat), test::plane());
  EXPECT_EQ(collapse_folded_faces(s.adapting, folded_face_options()), 0);
  EXPECT_EQ(look_at(s.adapting).faces, 2 * cells * cells);
}

}  // namespace
}  // namespace hooke
