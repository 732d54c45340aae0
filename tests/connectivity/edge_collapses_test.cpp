#include "hooke/connectivity/edge_collapses.h"

#include <gtest/gtest.h>

#include <memory>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/topology.h"
#include "hooke/working_mesh/working_mesh.h"
#include "support/working_scene.h"

namespace hooke::edge_collapses_test {

constexpr int cells = 12;

test::Triangles rough() {
  return test::grid(cells, test::flat, .35);
}

/// Half-edges of edges with both ends inside.
std::vector<int> inner_edges(const HalfedgeMesh& t) {
  std::vector<int> edges;
  for (int h = 0; h < t.half_edge_count(); ++h)
    if (t.twin(h) > h && !t.on_boundary(t.from(h)) && !t.on_boundary(t.to(h))) edges.push_back(h);
  return edges;
}

/// Maximum relative length of the edges at the vertex.
double longest_at(const WorkingMesh& m, int v) {
  double longest = 0;
  for (int h : m.halfedges.outgoing(v)) longest = std::max(longest, relative_length(m, h));
  return longest;
}

TEST(CollapseTrial, LeavesTheMeshAlone) {
  test::WorkingScene s(rough(), test::plane());
  const Mat3X points = s.positions.points, normals = s.positions.normals;
  const std::vector<Triangle> faces = s.halfedges.faces();
  int allowed = 0;
  for (int h : inner_edges(s.halfedges)) allowed += find_collapse(s.mesh, h, {}).has_value();
  EXPECT_GT(allowed, 0);
  EXPECT_EQ(s.positions.points, points);
  EXPECT_EQ(s.positions.normals, normals);
  EXPECT_EQ(s.halfedges.faces(), faces);
}

TEST(CollapseTrial, IsWhatCollapseEdgeDoes) {
  for (int k = 0; k < 200; k += 7) {
    test::WorkingScene s(rough(), test::plane());
    const int h = inner_edges(s.halfedges)[k];
    const std::optional<Collapse> collapse = find_collapse(s.mesh, h, {});
    EXPECT_EQ(collapse_edge(s.mesh, h, {}), collapse ? collapse->stays : -1);
    if (collapse) {
      EXPECT_EQ(Vec3(s.positions.points.col(collapse->stays)), collapse->position.point);
      EXPECT_TRUE(s.halfedges.is_removed(h / 3));
    }
  }
}

TEST(CollapseTrial, LeavesNoLongEdgesButWhereThereWereLongerOnes) {
  constexpr double longest = 1.1;
  int allowed = 0, refused = 0;
  for (size_t k = 0; k < inner_edges(test::WorkingScene(rough(), test::plane()).halfedges).size(); ++k) {
    test::WorkingScene s(rough(), test::plane());
    const int h = inner_edges(s.halfedges)[k];
    const double before =
        std::max(longest_at(s.mesh, s.halfedges.from(h)), longest_at(s.mesh, s.halfedges.to(h)));
    const int v = collapse_edge(s.mesh, h, {.longest = longest});
    (v < 0 ? refused : allowed)++;
    if (v >= 0) {
      EXPECT_LE(longest_at(s.mesh, v), std::max(longest, before) + 1e-9);
    }
  }
  EXPECT_GT(allowed, 0);
  EXPECT_GT(refused, 0);
}

/// The worst shape of the faces at the vertex, its edges, and the dihedral angles of its faces.
LocalShape worst_at(const WorkingMesh& m, int v) {
  const HalfedgeMesh& t = m.halfedges;
  const Mat3X &X = m.vertices.positions.points, &N = m.vertices.positions.normals;
  LocalShape worst;
  for (int outgoing : t.outgoing(v)) {
    const auto f = static_cast<size_t>(outgoing / 3);
    worst.add_face(X, N, t.faces()[f], t.wedges()[f]);
    for (int h : {outgoing, HalfedgeMesh::next(outgoing), HalfedgeMesh::previous(outgoing)}) {
      const Edge edge = {t.from(h), t.to(h)}, wedges = {t.wedge(h), t.wedge(HalfedgeMesh::next(h))};
      if (edge[0] == v || edge[1] == v)
        worst.add_edge(X, N, edge, wedges, target_length(m, edge[0], edge[1]));
      if (!t.is_feature_edge(h)) worst.add_fold(cosine_between(X, t.faces()[f], t.faces()[t.twin(h) / 3]));
    }
  }
  return worst;
}

/// Collapses every `every`-th edge that may collapse, each in a fresh mesh, and compares with the predicted
/// one-ring.
template <typename MakeScene>
void expect_rings_to_predict(const MakeScene& make_scene, int every) {
  int collapses = 0;
  for (int h = 0; h < make_scene()->halfedges.half_edge_count(); h += every) {
    const auto s = make_scene();
    const std::optional<Collapse> collapse = find_collapse(s->mesh, h, {.longest = 3});
    if (!collapse) continue;
    const LocalShape predicted = CollapsedRing(s->mesh, h, collapse->stays).worst(collapse->position);
    ASSERT_EQ(collapse_edge(s->mesh, h, {.longest = 3}), collapse->stays);
    const LocalShape measured = worst_at(s->mesh, collapse->stays);
    EXPECT_NEAR(predicted.cotangent, measured.cotangent, 1e-12);
    EXPECT_NEAR(predicted.alignment, measured.alignment, 1e-12);
    EXPECT_NEAR(predicted.fold, measured.fold, 1e-12);
    EXPECT_NEAR(predicted.sagitta, measured.sagitta, 1e-12);
    ++collapses;
  }
  EXPECT_GT(collapses, 5);
}

TEST(CollapsedRing, PredictsWhatIsThereAfterwards) {
  expect_rings_to_predict([] { return std::make_unique<test::WorkingScene>(rough(), test::plane()); }, 11);
  expect_rings_to_predict(
      [] { return std::make_unique<test::WorkingScene>(test::sphere(2, .2), test::unit_sphere()); }, 11);
}

TEST(CollapsedRing, PredictsItOnBothSidesOfACrease) {
  std::vector<Edge> row;
  for (int v = cells / 2 * (cells + 1); row.size() < cells; ++v) row.push_back({v, v + 1});
  const auto creased = [&] {
    auto s = std::make_unique<test::WorkingScene>(test::grid(cells, test::flat), test::plane(), row);
    for (int& target : s->mesh.curve_edges.target) target = 1;
    return s;
  };
  expect_rings_to_predict(creased, 1);
}

TEST(EdgeCollapses, DoNotDependOnThreads) {
  std::vector<Mat3X> points;
  std::vector<std::vector<Triangle>> faces;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    test::WorkingScene s(rough(), test::plane());
    for (double& length : s.vertices.vertex_length) length *= 1.5;
    count_curve_edges(s.mesh, .1);
    EXPECT_GT(collapse_short_edges(s.mesh), cells);
    compact(s.mesh);
    points.push_back(s.positions.points);
    faces.push_back(s.halfedges.faces());
    const Adjacency c = make_adjacency(static_cast<int>(s.positions.points.cols()), faces.back());
    EXPECT_EQ(measure_topology(c).euler, 1);
  }
  EXPECT_EQ(points[0], points[1]);
  EXPECT_EQ(faces[0], faces[1]);
}

/// Many edges of a curve with a few edges too many are candidates in the same pass.
TEST(EdgeCollapses, LeaveCurvesTheirTargetEdgeCount) {
  constexpr int n = 40;
  test::WorkingScene s(test::grid(n, test::flat), test::plane());
  for (size_t v = 0; v < s.vertices.vertex_length.size(); ++v)
    s.vertices.vertex_length[v] = (s.halfedges.on_boundary(static_cast<int>(v)) ? 1.1 : 1.) / n;
  count_curve_edges(s.mesh, .1);
  EXPECT_GT(collapse_short_edges(s.mesh, {.shortest = .95, .longest = 10}), 0);
  ASSERT_EQ(s.mesh.curve_edges.target.size(), 4u);
  for (size_t c = 0; c < 4; ++c) {
    EXPECT_LT(s.mesh.curve_edges.target[c], n);
    EXPECT_EQ(s.mesh.curve_edges.present[c], s.mesh.curve_edges.target[c]);
  }
}

constexpr int fold_cells = 8;

/// A grid whose middle vertex has been moved by so many cells.
test::Triangles with_moved_middle(double cells_in_x, double cells_in_y) {
  test::Triangles t = test::grid(fold_cells, test::flat);
  const Eigen::Index middle = fold_cells / 2 * (fold_cells + 2);
  t.points.col(middle) += Vec3(cells_in_x, cells_in_y, 0) / fold_cells;
  return t;
}

/// Number and worst alignment of the remaining faces.
struct FaceSummary {
  int faces = 0;
  double min_alignment = 1;
};

FaceSummary summarize(const WorkingMesh& m) {
  FaceSummary summary;
  for (size_t f = 0; f < m.halfedges.faces().size(); ++f) {
    if (m.halfedges.is_removed(static_cast<int>(f))) continue;
    const Triangle& t = m.halfedges.faces()[f];
    ++summary.faces;
    summary.min_alignment = std::min(
        summary.min_alignment, face_alignment(m.vertices.positions.points, m.vertices.positions.normals, t));
  }
  return summary;
}

void expect_a_disk(test::WorkingScene& s) {
  compact(s.mesh);
  const Adjacency c = make_adjacency(static_cast<int>(s.positions.points.cols()), s.halfedges.faces());
  EXPECT_EQ(measure_topology(c).euler, 1);
  EXPECT_EQ(measure_topology(c).boundary_loops, 1);
}

TEST(FaceCollapses, TakeOutFoldedFaces) {
  test::WorkingScene s(with_moved_middle(1.4, 0), test::plane());
  ASSERT_LT(summarize(s.mesh).min_alignment, 0);
  EXPECT_GE(collapse_folded_faces(s.mesh), 1);
  const FaceSummary after = summarize(s.mesh);
  EXPECT_GT(after.min_alignment, .99);
  EXPECT_GE(after.faces, 2 * fold_cells * fold_cells - 4);
  expect_a_disk(s);
}

TEST(FaceCollapses, LeaveGoodFacesAlone) {
  test::WorkingScene s(test::grid(fold_cells, test::flat), test::plane());
  EXPECT_EQ(collapse_folded_faces(s.mesh), 0);
  EXPECT_EQ(summarize(s.mesh).faces, 2 * fold_cells * fold_cells);
}

}  // namespace hooke::edge_collapses_test
