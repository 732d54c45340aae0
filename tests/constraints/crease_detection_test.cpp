#include "hooke/constraints/crease_detection.h"

#include <gtest/gtest.h>

#include <chrono>

#include "support/crease_solids.h"
#include "support/masks.h"
#include "support/solids.h"

#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/normals.h"

namespace hooke::crease_detection_test {

std::vector<Edge> features_of(const test::Triangles& t, const CreaseOptions& options = {},
                              const std::vector<Edge>& hard_edges = {}) {
  const Adjacency c = test::connect(t);
  const std::vector<double> length(c.vertex_count, 1);
  std::vector<Edge> edges;
  for (int e : detect_creases(t.points, c, length, options, hard_edges)) edges.push_back(c.edges[e]);
  return edges;
}

/// A sheet n x n, bent along x = n / 2 by `degrees(y)`, in cells of 1.
test::Triangles bent_sheet(int n, const std::function<double(double)>& degrees) {
  test::Triangles t = test::grid(n, test::flat);
  t.points *= n;
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    t.points(2, v) =
        -std::abs(t.points(0, v) - .5 * n) * std::tan(degrees(t.points(1, v)) * std::numbers::pi / 360);
  return t;
}

TEST(Features, ACubeHasItsTwelveEdges) {
  EXPECT_EQ(features_of(test::cube()).size(), 12u);
  EXPECT_EQ(features_of(test::irregular_cube(5)).size(), 60u);
  EXPECT_EQ(features_of(test::moved(test::irregular_cube(5), .25)).size(), 60u);
}

TEST(Features, AnOpenBoxHasTheEdgesBetweenItsSidesToo) {
  for (const int depth : {2, 5, 20}) {
    test::Triangles box = test::cells(10, 10, depth, [](int, int, int) { return true; });
    std::erase_if(box.faces, [&](const Triangle& f) {
      return std::ranges::all_of(f, [&](int v) { return box.points(2, v) == depth; });
    });
    EXPECT_EQ(features_of(box).size(), 4 * 10 + 4 * depth);
  }
}

TEST(Features, HardEdgesAreNoNoiseWhereTheyBend) {
  const test::Triangles round = test::sphere(1);  // its edges bend by 20 degrees and more, all alike
  const Adjacency c = test::connect(round);
  const std::vector<Edge> hard = {c.edges[0], c.edges[7]};
  EXPECT_TRUE(features_of(round, {.angle = 30}).empty());
  EXPECT_EQ(features_of(round, {.angle = 30}, hard), hard);
  EXPECT_TRUE(features_of(round, {.angle = 60}, hard).empty()) << "they bend less than continues a crease";
  EXPECT_TRUE(features_of(round, {.angle = 180}, hard).empty());
}

TEST(Features, OffMeansNone) {
  EXPECT_TRUE(features_of(test::cube(), {.angle = 180}).empty());
}

TEST(Features, BetweenFlatRegionsSmallAnglesCountToo) {
  const auto bent = [](double degrees) {
    return features_of(bent_sheet(20, [degrees](double) { return degrees; })).size();
  };
  EXPECT_EQ(bent(.15), 0u);
  EXPECT_EQ(bent(.25), 20u);
  EXPECT_EQ(bent(41), 20u);
}

/// Bent by so many degrees at y = 0, by less and less along y, down to 15.
test::Triangles fading_sheet(double degrees = 60, double fall = 22) {
  return bent_sheet(60, [=](double y) { return 15 + (degrees - 15) * std::exp(-y / fall); });
}

TEST(Features, AWeakerEdgeGoesOnFromASharpOne) {
  const auto edges = [](const CreaseOptions& options) {
    return static_cast<double>(features_of(fading_sheet(), options).size());
  };
  EXPECT_NEAR(edges({}), 35, 1);             // to 24 degrees
  EXPECT_NEAR(edges({.angle = 36}), 42, 1);  // to 21.6
}

TEST(Features, AChainWithALooseEndIsLongAndSharp) {
  EXPECT_FALSE(features_of(fading_sheet()).empty());
  EXPECT_TRUE(features_of(test::moved(fading_sheet(60, 5), 1.3)).empty()) << "8 edges, 10 target lengths";
  EXPECT_FALSE(features_of(test::moved(fading_sheet(), .2)).empty()) << "short edges, but 35 of them";
  EXPECT_TRUE(features_of(fading_sheet(43)).empty()) << "3 of 25 edges are sharp";
}

/// A sheet 40 x 40, curved with about this radius, with a crease of 60 degrees along x = 20 that fades at
/// both ends.
test::Triangles creased_sheet(double radius) {
  test::Triangles t =
      bent_sheet(40, [](double y) { return std::max(0., 60 - 4 * std::max(0., std::abs(y - 20) - 10)); });
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) {
    const double x = t.points(0, v) - 20, y = t.points(1, v) - 20;
    t.points(2, v) -= (x * x + x * y + y * y) / (2 * radius);
  }
  return t;
}

/// `wide` x `n` cells, bent by 90 degrees half way along.
test::Triangles bent_strip(int wide, int n) {
  test::Triangles t = bent_sheet(n, [](double) { return 90; });
  std::erase_if(t.faces, [&](const Triangle& f) {
    return std::ranges::any_of(f, [&](int v) { return t.points(1, v) > wide; });
  });
  return t;
}

TEST(Features, AShortFoldFromBoundaryToBoundaryIsOneBetweenFlatSides) {
  for (const int wide : {2, 3, 8}) EXPECT_EQ(features_of(bent_strip(wide, 12)).size(), wide);
  // Ears that are folded up by chance, of a piece that is rough elsewhere too, are none.
  for (unsigned seed = 1; seed <= 30; ++seed) {
    test::Triangles t = test::grid(12, test::paraboloid, .4, seed);
    const Adjacency c = test::connect(t);
    for (int v = 0; v < c.vertex_count;
         ++v)  // corners of faces that have two boundary edges, and their neighbours
      if (c.vertex_faces[v].size() <= 2) t.points(2, v) += .3;
    EXPECT_TRUE(features_of(t).empty()) << seed;
  }
}

TEST(Features, AChainInTheMidstOfTheSurfaceLiesBetweenFlatFaces) {
  EXPECT_GE(features_of(creased_sheet(1000)).size(), 20u);
  EXPECT_TRUE(features_of(creased_sheet(15)).empty());
}

/// Two barrel vaults of the same radius: where they meet the surface bends by 90 degrees at the corners and
/// not at all in the middle.
TEST(Features, WhereRoundBodiesCrossAChainMayFade) {
  test::Triangles vaults = test::grid(24, [](double x, double y) {
    const double u = 1.96 * x - .98, v = 1.96 * y - .98;
    return std::sqrt(1 - std::min(u * u, v * v)) / 1.96;
  });
  const Adjacency c = test::connect(vaults);
  for (const double scale : {6., 24.}) {  // of the mean edge or less
    const std::vector<Edge> creases = features_of(test::moved(vaults, scale));
    const auto is_on_groin = [&](int v) {
      return std::abs(vaults.points(0, v) - vaults.points(1, v)) < 1e-9;
    };
    for (int e : sharp_edges(vaults.points, c, 40)) {
      const auto& [a, b] = c.edges[e];
      if (!is_on_groin(a) || !is_on_groin(b)) continue;
      EXPECT_TRUE(std::ranges::find(creases, Edge{a, b}) != creases.end()) << scale << " " << a;
    }
    EXPECT_GE(creases.size(), 16u);
  }
}

TEST(Features, NoiseAndCoarseRoundBodiesMakeNone) {
  EXPECT_TRUE(features_of(test::sphere(0)).empty());  // normals of neighbours differ by 42 degrees
  for (unsigned seed = 1; seed <= 5; ++seed) {
    EXPECT_TRUE(features_of(test::sphere(2, .45, seed)).empty());
    EXPECT_TRUE(features_of(test::shaken(test::sphere(2, 0, seed), .04, seed)).empty());
    EXPECT_TRUE(features_of(test::shaken(test::grid(15, test::flat), .02, seed)).empty());
  }
}

struct Blade {
  int facets = 8;                   // of each side of a section
  double width = 1.1, height = .2;  // of a facet; of a section at its middle, over its length
  double span = 8.6;                // between sections
  int sections = 3;
};

/// Of lens-shaped sections and twisted: facets much longer than the target and about as wide, sharp at two
/// long edges only.
test::Triangles blade(const Blade& o) {
  const int around = 2 * o.facets;
  const double chord = o.facets * o.width;
  test::Triangles t{Mat3X(3, o.sections * around), {}};
  for (int s = 0; s < o.sections; ++s)
    for (int k = 0; k < around; ++k) {
      const double u = std::abs(k - o.facets) * 2. / o.facets - 1;  // from edge to edge, above and back below
      const double x = .5 * chord * u, z = (k < o.facets ? -.5 : .5) * o.height * chord * (1 - u * u);
      const double twist = .25 * s * o.span / 8.6;
      t.points.col(s * around + k) << std::cos(twist) * x - std::sin(twist) * z, o.span * s,
          std::sin(twist) * x + std::cos(twist) * z;
    }
  for (int s = 0; s + 1 < o.sections; ++s)
    for (int k = 0; k < around; ++k) {
      const int p = s * around + k, q = s * around + (k + 1) % around;
      t.faces.push_back({p, q, q + around});
      t.faces.push_back({p, q + around, p + around});
    }
  return t;
}

TEST(Features, TheLongEdgesOfABladeAreCreases) {
  const test::Triangles wing = blade({});
  EXPECT_EQ(features_of(wing).size(), 4u);
  // Beside it noise that is most of what is sharp.
  test::Triangles noise = test::shaken(test::sphere(2), .12);
  noise.points.row(0).array() += 100;
  EXPECT_TRUE(features_of(noise).empty());
  EXPECT_EQ(features_of(test::both(wing, noise)).size(), 4u);
}

TEST(Features, EdgesThatNoiseCouldMakeAreNotThoseOfABlade) {
  EXPECT_EQ(features_of(blade({.span = 3.1, .sections = 4})).size(), 6u);
  EXPECT_TRUE(features_of(blade({.span = 2.9, .sections = 4})).empty()) << "hardly longer than the target";
  EXPECT_EQ(features_of(blade({.span = 4.1})).size(), 4u);
  EXPECT_TRUE(features_of(blade({.span = 3.9})).empty()) << "short in all";
  EXPECT_TRUE(features_of(blade({.height = .5})).empty()) << "not turning back";
  EXPECT_TRUE(features_of(blade({.width = .3, .span = 4.1, .sections = 5})).empty())
      << "between narrow faces";
}

TEST(Features, NoiseOnStretchedFacesMakesNone) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    test::Triangles lines = test::shaken(test::grid(40, test::flat), .006, seed);
    lines.points.array().colwise() *= Eigen::Array3d(160, 40, 50);  // cells of 4 x 1
    EXPECT_GT(sharp_edges(lines.points, test::connect(lines), 40).size(), 10u);
    EXPECT_TRUE(features_of(lines).empty()) << seed;
    test::Triangles cigar = test::sphere(4, .2, seed);
    cigar.points.array().colwise() *= Eigen::Array3d(60, 8, 8);
    EXPECT_TRUE(features_of(test::shaken(cigar, .1, seed)).empty()) << seed;
  }
}

TEST(Features, FacesFoldedOverByNoiseMakeNone) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    test::Triangles t = test::sphere(4, .8, seed);
    t.points *= std::sqrt(2560 / (4 * std::numbers::pi));  // edges of about 1
    EXPECT_GT(sharp_edges(t.points, test::connect(t), 90).size(), 100u);
    EXPECT_TRUE(features_of(t).empty()) << seed;
  }
}

/// Their faces lie in planes two by two, and the angles between these vary from place to place.
TEST(Features, QuadrilateralsOfASmoothSurfaceMakeNone) {
  test::Triangles saddle =
      test::grid(24, [](double x, double y) { return 4 * x * (1 - x) - 2 * y * (1 - y); });
  saddle.points *= 24;
  EXPECT_TRUE(features_of(saddle).empty());
  for (const auto& [meridians, bands] : {std::pair(24, 12), {20, 20}, {12, 24}, {64, 16}, {64, 8}}) {
    test::Triangles globe = test::globe(meridians, bands);
    globe.points *= std::sqrt(.5 * meridians * bands / std::numbers::pi);
    EXPECT_TRUE(features_of(globe).empty()) << meridians << " " << bands;
  }
}

/// As marching cubes make them of images of whole numbers: every vertex has another one in its place.
TEST(Features, FacesWithoutAreaMakeNoFlatRegions) {
  test::Triangles ball = test::sphere(3, .2);
  const Adjacency c = test::connect(ball);
  std::vector<char> paired(c.vertex_count, 0);
  for (const auto& [v, w] : c.edges) {
    if (paired[v] || paired[w]) continue;
    paired[v] = paired[w] = 1;
    ball.points.col(w) = ball.points.col(v);
  }
  ball.points *= 10;
  EXPECT_TRUE(features_of(ball).empty());
}

TEST(Features, FoldsOfASheetThatTurnToAndFroAreKept) {
  test::Triangles sheet = test::grid(20, test::flat);
  sheet.points *= 20;
  for (Eigen::Index v = 0; v < sheet.points.cols(); ++v)
    sheet.points(2, v) = .25 * (std::lround(sheet.points(0, v)) % 2);
  EXPECT_EQ(features_of(sheet).size(), 19u * 20);
}

/// Strips of these widths and 20 long, each of two triangles; `degrees` is the angle between every two.
test::Triangles folded_strips(const std::vector<double>& widths, double degrees) {
  std::vector<Vec3> p = {{0, 0, 0}, {0, 20, 0}};
  test::Triangles t;
  double slope = 0;
  for (const double width : widths) {
    const int n = static_cast<int>(p.size());
    const Vec3 step = width * Vec3(std::cos(slope), 0, -std::sin(slope));
    p.push_back(p[n - 2] + step);
    p.push_back(p[n - 1] + step);
    t.faces.push_back({n - 2, n, n + 1});
    t.faces.push_back({n - 2, n + 1, n - 1});
    slope += degrees * std::numbers::pi / 180;
  }
  t.points.resize(3, std::ssize(p));
  for (size_t v = 0; v < p.size(); ++v) t.points.col(static_cast<Eigen::Index>(v)) = p[v];
  return t;
}

TEST(Features, ARoundBendsThriceABevelTwice) {
  for (const double width : {1., 1.8}) {
    EXPECT_EQ(features_of(folded_strips({20, width, 20}, 20)).size(), 2u) << width;
    EXPECT_TRUE(features_of(folded_strips({20, width, width, 20}, 20)).empty()) << width;
    EXPECT_TRUE(features_of(folded_strips({20, width, width, width, 20}, 20)).empty()) << width;
  }
  EXPECT_EQ(features_of(folded_strips({20, 5, 5, 20}, 20)).size(), 3u) << "facets that the length resolves";
  EXPECT_EQ(features_of(folded_strips({20, 1, 1, 20}, 35)).size(), 3u)
      << "more than programs leave to a facet";
}

/// A plate with bevels along its long sides, in cells of one length: what is asked of each edge of a border
/// must not be asked of all others each time.
TEST(Features, LongBordersTakeNoLongTime) {
  const int rows = 200;
  std::vector<double> x(16), z(16, 0);
  for (int i = 0; i < 16; ++i) {
    const double out = std::max(0., std::abs(i - 7.5) - 2.5);
    x[i] = (i < 8 ? -1 : 1) * (std::min(std::abs(i - 7.5), 2.5) + out * std::cos(std::numbers::pi / 9));
    z[i] = -out * std::sin(std::numbers::pi / 9);
  }
  test::Triangles t{Mat3X(3, 16 * (rows + 1)), {}};
  for (int r = 0; r <= rows; ++r)
    for (int i = 0; i < 16; ++i) t.points.col(16 * r + i) = Vec3(x[i], r, z[i]);
  for (int r = 0; r < rows; ++r)
    for (int i = 0; i < 15; ++i) {
      const int v = 16 * r + i;
      t.faces.push_back({v, v + 1, v + 17});
      t.faces.push_back({v, v + 17, v + 16});
    }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(features_of(t).size(), 2u * rows);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

/// A hull of few triangles, seen from lengths much smaller than its edges: each triangle is a facet, also
/// where two meet at a small angle; not so where lengths are of the order of the edges.
TEST(Features, TrianglesBetweenSharpEdgesAreFacets) {
  test::Triangles wedge = test::triangles({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 2}, {4, 4, 1.7}},
                                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 4, 3}, {2, 3, 4}, {1, 2, 4}});
  const auto bent = sharp_edges(wedge.points, test::connect(wedge), 1);
  EXPECT_LT(sharp_edges(wedge.points, test::connect(wedge), 40).size(), bent.size());
  EXPECT_EQ(features_of(wedge).size(), bent.size());
  wedge.points *= .1;
  EXPECT_LT(features_of(wedge).size(), bent.size());
}

TEST(Features, AFanOfNarrowFacetsIsACone) {
  EXPECT_EQ(features_of(test::pyramid(48, 20, 40)).size(), 48u);  // the rim only
  EXPECT_EQ(features_of(test::pyramid(48, 200, 400)).size(), 48u);
  EXPECT_EQ(features_of(test::pyramid(4, 20, 40)).size(), 8u);
}

TEST(Features, CoarseFacetsOfRoundBodiesAreNone) {
  const auto on_cone = [](double turn, double height) {
    return Vec3((15 - .3 * height) * std::cos(turn), (15 - .3 * height) * std::sin(turn), height);
  };
  const auto oblique = [](double turn, double height) {
    return Vec3(7 * std::cos(turn), 7 * std::sin(turn), height * (1 + .1 * std::sin(turn)));
  };
  for (const double scale : {.5, 1., 2., 20.}) {
    const auto creases = [&](const test::Triangles& t) { return features_of(test::moved(t, scale)).size(); };
    EXPECT_EQ(creases(test::rows_of_facets(20, {0, 4, 26, 30}, on_cone)), 40u) << scale;
    EXPECT_EQ(creases(test::rows_of_facets(29, {0, 30}, oblique)), 58u) << scale;
  }
}

/// A sheet folded to and fro both ways into flat squares: its vertices turn but little, yet it is not round.
TEST(Features, FoldsThatAlternateAreNoRound) {
  const int n = 6;
  for (const double degrees : {10., 20.}) {
    test::Triangles sheet = test::grid(n, test::flat);
    for (Eigen::Index v = 0; v < sheet.points.cols(); ++v) {
      const long x = std::lround(n * sheet.points(0, v)), y = std::lround(n * sheet.points(1, v));
      const double rise = std::tan(degrees * std::numbers::pi / 360);
      sheet.points.col(v) =
          2 * Vec3(static_cast<double>(x), static_cast<double>(y), rise * static_cast<double>(x % 2 + y % 2));
    }
    EXPECT_EQ(features_of(sheet).size(), 2u * n * (n - 1)) << degrees;
  }
}

/// A square bar of 40 slices, each turned by 3 degrees: the sides are washboards of edges of 38 degrees.
TEST(Features, EdgesFarSharperThanAllOthersAreCreases) {
  test::Triangles bar{Mat3X(3, 4 * 41 + 2), {}};
  const auto id = [](int slice, int corner) { return 4 * slice + corner % 4; };
  for (int s = 0; s <= 40; ++s)
    for (int k = 0; k < 4; ++k) {
      const double turn = std::numbers::pi * (.5 * k + s / 60.);
      bar.points.col(id(s, k)) =
          Vec3(std::sqrt(50) * std::cos(turn), std::sqrt(50) * std::sin(turn), .75 * s);
    }
  const int bottom = static_cast<int>(bar.points.cols()) - 2, top = bottom + 1;
  bar.points.col(bottom) = Vec3::Zero();
  bar.points.col(top) = Vec3(0, 0, 30);
  for (int k = 0; k < 4; ++k) {
    bar.faces.push_back({bottom, id(0, k + 1), id(0, k)});
    bar.faces.push_back({top, id(40, k), id(40, k + 1)});
    for (int s = 0; s < 40; ++s) {
      bar.faces.push_back({id(s, k), id(s, k + 1), id(s + 1, k + 1)});
      bar.faces.push_back({id(s, k), id(s + 1, k + 1), id(s + 1, k)});
    }
  }
  for (const double scale : {.3, 1.})
    EXPECT_EQ(features_of(test::moved(bar, scale)).size(), 4u * 40 + 8) << scale;
}

std::vector<int> tips_of(const test::Triangles& t, double length) {
  const Adjacency c = test::connect(t);
  return detect_tips(t.points, c, std::vector<double>(c.vertex_count, length), {});
}

TEST(Features, TheTipOfAConeIsHeldWhereLengthsResolveIt) {
  const test::Triangles steep = test::pyramid(48, 20, 40);
  EXPECT_EQ(tips_of(steep, 1), std::vector{48});
  EXPECT_TRUE(tips_of(steep, 40).empty());
  EXPECT_TRUE(tips_of(test::pyramid(48, 20, 10), 1).empty());  // nearly flat
  EXPECT_TRUE(tips_of(test::sphere(2), .01).empty());
}

/// The number of creases at this target length.
std::size_t creases_at(double length, const test::Triangles& t, const CreaseOptions& options = {}) {
  const Adjacency c = test::connect(t);
  return detect_creases(t.points, c, std::vector<double>(c.vertex_count, length), options).size();
}

/// The outside of a box with sides at a share of a cell beyond planes of the grid.
test::Triangles marched_box(double share) {
  return test::marched_cubes(
      8, [&](const Vec3& x) { return (x.cwiseAbs() - Vec3(6, 5, 4)).maxCoeff() - share; });
}

TEST(GridBevels, OfSliversAreNoEdgesUnlessAskedForOrNarrowerThanTheLength) {
  const test::Triangles box = marched_box(.25);
  EXPECT_EQ(creases_at(1, box), 0u);
  EXPECT_EQ(creases_at(.3, box), 0u);
  EXPECT_EQ(creases_at(1, box, {.angle = 20}), 0u);
  EXPECT_GT(creases_at(1, box, {.drops_noise = false}), 200u);
  EXPECT_GT(creases_at(3, box), 100u);
}

/// A sheet with n x n low pyramids.
test::Triangles studded_sheet(int n) {
  test::Triangles t = test::grid(4 * n, test::flat);
  const auto side = 4 * n + 1;
  for (int v = 0; v < side * side; ++v)
    if (v % side % 4 == 2 && v / side % 4 == 2) t.points(2, v) = .1 / n;
  t.points *= 4 * n;
  return t;
}

TEST(Features, OfManyStudsOnOneSheetTakeTimeInProportion) {
  constexpr int n = 60;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_GT(features_of(studded_sheet(n)).size(), n * n * 8u);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(GridBevels, ThatAreWideMayBeOfTheBody) {
  EXPECT_GT(creases_at(1, marched_box(.45)), 200u);
}

TEST(GridBevels, LeaveOtherCreasesAndSharpOnes) {
  // The rim of a cap in a plane of the grid has no bevel.
  const test::Triangles cap = test::marched_cubes(
      8, [](const Vec3& x) { return std::max(x.norm() - 6.4, x[2] < -3.5 ? 1e3 : -1e3); });
  const std::size_t rim = creases_at(1, cap);
  EXPECT_GT(rim, 2 * 5 * std::numbers::pi);
  test::Triangles box = marched_box(.25);
  box.points.colwise() += Vec3(20, 0, 0);
  EXPECT_GE(creases_at(1, test::both(cap, box)), rim);
  EXPECT_LT(creases_at(1, test::both(cap, box)), rim + .05 * creases_at(3, box));
  const test::Triangles wedge = test::marched_cubes(8, [](const Vec3& x) {
    return std::max({std::abs(x[2]) - 6.25, .4 * x[0] - x[1], .4 * x[0] + x[1], -6.2 - x[0]});
  });
  EXPECT_GE(creases_at(1, wedge), 12u) << "its knife edge";
}

}  // namespace hooke::crease_detection_test
