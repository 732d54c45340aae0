#include "hooke/integrator/angle_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "hooke/core/parallel.h"
#include "hooke/geometry/triangle.h"
#include "hooke/integrator/angle_springs.h"
#include "hooke/integrator/lbfgs.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/remesh/options.h"
#include "support/remeshed.h"
#include "support/scene.h"

namespace hooke::angle_search_test {

/// Irregular connectivity, whose springs are at rest.
test::Triangles irregular(unsigned seed) {
  test::Triangles t = test::grid(8, test::flat, .3, seed);
  test::split_at_centres(t, 5, 9);
  return t;
}

/// The smallest angle of each face, degrees.
std::vector<double> face_angles(const Mat3X& points, const std::vector<Triangle>& faces) {
  std::vector<double> angles;
  for (const Triangle& f : faces) angles.push_back(min_angle(points, {f}));
  return angles;
}

struct Outcome {
  double angle_before = 0, angle_after = 0, error_before = 0, error_after = 0;
  int upside_down = 0;
  AngleSearchResult result = {};
  Mat3X points = {}, points_before = {};
};

Outcome search(const test::Triangles& t, const AngleSearchOptions& options = {}) {
  test::Scene s(t, test::to_ground);
  Relaxation r = s.relaxation();
  relax_lbfgs(r, {}, {}, nullptr);
  const auto angle = [&] { return min_angle(s.positions.points, t.faces); };
  const auto error = [&] {
    return relative_edge_deviation(s.positions.points, s.adjacency.edges, s.targets);
  };
  Outcome o;
  o.angle_before = angle();
  o.error_before = error();
  o.points_before = s.positions.points;
  o.result = search_angles(r, options);
  o.angle_after = angle();
  o.error_after = error();
  for (const Triangle& f : t.faces) o.upside_down += test::area_vector(s.positions.points, f)[2] <= 0;
  o.points = s.positions.points;
  return o;
}

TEST(AngleSearch, EndsWhereAFaceHasNoArea) {
  test::Triangles t = test::grid(6, test::flat);
  const int on_edge = static_cast<int>(t.points.cols());
  t.points.conservativeResize(3, on_edge + 1);
  t.points.col(on_edge) = .5 * (t.points.col(2) + t.points.col(3));
  t.faces.push_back({3, 2, on_edge});
  const test::Outcome o = test::remeshed(t, RemeshOptions{});
  EXPECT_TRUE(o.points.allFinite());
}

TEST(AngleSearch, RaisesTheLeastAngleForLittleOfTheEdges) {
  double risen = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    AngleSearchOptions options;
    options.edge_error_limit = 1.03;
    const Outcome o = search(irregular(seed), options);
    EXPECT_GE(o.angle_after, o.angle_before);
    EXPECT_LE(o.error_after, 1.03 * o.error_before);
    EXPECT_EQ(o.upside_down, 0);
    risen += o.angle_after - o.angle_before;
  }
  EXPECT_GT(risen / 6, .2);
}

TEST(AngleSearch, NamesTheVerticesThatMoved) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Outcome o = search(irregular(seed));
    const std::vector<int>& named = o.result.vertices;
    EXPECT_GT(o.result.moves, 0);
    EXPECT_TRUE(std::ranges::is_sorted(named));
    EXPECT_EQ(std::ranges::adjacent_find(named), named.end());
    for (Eigen::Index v = 0; v < o.points.cols(); ++v)
      EXPECT_TRUE(o.points.col(v) == o.points_before.col(v) ||
                  std::ranges::binary_search(named, static_cast<int>(v)))
          << v;
  }
}

TEST(AngleSearch, MayPayMoreWhereItIsAllowedTo) {
  double gained = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Outcome cheap = search(irregular(seed), {.edge_error_limit = 1});
    const Outcome better = search(irregular(seed), {.edge_error_limit = 1.2});
    EXPECT_LE(cheap.error_after, cheap.error_before);
    EXPECT_LE(better.error_after, 1.2 * better.error_before);
    gained += better.angle_after - cheap.angle_after;
  }
  EXPECT_GT(gained / 6, .3);
}

TEST(AngleSearch, SpringsAndPatternSearchTogetherReachMore) {
  double gained = 0, lost = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Outcome both = search(irregular(seed)), pattern = search(irregular(seed), {.spring_range = 0});
    EXPECT_LE(both.error_after, AngleSearchOptions{}.edge_error_limit * both.error_before);
    EXPECT_EQ(both.upside_down, 0);
    gained += both.angle_after - pattern.angle_after;
    lost = std::max(lost, pattern.angle_after - both.angle_after);
  }
  EXPECT_GT(gained / 6, .3);
  EXPECT_LT(lost, 1);
}

TEST(AngleSearch, PatternSearchGoesOnWhereSpringsMakeTheEdgesTooUnequal) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    AngleSearchOptions options{.edge_error_limit = 1.01, .sagitta = 0};
    options.spring_range = .9;
    const Outcome both = search(irregular(seed), options);
    options.spring_range = 0;
    const Outcome pattern = search(irregular(seed), options);
    EXPECT_GT(both.angle_after, pattern.angle_after + 1.1);
  }
}

TEST(AngleSearch, GoesOnWhereOneFaceCannotRise) {
  test::Triangles t = irregular(4);
  const Triangle flat = t.faces[70];  // its corners are held
  t.points.col(flat[0]) = .1 * t.points.col(flat[0]) + .45 * (t.points.col(flat[1]) + t.points.col(flat[2]));
  const auto angles = [&](int max_set_aside) {
    test::SceneOptions options;
    options.constraints.fixed_vertices.assign(flat.begin(), flat.end());
    test::Scene s(t, test::to_ground, options);
    Relaxation r = s.relaxation();
    relax_lbfgs(r, {}, {}, nullptr);
    search_angles(r, {.max_set_aside = max_set_aside});
    std::vector<double> sorted = face_angles(s.positions.points, t.faces);
    std::ranges::sort(sorted);
    return sorted;
  };
  const std::vector<double> stuck = angles(0), others = angles(3);
  EXPECT_EQ(others[0], stuck[0]);
  EXPECT_GT(others[1], stuck[1] + 1);
}

TEST(AngleSearch, FacesSetAsideLoseLittle) {
  const test::Triangles t = irregular(14);
  const auto angle = [&](int max_set_aside) {
    return search(t, {.edge_error_limit = 1.2, .max_set_aside = max_set_aside}).angle_after;
  };
  EXPECT_GT(angle(10), angle(0) - .05);
}

TEST(AngleSearch, FacesSetAsideAreTakenBackForLargerSagittas) {
  for (const unsigned seed : {7, 21}) {
    test::SceneOptions tight;
    tight.limits.sagitta = .02;
    test::Scene s(test::sphere(2, .3, seed), test::to_unit_sphere, tight);
    Relaxation r = s.relaxation();
    search_angles(r, {.spring_range = 0, .edge_error_limit = 1.1, .sagitta = .15});
    EXPECT_GT(min_angle(s.positions.points, s.adjacency.faces), 50);
  }
}

TEST(AngleSearch, SagittasMayGrowWhereThatIsWorthIt) {
  double risen = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const auto with = [&](double sagitta) {
      test::SceneOptions tight;
      tight.limits.sagitta = .05;
      test::Scene s(test::sphere(2, .4, seed), test::to_unit_sphere, tight);
      const auto max_sagitta = [&] {
        double greatest = 0;
        for (const Edge& e : s.adjacency.edges)
          greatest = std::max(greatest, edge_sagitta(s.positions.points, s.positions.normals, e) / s.L());
        return greatest;
      };
      const double before = max_sagitta();
      Relaxation r = s.relaxation();
      search_angles(r, {.spring_range = 0, .edge_error_limit = 1.1, .sagitta = sagitta});
      EXPECT_LE(max_sagitta(), std::max(sagitta, before) + 1e-6);
      return min_angle(s.positions.points, s.adjacency.faces);
    };
    const double within = with(0), beyond = with(.15);
    EXPECT_GE(beyond, within);
    risen += beyond - within;
  }
  EXPECT_GT(risen / 6, .2);
}

TEST(AngleSearch, LeavesAPerfectMeshAlone) {
  test::Triangles t = test::grid(6, test::flat);
  for (auto x : t.points.colwise()) x = Vec3(x[0] - .5 * x[1], std::sqrt(.75) * x[1], 0);
  EXPECT_EQ(search(t).result.moves, 0);
}

TEST(AngleSearch, OneThreadAndTwoGiveTheSameBits) {
  const Mat3X two = search(irregular(2)).points;
  const ThreadLimit one(1);
  EXPECT_EQ(search(irregular(2)).points, two);
}

}  // namespace hooke::angle_search_test
