#include "hooke/mesh/validation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "support/errors.h"
#include "support/meshes.h"

namespace hooke::validation_test {

using test::has;

const Problem* find(const std::vector<Problem>& problems, ProblemKind kind) {
  for (const Problem& problem : problems)
    if (problem.kind == kind) return &problem;
  return nullptr;
}

// The mesh has exactly this one problem; it is returned.
Problem only_problem(const test::Triangles& t, ProblemKind kind) {
  const std::vector<Problem> problems = find_problems(t.points, t.faces);
  EXPECT_EQ(problems.size(), 1u);
  const Problem* problem = find(problems, kind);
  EXPECT_NE(problem, nullptr) << name_of(kind);
  return problem ? *problem : Problem{kind, 0, {}, {}};
}

// Two unit squares' worth of corners; enough for small meshes.
test::Triangles with_faces(const std::vector<Triangle>& faces) {
  test::Triangles t{Mat3X(3, 6), faces};
  t.points << 0, 1, 0, 0, 1, 2, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 1, 2;
  return t;
}

TEST(Validation, GoodMeshesHaveNoProblem) {
  for (const auto& t : {test::sphere(2), test::grid(5, test::paraboloid, .3), test::grid(1, test::flat)})
    EXPECT_TRUE(find_problems(t.points, t.faces).empty());
}

TEST(Validation, GoodMeshesAreGoodAtAnyPlaceAndScale) {
  for (const double scale : {1e-300, 1e-160, 1e-6, 1e6, 1e160, 1e300}) {
    test::Triangles t = test::sphere(2);
    t.points *= scale;
    EXPECT_TRUE(find_problems(t.points, t.faces).empty()) << scale;
  }
  test::Triangles far = test::sphere(2);
  far.points.array() += 1e7;
  EXPECT_TRUE(find_problems(far.points, far.faces).empty());
}

TEST(Validation, CornersMustBeThreeVertices) {
  EXPECT_EQ(only_problem(with_faces({{0, 1, 6}}), ProblemKind::index_out_of_range).vertices,
            (std::vector{6}));
  EXPECT_EQ(only_problem(with_faces({{0, 1, 2}, {0, 1, -1}}), ProblemKind::index_out_of_range).faces,
            (std::vector{1}));
  for (const Triangle& face : {Triangle{0, 1, 1}, {1, 0, 1}, {1, 1, 0}})
    EXPECT_EQ(only_problem(with_faces({face}), ProblemKind::repeated_index).vertices, (std::vector{1}));
  only_problem(with_faces({}), ProblemKind::no_faces);
  test::Triangles t = test::sphere(1);
  t.points(1, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(only_problem(t, ProblemKind::not_finite).vertices, (std::vector{7}));
}

TEST(Validation, DuplicatesAreFoundInAnyOrderOfCorners) {
  for (const int turn : {0, 1, 2})
    for (const bool flipped : {false, true}) {
      test::Triangles t = test::sphere(1);
      Triangle copy = t.faces[5];
      std::rotate(copy.begin(), copy.begin() + turn, copy.end());
      if (flipped) std::swap(copy[0], copy[1]);
      t.faces.push_back(copy);
      const Problem problem = only_problem(t, ProblemKind::duplicate_face);
      EXPECT_EQ(problem.count, 1u);
      EXPECT_EQ(problem.faces, (std::vector{5, 80}));
    }
}

TEST(Validation, ThreeFacesOnAnEdge) {
  const auto problems =
      find_problems(with_faces({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}).points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const Problem* problem = find(problems, ProblemKind::non_manifold_edge);
  ASSERT_NE(problem, nullptr);
  EXPECT_EQ(problem->count, 1u);
  EXPECT_EQ(problem->vertices, (std::vector{0, 1}));
  EXPECT_EQ(problem->faces.size(), 3u);
}

TEST(Validation, OneFlippedFaceDisagreesWithItsThreeNeighbours) {
  test::Triangles t = test::sphere(2);
  std::swap(t.faces[9][0], t.faces[9][1]);
  EXPECT_EQ(only_problem(t, ProblemKind::inconsistent_orientation).count, 3u);
}

TEST(Validation, PartsThatTouchInAVertex) {
  const auto problems = find_problems(with_faces({}).points, {{0, 1, 2}, {0, 3, 4}});
  const Problem* problem = find(problems, ProblemKind::non_manifold_vertex);
  ASSERT_NE(problem, nullptr);
  EXPECT_EQ(problem->vertices, (std::vector{0}));
}

TEST(Validation, NoAreaAnywhereIsRefusedSomewhereIsSaid) {
  test::Triangles line = test::grid(3, test::flat);
  const Mat3X before = line.points;
  line.points.row(1) = .3 * before.row(0);
  line.points.row(2) = -.7 * before.row(0);
  only_problem(line, ProblemKind::no_area);
  line.points.setConstant(1);
  only_problem(line, ProblemKind::no_area);
  line.points.setZero();
  only_problem(line, ProblemKind::no_area);
  test::Triangles partly = test::sphere(1);
  partly.points.col(partly.faces[4][0]) = partly.points.col(partly.faces[4][1]);
  EXPECT_EQ(only_problem(partly, ProblemKind::zero_area_faces).count, 2u);
  EXPECT_TRUE(is_acceptable(ProblemKind::zero_area_faces));
}

TEST(Validation, IsolatedVerticesAndUnconnectedTrianglesAreWarnings) {
  const auto t = with_faces({{0, 1, 2}, {3, 4, 5}});
  EXPECT_TRUE(is_acceptable(only_problem(t, ProblemKind::unconnected_triangles).kind));
  EXPECT_EQ(only_problem(with_faces({{0, 1, 2}, {1, 0, 3}}), ProblemKind::isolated_vertices).vertices,
            (std::vector{4, 5}));
  const Warnings warnings = require_valid(t.points, t.faces, {"m.obj", {}, {}});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, "unconnected_triangles");
}

TEST(Validation, TheMessageNamesFileFacesAndLines) {
  const auto t = with_faces({{0, 1, 2}, {0, 1, 3}});
  const auto message = [&](const MeshSource& source) {
    return test::message_of<MeshError>([&] { require_valid(t.points, t.faces, source); });
  };
  EXPECT_TRUE(
      has(message({"m.obj", {}, {}}),
          "m.obj: edges whose two faces are oriented against each other (1): edges 0-1, faces 0, 1;"));
  EXPECT_TRUE(has(message({"m.obj", {5, 7}, {1, 2, 3, 4, 5, 60, 7, 80}}), "faces 5 (line 60), 7 (line 80);"));
}

TEST(Validation, MessagesNameTheRepairWhereItHelpsAndWasNotTried) {
  const auto message = [](const test::Triangles& t, bool repaired) {
    return test::message_of<MeshError>([&] { require_valid(t.points, t.faces, {"m", {}, {}, repaired}); });
  };
  const auto mixed = with_faces({{0, 1, 2}, {0, 1, 3}});
  EXPECT_TRUE(has(message(mixed, false), "orient the faces alike, or use --repair"));
  EXPECT_FALSE(has(message(mixed, true), "--repair"));
  EXPECT_FALSE(has(message(with_faces({}), false), "--repair")) << "no faces";
  const auto apart = with_faces({{0, 1, 2}, {3, 4, 5}});
  for (const bool repaired : {false, true})
    EXPECT_EQ(has(require_valid(apart.points, apart.faces, {"m", {}, {}, repaired})[0].message, "--repair"),
              !repaired);
}

TEST(Validation, ManyPlacesMakeAShortMessageAndThreadsChangeNothing) {
  test::Triangles t = test::sphere(4);
  for (size_t f = 0; f < t.faces.size(); f += 2) std::swap(t.faces[f][0], t.faces[f][1]);
  const auto message = [&] {
    return test::message_of<MeshError>([&] { require_valid(t.points, t.faces, {"m", {}, {}}); });
  };
  const std::string all = message();
  EXPECT_LT(all.size(), 1000u);
  const ThreadLimit one(1);
  EXPECT_EQ(message(), all);
}

TEST(Validation, SizesBeyondTheRangeOfTheirSquaresAreRefused) {
  const test::Triangles t = test::sphere(0);
  for (double scale : {1e-49, 1., 1e49}) require_workable_size(scale * t.points, "m");
  for (double scale : {0., 1e-51, 1e51, 1e308})
    EXPECT_ERROR(MeshError, "m: the diagonal of its box is ", require_workable_size(scale * t.points, "m"));
}

}  // namespace hooke::validation_test
