#include "hooke/mesh/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/topology.h"
#include "support/crease_solids.h"
#include "support/errors.h"
#include "support/meshes.h"
#include "support/solids.h"

namespace hooke::repair_test {

using test::has;

constexpr RepairOptions all{.repair = true};

Repaired repaired(const test::Triangles& t, const RepairOptions& options = all) {
  return repair(t.points, t.faces, options, {"m", {}, {}});
}

std::vector<std::string> codes(const Repaired& r) {
  std::vector<std::string> found;
  for (const Note& note : r.changes) found.push_back(note.code);
  return found;
}
using Codes = std::vector<std::string>;

/// The faces, each beginning with its smallest corner.
std::multiset<Triangle> turned(std::vector<Triangle> faces) {
  for (Triangle& t : faces) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  return {faces.begin(), faces.end()};
}

/// Whether only acceptable problems are left.
bool is_valid(const Repaired& r) {
  return std::ranges::all_of(find_problems(r.points, r.triangles),
                             [](const Problem& p) { return is_acceptable(p.kind); });
}

Topology topology_of(const Repaired& r) {
  return measure_topology(make_adjacency(static_cast<int>(r.points.cols()), r.triangles));
}

double volume_of(const Repaired& r) {
  return *measure_extent(r.points, make_adjacency(static_cast<int>(r.points.cols()), r.triangles)).volume;
}

/// Every triangle with vertices of its own.
test::Triangles soup(const test::Triangles& t) {
  test::Triangles result{Mat3X(3, static_cast<Eigen::Index>(3 * t.faces.size())), {}};
  int v = 0;
  for (const Triangle& face : t.faces) {
    for (const int corner : face) result.points.col(v++) = t.points.col(corner);
    result.faces.push_back({v - 3, v - 2, v - 1});
  }
  return result;
}

void flip(Triangle& t) {
  std::swap(t[1], t[2]);
}

/// A strip of 2 n triangles whose ends are joined, turned half around for an odd number of half turns.
test::Triangles band(int n, int half_turns) {
  test::Triangles t{Mat3X(3, 2 * n), {}};
  for (int k = 0; k < n; ++k) {
    const double u = 2 * std::numbers::pi * k / n, turn = half_turns * u / 2;
    for (const int side : {0, 1}) {
      const double r = 2 + (side ? .5 : -.5) * std::cos(turn);
      t.points.col(2 * k + side) = Vec3(r * std::cos(u), r * std::sin(u), (side ? .5 : -.5) * std::sin(turn));
    }
    const bool crossed = k + 1 == n && half_turns % 2 != 0;
    const int a = 2 * k, b = 2 * k + 1, next = 2 * ((k + 1) % n), c = crossed ? next + 1 : next,
              d = crossed ? next : next + 1;
    t.faces.push_back({a, c, b});
    t.faces.push_back({b, c, d});
  }
  return t;
}

TEST(Repair, AValidMeshStaysAsItIs) {
  for (const test::Triangles& t :
       {test::shuffled(test::sphere(2, .2)), test::grid(6, test::paraboloid, .3), test::cube(),
        test::both(test::sphere(1), test::moved(test::cube())), band(9, 2)}) {
    const Repaired r = repaired(t);
    EXPECT_EQ(codes(r), Codes{});
    EXPECT_EQ(r.triangles, t.faces);
    EXPECT_EQ(r.points, t.points);
  }
}

TEST(Repair, SeparateClosedBodiesMayTouchAnywhere) {
  test::Triangles other = test::cube();
  other.points.row(0).array() += 1;  // a whole side in common
  const test::Triangles t = test::both(test::cube(), other);
  EXPECT_EQ(codes(repaired(t)), Codes{});
}

TEST(Repair, TrianglesOnTheirOwnAreWelded) {
  const test::Triangles t = test::sphere(2, .2);
  const Repaired r = repaired(soup(t));
  EXPECT_EQ(codes(r), Codes{"vertices_welded"});
  EXPECT_EQ(r.points.cols(), t.points.cols());
  EXPECT_EQ(topology_of(r).euler, 2);
  const Repaired shaken = repaired(test::shaken(soup(t), 1e-5));
  EXPECT_EQ(topology_of(shaken).boundary_loops, 0);
  EXPECT_EQ(shaken.points.cols(), t.points.cols());
  EXPECT_TRUE(
      has(r.changes[0].message, "m: 798 vertices merged with others that lie where they do: vertices "));
  EXPECT_TRUE(has(r.changes[0].message, " ..."));
}

TEST(Repair, OrientationIsThatOfMostFacesAndOutward) {
  const test::Triangles t = test::sphere(2, .2);
  std::mt19937 random(4);
  for (const double share : {.01, .3, .7, 1.}) {
    test::Triangles mixed = t;
    for (Triangle& face : mixed.faces)
      if (std::generate_canonical<double, 53>(random) <= share) flip(face);
    const Repaired r = repaired(mixed);
    EXPECT_EQ(turned(r.triangles), turned(t.faces)) << share;
    EXPECT_EQ(codes(r).back(), share > .5 ? "components_turned" : "faces_flipped");
    for (size_t f = 0; f < t.faces.size(); ++f)
      EXPECT_EQ(r.origin.flipped[f] != 0, turned({mixed.faces[f]}) != turned({t.faces[f]}));
  }
}

TEST(Repair, ACavityKeepsItsOrientation) {
  test::Triangles inner = test::sphere(1);
  inner.points *= .5;
  for (Triangle& face : inner.faces) flip(face);
  EXPECT_EQ(codes(repaired(test::both(test::sphere(2), inner))), Codes{});
  inner.points.array() += 5;
  EXPECT_EQ(codes(repaired(test::both(test::sphere(2), inner))), Codes{"components_turned"});
}

TEST(Repair, FinsOfRoundingAreDroppedOnBothSides) {
  const test::Triangles cube = test::cube();
  for (const double height : {0., 1e-9, .1}) {
    test::Triangles t = cube;
    const auto& [a, b, c] = cube.faces[0];
    const int tip = static_cast<int>(t.points.cols());
    t.points.conservativeResize(3, tip + 1);
    t.points.col(tip) = .5 * (cube.points.col(a) + cube.points.col(b)) +
                        height * (cube.points.col(b) - cube.points.col(a)).unitOrthogonal();
    t.faces.insert(t.faces.begin() + 2, {a, b, tip});
    t.faces.push_back({b, a, tip});
    const Repaired r = repaired(t);
    EXPECT_TRUE(is_valid(r));
    EXPECT_EQ(topology_of(r).closed(), height < .1) << height;
    if (height == .1) continue;
    EXPECT_EQ(codes(r), (Codes{"flaps_dropped", "vertices_dropped"}));
    EXPECT_EQ(r.triangles, cube.faces);
    EXPECT_EQ(r.changes[0].message,
              "m: 2 faces dropped that lie back to back with nothing between them: faces 2, 13");
  }
}

TEST(Repair, AWallThatIsWeldedFlatLeavesItsBodyClosed) {
  const auto is_filled = [](int i, int, int k) { return k == 0 || i == 1; };
  test::Triangles t = test::cells(4, 3, 3, is_filled, 0);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v)
    if (t.points(0, v) > 1.5) t.points(0, v) -= .99;
  const Repaired r = repaired(t, {.repair = true, .weld = .02});
  EXPECT_EQ(std::ranges::count(codes(r), "flaps_dropped"), 1);
  EXPECT_EQ(std::ranges::count(codes(r), "duplicate_faces_dropped"), 0);
  EXPECT_TRUE(is_valid(r));
  EXPECT_TRUE(topology_of(r).closed());
  EXPECT_EQ(topology_of(r).euler, 2);
  EXPECT_NEAR(volume_of(r), 3.01 * 3, 1e-9);
}

TEST(Repair, BodiesThatShareAWallAreTakenApart) {
  const test::Triangles cube = test::cube();
  test::Triangles mirrored = cube;
  mirrored.points.row(0) = (2 - cube.points.row(0).array()).matrix();
  for (Triangle& face : mirrored.faces) flip(face);
  test::Triangles t = test::shuffled(test::both(cube, mirrored));
  std::ranges::shuffle(t.faces, std::mt19937(3));
  const Repaired r = repaired(t, {.repair = true, .weld = 1e-6});
  EXPECT_EQ(codes(r), (Codes{"vertices_welded", "edges_cut"}));
  EXPECT_EQ(r.triangles.size(), 24);
  EXPECT_TRUE(is_valid(r));
  EXPECT_EQ(topology_of(r).components, 2);
  EXPECT_TRUE(topology_of(r).closed());
  EXPECT_NEAR(volume_of(r), 2, 1e-12);
  const Repaired joined = repaired(t, {.repair = true, .weld = 1e-6, .keep_junctions = true});
  EXPECT_EQ(joined.triangles.size(), 22) << "one wall";
}

TEST(Repair, OfTwoSidesOfASheetOneStays) {
  test::Triangles sheet = test::grid(5, test::flat);
  test::Triangles t = sheet;
  for (Triangle face : sheet.faces) {
    flip(face);
    t.faces.push_back(face);
  }
  EXPECT_EQ(repaired(t).triangles, sheet.faces);
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) t.points(1, v) *= 1e-9;
  EXPECT_EQ(repaired(t).triangles.size(), sheet.faces.size());
}

TEST(Repair, DuplicatesAndRepeatedVerticesAreDropped) {
  test::Triangles t = test::sphere(1);
  const auto faces = t.faces;
  t.faces.push_back({faces[3][1], faces[3][2], faces[3][0]});
  t.faces.insert(t.faces.begin() + 5, {7, 7, 2});
  t.faces.push_back({faces[9][0], faces[9][2], faces[9][1]});
  const Repaired r = repaired(t);
  EXPECT_EQ(codes(r), (Codes{"faces_dropped", "duplicate_faces_dropped", "opposite_faces_dropped"}));
  EXPECT_EQ(r.triangles, faces);
  EXPECT_EQ(r.changes[0].message, "m: 1 faces dropped that use a vertex twice: faces 5");
  EXPECT_EQ(r.changes[1].message, "m: 1 faces dropped whose vertices another face has: faces 81");
  EXPECT_EQ(r.changes[2].message, "m: 1 faces dropped that lie back to back with another: faces 82");
  EXPECT_EQ(r.origin.face[5], 6);
}

TEST(Repair, NothingStaysNothing) {
  const Repaired r =
      repaired({Mat3X(3, 0), {}}, {.repair = true, .weld_share = .1, .drop_components = .1, .fill_holes = 9});
  EXPECT_EQ(codes(r), Codes{});
  EXPECT_TRUE(r.triangles.empty());
}

TEST(Repair, DegenerateFacesThatAreManifoldStay) {
  test::Triangles t = test::sphere(1);
  t.points.col(t.faces[4][0]) = t.points.col(t.faces[4][1]);
  EXPECT_EQ(repaired(t).triangles, t.faces);
}

TEST(Repair, SolidsThatShareAnEdgeOrAVertexAreSeparated) {
  for (const bool edge : {true, false}) {
    test::Triangles other = test::cube();
    other.points.row(0).array() += 1;
    other.points.row(1).array() += 1;
    if (!edge) other.points.row(2).array() += 1;
    test::Triangles t = test::both(test::cube(), other);
    // One number for equal places.
    for (Triangle& face : t.faces)
      for (int& v : face)
        for (int w = 0; w < v; ++w)
          if (t.points.col(w) == t.points.col(v)) v = w;
    const Repaired r = repaired(t);
    EXPECT_EQ(codes(r), edge ? (Codes{"edges_cut", "vertices_dropped"})
                             : (Codes{"vertices_split", "vertices_dropped"}));
    const Topology topology = topology_of(r);
    EXPECT_EQ(topology.components, 2);
    EXPECT_EQ(topology.euler, 4);
    EXPECT_EQ(topology.boundary_loops, 0);
    EXPECT_NEAR(volume_of(r), 2, 1e-12);
  }
}

TEST(Repair, AFinIsCutOffAndTheSheetGoesOn) {
  // A flat sheet of two triangles at edge 0-1, and a fin on it.
  Mat3X points(3, 5);
  points << 0, 0, 1, -1, 0, 0, 1, .5, .5, .5, 0, 0, 0, 0, 1;
  const Repaired r = repaired({points, {{0, 1, 3}, {0, 1, 4}, {1, 0, 2}}});
  ASSERT_EQ(codes(r), Codes{"edges_cut"});
  EXPECT_EQ(r.changes[0].message,
            "m: 1 edges with three or more faces cut into sheets (--keep non-manifold leaves walls between "
            "bodies joined): edges 0-1");
  EXPECT_EQ(r.triangles[0], (Triangle{0, 1, 3}));
  EXPECT_EQ(r.triangles[2], (Triangle{1, 0, 2}));
  EXPECT_EQ(r.triangles[1], (Triangle{5, 6, 4}));
  EXPECT_EQ(r.origin.vertex, (std::vector{0, 1, 2, 3, 4, 0, 1}));
}

TEST(Repair, OneSidedSurfacesAreCutOpen) {
  const Repaired r = repaired(band(12, 1));
  EXPECT_TRUE(is_valid(r));
  EXPECT_EQ(codes(r).front(), "surface_opened");
  EXPECT_EQ(topology_of(r).components, 1);
  EXPECT_EQ(topology_of(r).euler, 1) << "a strip";
}

TEST(Repair, RandomTrianglesBecomeManifold) {
  std::mt19937 random(8);
  for (int round = 0; round < 300; ++round) {
    const int vertices = 4 + round % 23, faces = 1 + round % 61;
    std::uniform_int_distribution<int> vertex(0, vertices - 1);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    test::Triangles t{Mat3X(3, vertices), {}};
    for (double& x : t.points.reshaped())
      x = round % 3 == 0 ? std::round(2 * coordinate(random)) : coordinate(random);
    for (int f = 0; f < faces; ++f) t.faces.push_back({vertex(random), vertex(random), vertex(random)});
    for (const RepairOptions& options : {all, RepairOptions{.repair = true, .fill_holes = 20},
                                         RepairOptions{.repair = true, .weld = .3, .fill_holes = 5}}) {
      const Repaired r = repaired(t, options);
      for (const Problem& p : find_problems(r.points, r.triangles))
        EXPECT_TRUE(is_acceptable(p.kind) || p.kind == ProblemKind::no_faces ||
                    p.kind == ProblemKind::no_area)
            << round << ' ' << name_of(p.kind);
      ASSERT_EQ(r.origin.vertex.size(), r.points.cols());
      ASSERT_EQ(r.origin.face.size(), r.triangles.size());
      for (size_t v = 0; v < r.origin.vertex.size(); ++v)
        EXPECT_EQ(r.points.col(static_cast<Eigen::Index>(v)), t.points.col(r.origin.vertex[v]));
    }
  }
}

TEST(Repair, HolesUpToASizeAreFilled) {
  const test::Triangles whole = test::sphere(2, .1);
  test::Triangles t = whole;
  const int centre = t.faces[7][0];
  std::erase_if(t.faces, [&](const Triangle& f) { return std::ranges::find(f, centre) != f.end(); });
  const size_t ring = whole.faces.size() - t.faces.size();
  t.faces.erase(t.faces.end() - 1);
  const auto with = [&](int size) { return repaired(t, {.repair = true, .fill_holes = size}); };
  const Repaired both = with(static_cast<int>(ring)), one = with(static_cast<int>(ring) - 1);
  EXPECT_EQ(codes(both), (Codes{"holes_filled", "vertices_dropped"}));
  EXPECT_EQ(topology_of(both).euler, 2);
  EXPECT_EQ(topology_of(both).boundary_loops, 0);
  EXPECT_EQ(both.origin.filled, ring - 2 + 1);
  EXPECT_NEAR(volume_of(both), 4 * std::numbers::pi / 3, .5);
  EXPECT_EQ(topology_of(one).boundary_loops, 1);
  const Repaired triangle = repaired(test::equilateral(), {.repair = true, .fill_holes = 3});
  EXPECT_EQ(triangle.triangles.size(), 1u) << "its outer edges are no hole";
}

TEST(Repair, SmallComponentsAreDropped) {
  test::Triangles crumb = test::sphere(0);
  crumb.points *= .01;
  crumb.points.array() += 3;
  const Repaired r = repaired(test::both(crumb, test::sphere(2)), {.repair = true, .drop_components = .01});
  EXPECT_EQ(codes(r), (Codes{"components_dropped", "vertices_dropped"}));
  EXPECT_EQ(r.triangles, test::sphere(2).faces);
  EXPECT_EQ(r.origin.vertex.front(), 12);
}

TEST(Repair, WeldingAloneChangesNothingElse) {
  test::Triangles t = test::both(test::grid(3, test::flat), test::grid(3, test::flat));
  t.points.rightCols(16).row(0).array() += 1 + 1e-4;
  t.points.conservativeResize(3, 33);
  t.points.col(32) = Vec3(9, 9, 9);
  const Repaired r = repaired(t, {.weld = 2e-4});
  EXPECT_EQ(codes(r), Codes{"vertices_welded"});
  EXPECT_EQ(r.points.cols(), 33 - 4);
  EXPECT_EQ(r.points.col(28), Vec3(9, 9, 9));
  EXPECT_EQ(topology_of(r).components, 1);
  EXPECT_EQ(codes(repaired(t, {.weld_share = 4e-5})), Codes{}) << "of the diagonal of the faces' box";
  EXPECT_EQ(codes(repaired(t, {.weld_share = 5e-5})), Codes{"vertices_welded"});
  EXPECT_EQ(codes(repaired(t, {.weld = .4})), (Codes{"vertices_welded", "faces_dropped"}));
}

constexpr RepairOptions collapsing{.collapse = true};

/// As marching cubes make them where the value at a grid point is that of the level.
TEST(Repair, VerticesInTheSamePlaceAreOneAfterwards) {
  test::Triangles t = test::sphere(2, .2);
  const Adjacency c = test::connect(t);
  std::vector<int> old;
  for (int v = 0; v < 10; ++v)
    for (int n : c.vertex_neighbours[v])
      if (n > v && std::ranges::find(old, n) == old.end()) {
        old.push_back(n);
        t.points.col(n) = t.points.col(v);
        break;
      }
  const Repaired r = repaired(t, collapsing);
  EXPECT_EQ(codes(r), Codes{"edges_collapsed"});
  EXPECT_EQ(r.changes[0].count, old.size());
  EXPECT_EQ(r.points.cols(), t.points.cols() - std::ssize(old));
  EXPECT_EQ(r.triangles.size(), t.faces.size() - 2 * old.size());
  EXPECT_EQ(topology_of(r).euler, 2);
  EXPECT_TRUE(find_problems(r.points, r.triangles).empty());
  for (const int v : old) {
    const std::vector<int> now = vertices_from(r.origin, {v});
    ASSERT_EQ(now.size(), 1u);
    EXPECT_EQ(r.points.col(now[0]), t.points.col(v));
  }
  for (size_t f = 0; f < r.triangles.size(); ++f)
    for (size_t k = 0; k < 3; ++k)
      EXPECT_EQ(r.origin.vertex[r.triangles[f][k]], r.origin.merged[t.faces[r.origin.face[f]][k]]);
}

TEST(Repair, FacesOverHolesAreCountedAfterACollapse) {
  test::Triangles t = test::grid(3, test::flat);
  t.points.col(1) = t.points.col(0);  // an edge of the boundary, which a face over the hole has too
  const Repaired r = repaired(t, {.repair = true, .fill_holes = 99, .collapse = true});
  EXPECT_EQ(topology_of(r).boundary_loops, 0);
  size_t filled = 0;
  std::set<int> old;
  for (const int f : r.origin.face) filled += !old.insert(f).second;
  EXPECT_EQ(r.origin.filled, filled);
}

/// As a cut makes them that passes a rounding beside vertices.
TEST(Repair, EdgesOfARoundingAreCollapsed) {
  test::Triangles t = test::grid(6, test::flat);
  const auto size = box_of_faces(t.points, t.faces).diagonal().norm();
  const std::vector<Triangle> whole = t.faces;
  const auto has = [](const Triangle& f, int v) { return std::ranges::find(f, v) != f.end(); };
  const auto split_beside = [&](double rounding) {  // one edge, next to one of its ends
    test::Triangles split = t;
    const int from = 24, to = 25, fresh = static_cast<int>(t.points.cols());
    split.points.conservativeResize(3, fresh + 1);
    split.points.col(fresh) = t.points.col(from) + rounding * size * Vec3(1, 0, 0);
    split.faces.clear();
    for (const Triangle& f : whole) {
      if (!has(f, from) || !has(f, to)) {
        split.faces.push_back(f);
        continue;
      }
      for (const int end : {from, to}) {
        Triangle half = f;
        std::ranges::replace(half, end, fresh);
        split.faces.push_back(half);
      }
    }
    return split;
  };
  const Repaired r = repaired(split_beside(5e-8), collapsing);
  EXPECT_EQ(codes(r), Codes{"edges_collapsed"});
  EXPECT_EQ(r.points, t.points);
  EXPECT_EQ(r.triangles.size(), whole.size());
  EXPECT_EQ(codes(repaired(split_beside(2e-7), collapsing)), Codes{}) << "a step";
  EXPECT_EQ(codes(repaired(split_beside(5e-8))), Codes{}) << "not asked for";
}

TEST(Repair, DetailsOfARoundingAreNotCollapsed) {
  test::Triangles t = test::sphere(2);
  const Eigen::Index sphere = t.points.cols();
  const test::Triangles far = test::sphere(1);
  for (const Triangle& f : far.faces)
    t.faces.push_back(
        {f[0] + static_cast<int>(sphere), f[1] + static_cast<int>(sphere), f[2] + static_cast<int>(sphere)});
  t.points.conservativeResize(3, sphere + far.points.cols());
  t.points.leftCols(sphere) *= 1e-8;
  t.points.rightCols(far.points.cols()) = far.points.colwise() + Vec3(3, 0, 0);
  EXPECT_EQ(codes(repaired(t, collapsing)), Codes{}) << "a small sphere beside a large one";
}

TEST(Repair, CollapsedEdgesTurnNoFaceOver) {
  int collapsed = 0;
  for (unsigned seed = 1; seed <= 30; ++seed)
    for (const double scale : {3e-6, 2e-6, 1e-6, 1e-8}) {
      test::Triangles t = test::grid(12, test::flat, .4, seed);
      const Vec3 middle = t.points.col(84);
      for (auto p : t.points.colwise())
        if ((p - middle).norm() < .3) p = middle + scale * (p - middle);
      const auto turned = [](const Mat3X& points, const std::vector<Triangle>& faces) {
        return std::ranges::count_if(
            faces, [&](const Triangle& f) { return doubled_area_vector(points, f).z() <= 0; });
      };
      if (turned(t.points, t.faces) > 0) continue;
      const Repaired r = repaired(t, collapsing);
      EXPECT_EQ(turned(r.points, r.triangles), 0) << seed << " " << scale;
      collapsed += r.triangles.size() < t.faces.size();
    }
  EXPECT_GT(collapsed, 10);
}

TEST(Repair, ChainsOfEdgesOfARoundingAreNotOneVertex) {
  constexpr int links = 40;  // from right to left, so that each goes into the next
  test::Triangles fan;
  fan.points = Mat3X::Zero(3, links + 2);
  for (int v = 0; v <= links; ++v) fan.points(0, v) = 4e-8 * (links - v);
  fan.points.col(links + 1) = Vec3(0, 1, 0);
  for (int v = 0; v < links; ++v) fan.faces.push_back({v + 1, v, links + 1});
  const Repaired r = repaired(fan, collapsing);
  for (Eigen::Index v = 0; v <= links; ++v) {
    const Vec3 moved =
        r.points.col(vertices_from(r.origin, {static_cast<int>(v)}).front()) - fan.points.col(v);
    EXPECT_LE(moved.norm(), 1e-7);
  }
  EXPECT_LE(r.points.cols(), fan.points.cols() / 2);
}

TEST(Repair, LengthsAndTopologyAreNotCollapsed) {
  for (const double thickness : {1e-12, 1e-9, 5e-8})
    for (const double bend : {0., .3}) {
      test::Triangles foil = test::cube();
      for (auto p : foil.points.colwise()) p[2] = thickness * p[2] + bend * p[0];
      EXPECT_EQ(codes(repaired(foil, collapsing)), Codes{}) << thickness;
    }
  test::Triangles pinched = test::torus(6, 3, 0);
  for (const int v : {1, 2}) pinched.points.col(v) = pinched.points.col(0);
  EXPECT_EQ(topology_of(repaired(pinched, collapsing)).euler, 0);
  test::Triangles fin = test::sphere(1);
  fin.points.col(fin.faces[4][0]) = fin.points.col(fin.faces[4][1]);
  fin.faces.push_back({fin.faces[7][0], fin.faces[7][1], 0});
  EXPECT_EQ(codes(repaired(fin, collapsing)), Codes{}) << "no manifold";
}

TEST(MeshOrigin, OldIdsFindTheirVertices) {
  Mat3X points(3, 6);
  points << 0, 0, 1, -1, 0, 0, 0, 1, .5, .5, .5, 1, 0, 0, 0, 0, 1, 0;
  // Vertex 5 lies on 1; the fin's edge is cut.
  const Repaired r = repaired({points, {{0, 1, 3}, {0, 5, 4}, {1, 0, 2}}});
  int lost = 0;
  EXPECT_EQ(vertices_from(r.origin, {5}, &lost), vertices_from(r.origin, {1}));
  EXPECT_EQ(lost, -1);
  EXPECT_EQ(vertices_from(r.origin, {0}).size(), 2u);
  EXPECT_EQ(vertices_from(r.origin, {0, 2, 3, 4, 5}).size(), r.points.cols());
  test::Triangles loose = test::equilateral();
  loose.points.conservativeResize(3, 4);
  loose.points.col(3) = Vec3(7, 7, 7);
  vertices_from(repaired(loose).origin, {0, 3}, &lost);
  EXPECT_EQ(lost, 3);
}

TEST(MeshOrigin, AMapLeadsBackToTheOldFaces) {
  test::Triangles t = test::sphere(1);
  flip(t.faces[4]);
  t.faces.erase(t.faces.begin() + 20);
  const Repaired r = repaired(t, {.repair = true, .fill_holes = 3});
  std::vector<MapEntry> map;
  for (size_t f = 0; f < r.triangles.size(); ++f)
    map.push_back({-1, {static_cast<int>(f), Vec3(.2, .3, .5)}});
  map.push_back({3, {}});
  const std::vector<MapEntry> old = map_to_old(map, r.origin);
  for (size_t f = 0; f + 1 < r.triangles.size(); ++f) {
    Vec3 before = Vec3::Zero(), after = Vec3::Zero();
    for (size_t k = 0; k < 3; ++k) {
      const auto weight = static_cast<Eigen::Index>(k);
      before += map[f].position.weights[weight] * r.points.col(r.triangles[f][k]);
      after += old[f].position.weights[weight] * t.points.col(t.faces[old[f].position.face][k]);
    }
    EXPECT_LT((before - after).norm(), 1e-15);
  }
  EXPECT_EQ(old[r.triangles.size() - 1].position.face, -1) << "over the hole";
  EXPECT_EQ(old.back().vertex, 3);
  EXPECT_EQ(map_to_old(map, {})[5].position.face, 5);
}

}  // namespace hooke::repair_test
