#include "hooke/connectivity/sliver_removal.h"

#include <gtest/gtest.h>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/topology.h"
#include "support/working_scene.h"

namespace hooke::sliver_removal_test {

constexpr int cells = 8, faces = 2 * cells * cells;
constexpr FaceCountLimits any_count = {0, 1e9}, same_count = {faces, faces};

/// A grid whose middle vertex has been moved by so many cells.
test::Triangles with_moved_middle(double cells_in_x, double cells_in_y) {
  test::Triangles t = test::grid(cells, test::flat);
  t.points.col(cells / 2 * (cells + 2)) += Vec3(cells_in_x, cells_in_y, 0) / cells;
  return t;
}

SliverChanges change(test::WorkingScene& s, const FaceCountLimits& limits = any_count,
                     const SliverOptions& options = {}, const Observer& observer = nullptr,
                     int tested_before = 0) {
  return change_slivers(s.mesh, {}, options, {}, limits, tested_before, observer);
}

std::vector<Triangle> faces_of(const test::WorkingScene& s) {
  std::vector<Triangle> left = s.halfedges.faces();
  std::erase_if(left, [](const Triangle& t) { return t[0] < 0; });
  return left;
}

double min_angle_of(const test::WorkingScene& s) {
  return min_angle(s.positions.points, faces_of(s));
}

auto folded_faces_of(const test::WorkingScene& s) {
  return std::ranges::count_if(faces_of(s), [&](const Triangle& t) {
    return face_alignment(s.positions.points, s.positions.normals, t) < 0;
  });
}

void expect_a_disk(test::WorkingScene& s) {
  compact(s.mesh);
  const Topology t =
      measure_topology(make_adjacency(static_cast<int>(s.positions.points.cols()), s.halfedges.faces()));
  EXPECT_EQ(t.euler, 1);
  EXPECT_EQ(t.boundary_loops, 1);
}

/// A grid with a vertex of 12 edges, which relaxation alone cannot improve.
void crowd(test::WorkingScene& s) {
  const int hub = cells / 2 * (cells + 2);
  for (int extra = 0; extra < 6; ++extra)
    for (int outgoing : s.halfedges.outgoing(hub)) {
      const int h = HalfedgeMesh::next(outgoing), g = s.halfedges.twin(h);
      if (g < 0 || s.halfedges.adjacent(hub, s.halfedges.opposite_vertex(g)) ||
          s.halfedges.valence(s.halfedges.from(h)) <= 4 || s.halfedges.valence(s.halfedges.to(h)) <= 4)
        continue;
      s.halfedges.flip(h);
      break;
    }
}

void expect_slivers_removed(test::WorkingScene& s) {
  ASSERT_LT(min_angle_of(s), 20);
  EXPECT_GE(change(s).count(), 1);
  EXPECT_GT(min_angle_of(s), 30);
  expect_a_disk(s);
}

TEST(SliverRemoval, RemovesWhatAMovedVertexLeaves) {
  test::WorkingScene s(with_moved_middle(.7, .1), test::plane());
  expect_slivers_removed(s);
}

TEST(SliverRemoval, RemovesSliversAtCrowdedVertices) {
  test::WorkingScene s(test::grid(cells, test::flat), test::plane());
  crowd(s);
  ASSERT_GE(s.halfedges.valence(cells / 2 * (cells + 2)), 11);
  expect_slivers_removed(s);
}

TEST(SliverRemoval, WhereTheCountIsToStayThereAreOnlyFlips) {
  test::WorkingScene s(test::grid(cells, test::flat), test::plane());
  crowd(s);
  const double before = min_angle_of(s);
  const SliverChanges changes = change(s, same_count);
  EXPECT_GE(changes.flips, 1);
  EXPECT_EQ(changes.count(), changes.flips);
  EXPECT_GT(min_angle_of(s), before);
  EXPECT_EQ(s.halfedges.id_count(), (cells + 1) * (cells + 1));
  EXPECT_EQ(std::ssize(faces_of(s)), faces);
}

TEST(SliverRemoval, KeepsTheCountWithinItsLimits) {
  for (const FaceCountLimits& limits :
       {FaceCountLimits{faces - 2, faces}, FaceCountLimits{faces, faces + 2}}) {
    test::WorkingScene s(test::grid(cells, test::flat, .45, 7), test::plane());
    EXPECT_GT(change(s, limits, {.sliver_angles = {40}}).count(), 0);
    const auto count = static_cast<double>(faces_of(s).size());
    EXPECT_GE(count, limits.min);
    EXPECT_LE(count, limits.max);
  }
}

TEST(SliverRemoval, NeverLowersTheLeastAngleNorFoldsAFace) {
  SliverChanges all;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    test::WorkingScene s(test::grid(cells, test::flat, .45, seed), test::plane());
    const double before = min_angle_of(s);
    const auto folded_before = folded_faces_of(s);
    const SliverChanges changes = change(s);
    all.flips += changes.flips;
    all.splits += changes.splits;
    all.collapses += changes.collapses;
    EXPECT_GE(min_angle_of(s), before - 1e-12) << seed;
    EXPECT_EQ(std::ssize(faces_of(s)), faces + 2 * (changes.splits - changes.collapses)) << seed;
    EXPECT_LE(folded_faces_of(s), folded_before) << seed;
    expect_a_disk(s);
  }
  EXPECT_GT(all.flips, 0);
  EXPECT_GT(all.collapses, 0);
}

TEST(SliverRemoval, AddsNothingBeyondTheLimits) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    test::WorkingScene s(test::sphere(2, .4, seed), test::unit_sphere());
    const auto worst = [&](const auto& measure) {
      double most = 0;
      for (const Triangle& t : faces_of(s))
        for (size_t k : {0, 1, 2}) most = std::max(most, measure(Edge{t[k], t[(k + 1) % 3]}));
      return most;
    };
    const auto length = [&](const Edge& e) {
      return (s.positions.points.col(e[0]) - s.positions.points.col(e[1])).norm() /
             s.vertices.vertex_length[0];
    };
    const auto sagitta = [&](const Edge& e) {
      return edge_sagitta(s.positions.points, s.positions.normals, e) / s.vertices.vertex_length[0];
    };
    const double longest = std::max(max_length_near_slivers, worst(length));
    const double deepest = std::max(max_sagitta_near_slivers, worst(sagitta));
    EXPECT_GT(change(s, any_count, {.sliver_angles = {40}}).count(), 0);
    EXPECT_LE(worst(length), longest + 1e-9) << seed;
    EXPECT_LE(worst(sagitta), deepest + 1e-9) << seed;
  }
}

TEST(SliverRemoval, LeavesCreasesWhereTheyAre) {
  std::vector<Edge> creases;
  const int middle = cells / 2 * (cells + 1);
  for (int i = 0; i < cells; ++i) creases.push_back({middle + i, middle + i + 1});
  SliverChanges all;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    test::WorkingScene s(test::grid(cells, test::flat, .4, seed), test::plane(), creases);
    const Mat3X before = s.positions.points;
    const SliverChanges changes = change(s);
    all.splits += changes.splits;
    all.collapses += changes.collapses;
    for (int i = 0; i <= cells; ++i)
      EXPECT_EQ(s.positions.points.col(middle + i), before.col(middle + i)) << seed;
    compact(s.mesh);
    EXPECT_EQ(s.constraints.creases.size(), creases.size()) << seed;
    expect_a_disk(s);
  }
  EXPECT_GT(all.splits + all.collapses, 0);
}

TEST(SliverRemoval, NoEdgeIsTriedAgainWhereNothingHasChanged) {
  // A sliver at a corner of the boundary, where no candidate is tried to the end: it is evaluated once.
  test::Triangles t = test::grid(cells, test::flat);
  const auto tip = t.points.cols();
  t.points.conservativeResize(3, tip + 1);
  t.points.col(tip) = Vec3(4.5 / cells, -3. / cells, 0);
  t.faces.push_back({5, 4, static_cast<int>(tip)});
  test::WorkingScene s(t, test::plane());
  int calls = 0;
  const auto count = [&](const Progress&) { return ++calls > 0; };
  const SliverOptions options{.sliver_angles = {30}, .searched = 0};
  EXPECT_EQ(change(s, same_count, options, count).count(), 0);
  EXPECT_EQ(calls, 1);
}

TEST(SliverRemoval, ThereAreNoMoreTriesThanAllowed) {
  const auto tested = [](int most, int before = 0) {
    test::WorkingScene s(test::grid(cells, test::flat, .45, 7), test::plane());
    return change(s, any_count, {.share_in_all = 0, .min_in_all = most}, nullptr, before).tested;
  };
  EXPECT_EQ(tested(0), 0);
  EXPECT_EQ(tested(3), 3);
  EXPECT_EQ(tested(3, 2), 1);
  EXPECT_EQ(tested(3, 5), 0);
}

TEST(SliverRemoval, KeepsNothingThatIsNotTriedToTheEnd) {
  const auto changes = [](size_t searched) {
    test::WorkingScene s(test::grid(cells, test::flat, .45, 7), test::plane());
    return change(s, any_count, {.searched = searched}).count();
  };
  EXPECT_EQ(changes(0), 0);
  EXPECT_GT(changes(1), 0);
}

TEST(SliverRemoval, LeavesGoodFacesAlone) {
  test::WorkingScene s(test::grid(cells, test::flat), test::plane());
  const Mat3X before = s.positions.points;
  EXPECT_EQ(change(s).count(), 0);
  EXPECT_EQ(s.positions.points, before);
}

TEST(SliverRemoval, ThreadsChangeNothing) {
  const auto result = [](int threads) {
    const ThreadLimit limit(threads);
    test::WorkingScene s(test::grid(cells, test::flat, .45, 3), test::plane());
    EXPECT_GT(change(s).count(), 0);
    compact(s.mesh);
    return std::pair(s.halfedges.faces(), s.positions.points);
  };
  EXPECT_EQ(result(1), result(2));
}

TEST(SliverRemoval, StopsWhenTheObserverSaysSo) {
  test::WorkingScene s(test::grid(cells, test::flat, .45, 3), test::plane());
  int calls = 0;
  const SliverChanges changes = change(s, any_count, {}, [&](const Progress&) { return ++calls < 2; });
  EXPECT_EQ(calls, 2);
  EXPECT_LE(changes.count(), 1);
  expect_a_disk(s);
}

}  // namespace hooke::sliver_removal_test
