#include "hooke/connectivity/edge_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hooke/constraints/constraints.h"
#include "hooke/integrator/guards.h"
#include "hooke/mesh/halfedge_mesh.h"
#include "hooke/mesh/topology.h"
#include "hooke/springs/energy.h"
#include "hooke/working_mesh/working_mesh.h"
#include "support/working_scene.h"

namespace hooke::edge_trial_test {

constexpr double sliver_angle = 35;

std::vector<EdgeChange> changes_of(const test::WorkingScene& s) {
  std::vector<EdgeChange> changes;
  for (int h = 0; h < s.halfedges.half_edge_count(); ++h) {
    if (s.halfedges.twin(h) > h || s.halfedges.is_feature_edge(h)) continue;
    const std::vector<EdgeChange> allowed = allowed_changes(s.mesh, h, {});
    changes.insert(changes.end(), allowed.begin(), allowed.end());
  }
  return changes;
}

/// All candidates that were tried to the end.
std::vector<EdgeCandidate> tried(const test::WorkingScene& s) {
  const EnergyTerms terms;
  CandidateEvaluator evaluator(s.mesh, terms, {});
  evaluator.set_sliver_angle(sliver_angle);
  std::vector<EdgeCandidate> tried;
  for (const EdgeChange& change : changes_of(s)) {
    EdgeCandidate candidate = evaluator.begin(change);
    if (!candidate.is_viable) continue;
    evaluator.finish(candidate);
    tried.push_back(std::move(candidate));
  }
  return tried;
}

/// Those that are accepted.
std::vector<EdgeCandidate> kept(const test::WorkingScene& s) {
  std::vector<EdgeCandidate> candidates = tried(s);
  std::erase_if(candidates, [](const EdgeCandidate& candidate) { return !candidate.is_viable; });
  return candidates;
}

PatchQuality quality_after(const EdgeCandidate& candidate) {
  return measure_patch(candidate.patch.vertices.positions, candidate.adjacency, candidate.targets,
                       sliver_angle, {.sagitta = max_sagitta_near_slivers});
}

test::WorkingScene rough_sphere() {
  return {test::sphere(2, .4), test::unit_sphere()};
}

constexpr double lens_height = .12;

test::Triangles thin_lens() {
  test::Triangles t = test::sphere(2, .4);
  t.points.row(2) *= lens_height;
  return t;
}

/// An ellipsoid, onto which points move along their rays.
Surface lens_surface() {
  return [](const Vec3& x, int hint, double) {
    const Vec3 axes(1, 1, lens_height), on_sphere = x.cwiseQuotient(axes).normalized();
    return Projection{on_sphere.cwiseProduct(axes), on_sphere.cwiseQuotient(axes).normalized(), hint,
                      ProjectionStatus::converged, 1};
  };
}

TEST(EdgeCandidate, LeavesTheMeshAlone) {
  const test::WorkingScene s = rough_sphere();
  const Mat3X points = s.positions.points;
  const std::vector<Triangle> faces = s.halfedges.faces();
  EXPECT_FALSE(kept(s).empty());
  EXPECT_EQ(s.positions.points, points);
  EXPECT_EQ(s.halfedges.faces(), faces);
}

/// Has it no smaller minimum angle than before, no violation that is worse, and no fold at its boundary?
bool breaks_nothing(const EdgeCandidate& candidate, const test::WorkingScene& s) {
  const PatchQuality after = quality_after(candidate);
  return after.cotangent <= candidate.before.cotangent &&
         is_no_worse(after.violation, candidate.before.violation) &&
         !folds_at_patch_boundary(candidate.patch, candidate.adjacency.faces, s.mesh, {});
}

TEST(EdgeCandidate, IsKeptWhereItGainsEnoughAndKeepsTheLeastAngle) {
  const test::WorkingScene s(test::sphere(2, .1), test::unit_sphere());
  int little = 0, enough = 0;
  for (const EdgeCandidate& candidate : tried(s)) {
    EXPECT_TRUE(!candidate.is_viable || quality_after(candidate).cotangent <= candidate.before.cotangent);
    if (!breaks_nothing(candidate, s)) continue;
    const bool is_enough = candidate.gain >= 4;  // degrees squared
    EXPECT_TRUE(is_enough || !candidate.is_viable);
    (is_enough ? enough : little) += candidate.gain > 0;
  }
  EXPECT_GT(little, 0);
  EXPECT_GT(enough, 0);
}

/// The margin of a thin sheet: where it turns over, changes of edges could cut it off.
TEST(EdgeCandidate, LosesNoMoreSurfaceThanItMay) {
  int lossy = 0;
  const test::WorkingScene s(thin_lens(), lens_surface());
  const double most = .2 * std::pow(s.vertices.vertex_length[0], 2);
  for (const EdgeCandidate& candidate : tried(s)) {
    const double lost = candidate.before.area - quality_after(candidate).area;
    EXPECT_TRUE(lost <= most || !candidate.is_viable);
    lossy += lost > most && candidate.gain >= 4 && breaks_nothing(candidate, s);
  }
  EXPECT_GT(lossy, 0);
}

/// A change that makes the patch much worse is not tried to the end.
TEST(EdgeCandidate, IsGivenUpWhereTheCostRisesMuch) {
  const EnergyTerms terms;
  const test::WorkingScene s(test::sphere(2, .25), test::unit_sphere());
  CandidateEvaluator evaluator(s.mesh, terms, {});
  evaluator.set_sliver_angle(sliver_angle);
  int given_up = 0;
  for (const EdgeChange& change : changes_of(s)) {
    const EdgeCandidate candidate = evaluator.begin(change);
    EXPECT_EQ(candidate.is_viable, candidate.gain >= -500);  // degrees squared
    given_up += !candidate.is_viable;
  }
  EXPECT_GT(given_up, 0);
}

/// A disk of triangles that all meet at its centre.
test::Triangles wheel(int spokes) {
  test::Triangles t{Mat3X::Zero(3, spokes + 1), {}};
  for (int i = 0; i < spokes; ++i) {
    const double turn = 2 * std::numbers::pi * i / spokes;
    t.points.col(i + 1) << std::cos(turn), std::sin(turn), 0;
    t.faces.push_back({0, i + 1, (i + 1) % spokes + 1});
  }
  return t;
}

TEST(EdgeCandidate, IsNotTriedInALargePatch) {
  const EnergyTerms terms;
  const auto is_viable = [&](int spokes) {
    const test::WorkingScene s(wheel(spokes), test::plane());
    CandidateEvaluator evaluator(s.mesh, terms, {});
    evaluator.set_sliver_angle(sliver_angle);
    return std::ranges::any_of(changes_of(s),
                               [&](const EdgeChange& c) { return evaluator.begin(c).is_viable; });
  };
  EXPECT_TRUE(is_viable(12));
  EXPECT_FALSE(is_viable(60));
}

constexpr int cells = 8, across = cells + 1;

int face_at(int column, int row) {
  return 2 * (row * cells + column);
}

/// Topology of the mesh without deleted elements.
Topology topology_of(test::WorkingScene& s) {
  compact(s.mesh);
  return measure_topology(make_adjacency(static_cast<int>(s.positions.points.cols()), s.halfedges.faces()));
}

std::vector<EdgeChange> changes_about(const WorkingMesh& m, int face, const ChangeRules& rules) {
  std::vector<EdgeChange> all;
  for (int h : inner_edges_about(m.halfedges, face))
    for (const EdgeChange& change : allowed_changes(m, h, rules)) all.push_back(change);
  return all;
}

EdgePatch cut(const test::WorkingScene& s, const EdgeChange& change) {
  return *cut_patch(s.mesh, change.half_edge, 2, 200);
}

TEST(EdgeChanges, EachIsDoneAlikeInThePatchAndInTheMesh) {
  const test::Triangles grid = test::grid(cells, test::flat, .3, 5);
  const test::WorkingScene first(grid, test::plane());
  const std::vector<EdgeChange> changes = changes_about(first.mesh, face_at(4, 4), {});
  std::array<int, 3> kinds = {};
  for (const EdgeChange& change : changes) {
    ++kinds[static_cast<size_t>(change.kind)];
    test::WorkingScene s(grid, test::plane());
    const Topology before = measure_topology(s.adjacency);
    EdgePatch patch = cut(s, change);
    const std::vector<Triangle> faces = change_patch(patch, change, test::plane(), {});
    change_mesh(s.mesh, change, patch);
    for (const Triangle& face : faces) {
      const auto in_mesh = [&](int k) { return patch.vertex_ids[face[k]]; };
      const int h = test::half_edge(s.halfedges, in_mesh(0), in_mesh(1));
      ASSERT_GE(h, 0);
      EXPECT_EQ(s.halfedges.opposite_vertex(h), in_mesh(2));
      for (int k : {0, 1, 2})
        EXPECT_EQ(s.positions.points.col(in_mesh(k)), patch.vertices.positions.points.col(face[k]));
    }
    const Topology after = topology_of(s);
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.boundary_loops, before.boundary_loops);
    const int more = change.kind == ChangeKind::flip ? 0 : change.kind == ChangeKind::split ? 2 : -2;
    EXPECT_EQ(after.faces, before.faces + more);
  }
  for (int count : kinds) EXPECT_GT(count, 5);
}

TEST(EdgeChanges, OnlyThoseThatAreAskedFor) {
  const test::WorkingScene s(test::grid(cells, test::flat, .3, 5), test::plane());
  const auto all = changes_about(s.mesh, face_at(4, 4), {});
  const auto flips = changes_about(s.mesh, face_at(4, 4), {.splits = false, .collapses = false});
  EXPECT_FALSE(flips.empty());
  EXPECT_LT(flips.size(), all.size());
  for (const EdgeChange& change : flips) EXPECT_EQ(change.kind, ChangeKind::flip);
}

TEST(EdgeChanges, LeaveTheBoundaryAlone) {
  const test::WorkingScene s(test::grid(cells, test::flat), test::plane());
  const HalfedgeMesh& t = s.halfedges;
  int collapses = 0;
  for (int row : {0, 1}) {
    for (const EdgeChange& change : changes_about(s.mesh, face_at(3, row), {})) {
      EXPECT_GE(t.twin(change.half_edge), 0);
      if (change.kind != ChangeKind::collapse) continue;
      ++collapses;
      EXPECT_FALSE(t.on_boundary(change.stays == 0 ? t.to(change.half_edge) : t.from(change.half_edge)));
    }
  }
  EXPECT_GT(collapses, 0);
}

TEST(EdgeChanges, LeaveCreasesAlone) {
  std::vector<Edge> creases;
  for (int i = 0; i < cells; ++i) creases.push_back({4 * across + i, 4 * across + i + 1});
  const test::WorkingScene s(test::grid(cells, test::flat), test::plane(), creases);
  const HalfedgeMesh& t = s.halfedges;
  int beside = 0;
  for (const EdgeChange& change : changes_about(s.mesh, face_at(3, 3), {})) {
    EXPECT_FALSE(t.is_crease(change.half_edge));
    if (change.kind != ChangeKind::collapse) continue;
    const int a = t.from(change.half_edge), b = t.to(change.half_edge);
    EXPECT_FALSE(t.on_crease(change.stays == 0 ? b : a));
    beside += t.on_crease(a) || t.on_crease(b);
  }
  EXPECT_GT(beside, 0);
}

TEST(EdgeChanges, AFreeBoundaryStaysWhereItIs) {
  test::WorkingScene s(test::grid(cells, test::flat), test::plane());
  for (Freedom& freedom : s.constraints.freedom) freedom = Freedom::surface;
  int collapses = 0;
  for (const EdgeChange& change : changes_about(s.mesh, face_at(3, 0), {})) {
    if (change.kind != ChangeKind::collapse) continue;
    EdgePatch patch = cut(s, change);
    const Mat3X before = patch.vertices.positions.points;
    change_patch(patch, change, test::plane(), {});
    for (size_t i = 0; i < patch.vertex_ids.size(); ++i) {
      if (!s.halfedges.on_boundary(patch.vertex_ids[i])) continue;
      collapses += static_cast<int>(i) == change.stays;
      EXPECT_EQ(patch.vertices.positions.points.col(static_cast<Eigen::Index>(i)),
                before.col(static_cast<Eigen::Index>(i)));
    }
  }
  EXPECT_GT(collapses, 0);
}

TEST(EdgeChanges, MissTheTargetValenceOfACornerByOneAtMost) {
  constexpr int present = 4;  // edges at the tip of the fan
  for (const int target : {3, 4, 5}) {
    test::WorkingScene s(test::fan(90, present), test::plane());
    s.vertices.corner_valences[0] = target;
    int fewest = present, most = present;
    for (const EdgeChange& change : changes_about(s.mesh, 0, {})) {
      EdgePatch patch = cut(s, change);
      const std::vector<Triangle> faces = change_patch(patch, change, test::plane(), {});
      const auto tip = std::ranges::find(patch.vertex_ids, 0);
      if (tip == patch.vertex_ids.end()) continue;
      const auto id = static_cast<int>(tip - patch.vertex_ids.begin());
      const auto faces_at_tip =
          std::ranges::count_if(faces, [&](const Triangle& t) { return std::ranges::count(t, id) > 0; });
      fewest = std::min(fewest, static_cast<int>(faces_at_tip) + 1);
      most = std::max(most, static_cast<int>(faces_at_tip) + 1);
    }
    EXPECT_EQ(fewest, target == 5 ? present : present - 1) << target;
    EXPECT_EQ(most, target == 3 ? present : present + 1) << target;
  }
}

TEST(EdgeChanges, GiveNoVertexTooManyEdges) {
  const test::WorkingScene s(test::grid(cells, test::flat), test::plane());
  EXPECT_TRUE(changes_about(s.mesh, face_at(4, 4), {.valence = 6, .collapses = false}).empty());
}

TEST(EdgeChanges, APatchCutAfterASplitOfACreasedMeshKnowsItsVertices) {
  std::vector<Edge> creases;
  for (int i = 0; i < cells; ++i) creases.push_back({4 * across + i, 4 * across + i + 1});
  test::WorkingScene s(test::grid(cells, test::flat), test::plane(), creases);
  const EdgeChange split{test::half_edge(s.halfedges, 2 * across + 3, 2 * across + 4), ChangeKind::split};
  EdgePatch patch = cut(s, split);
  change_patch(patch, split, test::plane(), {});
  change_mesh(s.mesh, split, patch);
  const int beyond = test::half_edge(s.halfedges, 5 * across + 3, 5 * across + 4);
  const EdgePatch other = *cut_patch(s.mesh, beyond, 2, 200);
  for (size_t i = 0; i < other.vertex_ids.size(); ++i) {
    EXPECT_GE(s.halfedges.valence(other.vertex_ids[i]), 0);  // no extra wedge
    EXPECT_EQ(other.vertices.positions.points.col(static_cast<Eigen::Index>(i)),
              s.positions.points.col(other.vertex_ids[i]));
  }
}

}  // namespace hooke::edge_trial_test
