#include "hooke/connectivity/collapse_passes.h"

#include <gtest/gtest.h>

#include <memory>

#include "adapting_scene.h"
#include "hooke/connectivity/edge_collapses.h"
#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/topology.h"

namespace hooke {
namespace {

constexpr int cells = 12;

test::Triangles rough() {
  return test::grid(cells, test::flat, .35);
}

/// Half-edges of edges with both ends inside.
std::vector<int> inner_edges(const Triangulation& t) {
  std::vector<int> edges;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.twin(h) > h && !t.on_boundary(t.from(h)) && !t.on_boundary(t.to(h))) edges.push_back(h);
  return edges;
}

/// Of the edges at the vertex.
double longest_at(const AdaptingMesh& m, int v) {
  double longest = 0;
  for (int h : m.triangulation.outgoing(v)) longest = std::max(longest, relative_length(m, h));
  return longest;
}

TEST(CollapseTrial, LeavesTheMeshAlone) {
  test::AdaptingScene s(rough(), test::plane());
  const Mat3X points = s.placement.points, normals = s.placement.normals;
  const std::vector<Triangle> faces = s.triangulation.faces();
  int allowed = 0;
  for (int h : inner_edges(s.triangulation)) allowed += try_collapse(s.adapting, h, {}).has_value();
  EXPECT_GT(allowed, 0);
  EXPECT_EQ(s.placement.points, points);
  EXPECT_EQ(s.placement.normals, normals);
  EXPECT_EQ(s.triangulation.faces(), faces);
}

TEST(CollapseTrial, IsWhatCollapseEdgeDoes) {
  for (int k = 0; k < 200; k += 7) {
    test::AdaptingScene s(rough(), test::plane());
    const int h = inner_edges(s.triangulation)[static_cast<size_t>(k)];
    const std::optional<Collapse> trial = try_collapse(s.adapting, h, {});
    EXPECT_EQ(collapse_edge(s.adapting, h, {}), trial ? trial->stays : -1);
    if (trial) {
      EXPECT_EQ(Vec3(s.placement.points.col(trial->stays)), trial->place.point);
      EXPECT_TRUE(s.triangulation.is_gone(h / 3));
    }
  }
}

TEST(CollapseTrial, LeavesNoLongEdgesButWhereThereWereLongerOnes) {
  constexpr double longest = 1.1;
  int allowed = 0, refused = 0;
  for (size_t k = 0; k < inner_edges(test::AdaptingScene(rough(), test::plane()).triangulation).size(); ++k) {
    test::AdaptingScene s(rough(), test::plane());
    const int h = inner_edges(s.triangulation)[k];
    const double before = std::max(longest_at(s.adapting, s.triangulation.from(h)),
                                   longest_at(s.adapting, s.triangulation.to(h)));
    const int v = collapse_edge(s.adapting, h, {.longest = longest});
    (v < 0 ? refused : allowed)++;
    if (v >= 0) {
      EXPECT_LE(longest_at(s.adapting, v), std::max(longest, before) + 1e-9);
    }
  }
  EXPECT_GT(allowed, 0);
  EXPECT_GT(refused, 0);
}

/// Of the faces at the vertex, their edges there and what is across their sides.
WorstShape worst_at(const AdaptingMesh& m, int v) {
  const Triangulation& t = m.triangulation;
  const Mat3X &X = m.placement.points, &N = m.placement.normals;
  WorstShape worst;
  for (int spoke : t.outgoing(v)) {
    const auto f = static_cast<size_t>(spoke / 3);
    worst.cotangent = std::max(worst.cotangent, greatest_cotangent(X, t.faces()[f]));
    worst.alignment = std::min(worst.alignment, face_alignment(X, N, t.faces()[f], t.sides()[f]));
    for (int h : {spoke, Triangulation::next(spoke), Triangulation::previous(spoke)}) {
      const Edge edge = {t.from(h), t.to(h)}, sides = {t.side(h), t.side(Triangulation::next(h))};
      if (edge[0] == v || edge[1] == v)
        worst.sagitta =
            std::max(worst.sagitta, edge_sagitta(X, N, edge, sides) / target_length(m, edge[0], edge[1]));
      if (!t.is_border(h))
        worst.fold = std::min(worst.fold,
                              cosine_between(X, t.faces()[f], t.faces()[static_cast<size_t>(t.twin(h) / 3)]));
    }
  }
  return worst;
}

/// Every so many-th edge that may collapse, in a mesh of its own: what the ring foresees is there afterwards.
template <typename MakeScene>
void expect_rings_to_foresee(const MakeScene& make_scene, int every) {
  int collapses = 0;
  for (int h = 0; h < make_scene()->triangulation.half_edge_count(); h += every) {
    const auto s = make_scene();
    const std::optional<Collapse> trial = try_collapse(s->adapting, h, {.longest = 3});
    if (!trial) continue;
    const WorstShape foreseen = MergedRing(s->adapting, h, trial->stays).worst(trial->place);
    ASSERT_EQ(collapse_edge(s->adapting, h, {.longest = 3}), trial->stays);
    const WorstShape seen = worst_at(s->adapting, trial->stays);
    EXPECT_NEAR(foreseen.cotangent, seen.cotangent, 1e-12);
    EXPECT_NEAR(foreseen.alignment, seen.alignment, 1e-12);
    EXPECT_NEAR(foreseen.fold, seen.fold, 1e-12);
    EXPECT_NEAR(foreseen.sagitta, seen.sagitta, 1e-12);
    ++collapses;
  }
  EXPECT_GT(collapses, 5);
}

TEST(MergedRing, ForeseesWhatIsThereAfterwards) {
  expect_rings_to_foresee([] { return std::make_unique<test::AdaptingScene>(rough(), test::plane()); }, 11);
  expect_rings_to_foresee(
      [] { return std::make_unique<test::AdaptingScene>(test::sphere(2, .2), test::unit_sphere()); }, 11);
}

TEST(MergedRing, ForeseesItOnBothSidesOfACrease) {
  std::vector<Edge> row;
  for (int v = cells / 2 * (cells + 1); row.size() < cells; ++v) row.push_back({v, v + 1});
  const auto creased = [&] {
    auto s = std::make_unique<test::AdaptingScene>(test::grid(cells, test::flat), test::plane(), row);
    for (int& wanted : s->curve_edges.wanted) wanted = 1;
    return s;
  };
  expect_rings_to_foresee(creased, 1);
}

TEST(EdgeCollapses, DoNotDependOnThreads) {
  std::vector<Mat3X> points;
  std::vector<std::vector<Triangle>> faces;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    test::AdaptingScene s(rough(), test::plane());
    for (double& length : s.vertex_length) length *= 1.5;
    count_curve_edges(s.adapting, .1);
    EXPECT_GT(collapse_short_edges(s.adapting, {}), cells);
    compact(s.adapting);
    points.push_back(s.placement.points);
    faces.push_back(s.triangulation.faces());
    const Connectivity c = make_connectivity(static_cast<int>(s.placement.points.cols()), faces.back());
    EXPECT_EQ(measure_topology(c).euler, 1);
  }
  EXPECT_EQ(points[0], points[1]);
  EXPECT_EQ(faces[0], faces[1]);
}

/// Though many edges of a curve that has a few too many are tried at once.
TEST(EdgeCollapses, LeaveCurvesTheEdgesTheyWant) {
  constexpr int n = 40;
  test::AdaptingScene s(test::grid(n, test::flat), test::plane());
  for (size_t v = 0; v < s.vertex_length.size(); ++v)
    s.vertex_length[v] = (s.triangulation.on_boundary(static_cast<int>(v)) ? 1.1 : 1.) / n;
  count_curve_edges(s.adapting, .1);
  EXPECT_GT(collapse_short_edges(s.adapting, {.shortest = .95, .longest = 10}), 0);
  ASSERT_EQ(s.curve_edges.wanted.size(), 4u);
  for (size_t c = 0; c < 4; ++c) {
    EXPECT_LT(s.curve_edges.wanted[c], n);
    EXPECT_EQ(s.curve_edges.present[c], s.curve_edges.wanted[c]);
  }
}

}  // namespace
}  // namespace hooke
