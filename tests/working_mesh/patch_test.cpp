#include "hooke/working_mesh/patch.h"

#include <gtest/gtest.h>

#include "support/working_scene.h"

#include "hooke/connectivity/edge_flips.h"
#include "hooke/connectivity/edge_trial.h"
#include "hooke/constraints/constraints.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/halfedge_mesh.h"

namespace hooke::patch_test {

/// Sorted faces, each with its smallest corner first.
std::vector<Triangle> sorted(std::vector<Triangle> faces) {
  for (Triangle& f : faces) std::rotate(f.begin(), std::ranges::min_element(f), f.end());
  std::ranges::sort(faces);
  return faces;
}

std::vector<Triangle> in_mesh(const EdgePatch& patch, std::vector<Triangle> faces) {
  for (Triangle& f : faces)
    for (int& v : f) v = patch.wedge_ids[v];
  return sorted(faces);
}

TEST(EdgePatch, HoldsAllFacesOfItsMovableVertices) {
  test::WorkingScene s(test::sphere(3, .3, 2), test::unit_sphere());
  const int h = 3 * 100;
  const EdgePatch patch = *cut_patch(s.mesh, h, 2, 200);
  EXPECT_EQ(patch.wedge_ids[0], s.halfedges.from(h));
  EXPECT_EQ(patch.wedge_ids[1], s.halfedges.to(h));
  std::vector<Triangle> faces;
  for (const Triangle& f : s.halfedges.faces())
    if (std::ranges::any_of(f, [&](int v) {
          const auto at = std::ranges::find(patch.wedge_ids, v) - patch.wedge_ids.begin();
          return at < static_cast<std::ptrdiff_t>(patch.movable);
        }))
      faces.push_back(f);
  EXPECT_EQ(in_mesh(patch, patch.faces), sorted(faces));
  for (size_t i = 0; i < patch.wedge_ids.size(); ++i)
    EXPECT_EQ(patch.vertices.positions.points.col(static_cast<Eigen::Index>(i)),
              s.positions.points.col(patch.wedge_ids[i]));
}

TEST(EdgePatch, FlippedFacesAreThoseOfTheFlippedMesh) {
  for (int rings : {-1, 1, 2}) {
    test::WorkingScene s(test::sphere(2, .3, 2), test::unit_sphere());
    const int h = 3 * 17 + 1, twin = s.halfedges.twin(h);
    const EdgePatch patch = rings < 0 ? cut_pair(s.mesh, h) : *cut_patch(s.mesh, h, rings, 200);
    s.halfedges.flip(h);
    std::vector<Triangle> pair = {s.halfedges.faces()[h / 3], s.halfedges.faces()[twin / 3]};
    const std::vector<Triangle> flipped = in_mesh(patch, flipped_faces(patch));
    EXPECT_TRUE(std::ranges::includes(flipped, sorted(pair)));
    EXPECT_EQ(flipped.size(), patch.faces.size());
    const std::vector<Triangle> all = sorted(s.halfedges.faces());
    EXPECT_TRUE(std::ranges::includes(all, flipped));
  }
}

/// The faces of the mesh without deleted ones, sorted.
std::vector<Triangle> faces_of(const HalfedgeMesh& t) {
  std::vector<Triangle> faces = t.faces();
  std::erase_if(faces, [](const Triangle& f) { return f[0] < 0; });
  return sorted(faces);
}

TEST(EdgePatch, SplitFacesAreThoseOfTheSplitMesh) {
  test::WorkingScene s(test::sphere(2, .3, 2), test::unit_sphere());
  const int h = 3 * 17 + 1;
  EdgePatch patch = *cut_patch(s.mesh, h, 2, 200);
  const int middle = append_vertex(patch, 0);
  EXPECT_EQ(middle, static_cast<int>(patch.wedge_ids.size()) - 1);
  EXPECT_EQ(patch.vertices.positions.points.col(middle), patch.vertices.positions.points.col(0));
  const std::vector<Triangle> old = sorted(s.halfedges.faces());
  patch.wedge_ids.back() = s.halfedges.split(h);
  const std::vector<Triangle> halved = in_mesh(patch, split_faces(patch, middle));
  EXPECT_EQ(halved.size(), patch.faces.size() + 2);
  const std::vector<Triangle> all = faces_of(s.halfedges);
  EXPECT_TRUE(std::ranges::includes(all, halved));
  std::vector<Triangle> rest = in_mesh(patch, patch.faces), both;
  std::ranges::set_difference(old, rest, std::back_inserter(both));
  both.insert(both.end(), halved.begin(), halved.end());
  EXPECT_EQ(sorted(both), all);
}

TEST(EdgePatch, MergedFacesAreThoseOfTheCollapsedMesh) {
  for (int stays : {0, 1}) {
    test::WorkingScene s(test::sphere(2, .3, 2), test::unit_sphere());
    const int h = 3 * 17 + 1;
    const EdgePatch patch = *cut_patch(s.mesh, h, 2, 200);
    s.halfedges.collapse(h, stays == 0 ? s.halfedges.from(h) : s.halfedges.to(h));
    const std::vector<Triangle> merged = in_mesh(patch, collapsed_faces(patch, stays));
    EXPECT_EQ(merged.size(), patch.faces.size() - 2);
    EXPECT_TRUE(std::ranges::includes(faces_of(s.halfedges), merged));
  }
}

TEST(EdgePatch, EndsAtCreases) {
  // The middle line of a grid is a crease: what lies beyond is not seen, and its vertices stand still.
  const int n = 6, middle = 3 * (n + 1);
  std::vector<Edge> creases;
  for (int i = 0; i < n; ++i) creases.push_back({middle + i, middle + i + 1});
  test::WorkingScene s(test::grid(n, test::flat), test::plane(), creases);
  const int h = test::half_edge(s.halfedges, 2 * (n + 1) + 3, 2 * (n + 1) + 4);
  ASSERT_GE(h, 0);
  const EdgePatch patch = *cut_patch(s.mesh, h, 2, 200);
  for (size_t i = 0; i < patch.wedge_ids.size(); ++i) {
    const double y = patch.vertices.positions.points(1, static_cast<Eigen::Index>(i));
    EXPECT_LE(y, .5 + 1e-12);
    if (y > .5 - 1e-12 && i < patch.movable) {
      EXPECT_EQ(patch.vertices.constraints.freedom[i], Freedom::fixed);
    }
  }
}

TEST(EdgePatch, FoldsAtItsBoundaryAreSeen) {
  test::WorkingScene s(test::grid(8, test::flat), test::plane());
  const int h = test::half_edge(s.halfedges, 4 * 9 + 3, 4 * 9 + 4);
  EdgePatch patch = *cut_patch(s.mesh, h, 1, 200);
  EXPECT_FALSE(patch.boundary.empty());
  EXPECT_FALSE(folds_at_patch_boundary(patch, flipped_faces(patch), s.mesh, {}));
  for (size_t i = 0; i < patch.movable; ++i)  // turned over, beyond the boundary of the patch
    patch.vertices.positions.points.col(static_cast<Eigen::Index>(i)) += Vec3(2, 0, .1);
  EXPECT_TRUE(folds_at_patch_boundary(patch, flipped_faces(patch), s.mesh, {}));
}

/// A fan of `valence` triangles about vertex 0, and a ring of faces around it.
test::Triangles wheel(int valence) {
  test::Triangles t;
  t.points.resize(3, 1 + 2 * valence);
  t.points.col(0).setZero();
  for (int i = 0; i < valence; ++i) {
    const double phi = 2 * std::numbers::pi * i / valence;
    t.points.col(1 + i) = Vec3(std::cos(phi), std::sin(phi), 0);
    t.points.col(1 + valence + i) = 2 * Vec3(std::cos(phi), std::sin(phi), 0);
    const int a = 1 + i, b = 1 + (i + 1) % valence;
    t.faces.push_back({0, a, b});
    t.faces.push_back({a, a + valence, b + valence});
    t.faces.push_back({a, b + valence, b});
  }
  return t;
}

TEST(EdgePatch, IsNotCutWhereAVertexThatWouldMoveHasTooManyEdges) {
  test::WorkingScene s(wheel(60), test::plane());
  const int h = test::half_edge(s.halfedges, 1, 61);  // the hub is a neighbour of its first end
  EXPECT_TRUE(cut_patch(s.mesh, h, 1, 60).has_value());
  EXPECT_FALSE(cut_patch(s.mesh, h, 1, 59).has_value());
}

TEST(EdgePatch, FoldsOfTheFlippedFacesAtACreaseAreSeen) {
  // Two sheets that meet at 84 degrees; the one with the patch is rough.
  constexpr int n = 10;
  const int middle = n / 2 * (n + 1);
  std::vector<Edge> creases;
  for (int i = 0; i < n; ++i) creases.push_back({middle + i, middle + i + 1});
  const Surface rough = [](const Vec3& x, int hint, double) {
    const Vec3 up = x[1] < .5 ? Vec3(Vec3::UnitZ()) : Vec3(0, -.9945, .1045);
    return Projection{x, up, hint, ProjectionStatus::converged, 1};
  };
  int breaks = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    test::Triangles t = test::grid(n, test::flat);
    unsigned state = seed;
    for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
      state = state * 1664525u + 1013904223u;
      const double y = t.points(1, v), noise = .02 * (state / 4294967296. - .5);
      if (y > .5 + 1e-9)
        t.points.col(v) = Vec3(t.points(0, v), .5 + (y - .5) * .1045, (y - .5) * .9945);
      else if (y < .5 - 1e-9)
        t.points(2, v) = noise;
    }
    test::WorkingScene s(t, rough, creases);
    const ShapeLimits limits{.fold = .12};
    for (int h = 0; h < s.halfedges.half_edge_count(); ++h) {
      if (s.halfedges.twin(h) < h || s.halfedges.is_crease(h) || !may_flip(s.mesh, h)) continue;
      const auto patch = cut_patch(s.mesh, h, 1, 200);
      bool broken = false;
      const auto folds = [&] {
        std::vector<double> cosines;
        for (const Edge& e : creases) {
          const int halfedge = test::half_edge(s.halfedges, e[0], e[1]);
          cosines.push_back(cosine_between(s.positions.points, s.halfedges.faces()[halfedge / 3],
                                           s.halfedges.faces()[s.halfedges.twin(halfedge) / 3]));
        }
        return cosines;
      };
      const bool seen = folds_at_patch_boundary(*patch, flipped_faces(*patch), s.mesh, limits);
      HalfedgeMesh before = s.halfedges;
      const std::vector<double> old = folds();
      s.halfedges.flip(h);
      const std::vector<double> now = folds();
      s.halfedges = before;
      for (size_t i = 0; i < now.size(); ++i) broken |= crease_fold_breaks(limits, old[i], now[i]);
      breaks += broken;
      EXPECT_EQ(seen, broken);
    }
  }
  EXPECT_GT(breaks, 0);
}

TEST(EdgePatch, IsNotCutWhereTooManyVerticesWouldMove) {
  test::WorkingScene s(test::sphere(3, .3, 2), test::unit_sphere());
  const size_t movable = cut_patch(s.mesh, 0, 2, 200)->movable;
  EXPECT_TRUE(cut_patch(s.mesh, 0, 2, movable).has_value());
  EXPECT_FALSE(cut_patch(s.mesh, 0, 2, movable - 1).has_value());
}

}  // namespace hooke::patch_test
