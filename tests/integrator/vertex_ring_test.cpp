#include "hooke/integrator/vertex_ring.h"

#include <gtest/gtest.h>

#include "support/named_terms.h"
#include "support/scene.h"

#include "hooke/springs/energy.h"

namespace hooke::vertex_ring_test {

/// The corner angles of the faces of a vertex.
std::vector<double> angles_about(const test::Scene& s, int vertex) {
  std::vector<double> angles;
  for (int f : s.adjacency.vertex_faces[vertex])
    for (size_t k = 0; k < 3; ++k) {
      const auto corner = [&](size_t i) {
        return Vec3(s.positions.points.col(s.adjacency.faces[f][(k + i) % 3]));
      };
      const Vec3 a = corner(1) - corner(0), b = corner(2) - corner(0);
      angles.push_back(std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  return angles;
}

/// A mesh with slivers and folds on a sphere and a grid with a boundary, looked at vertex by vertex.
class RingLaws : public testing::TestWithParam<test::NamedTerms> {
 protected:
  test::SceneOptions options() const {
    test::SceneOptions o;
    o.terms = GetParam().terms;
    return o;
  }
  test::Scene sphere_{test::sphere(2, .45, 7), test::to_unit_sphere, options()};
  test::Scene ground_ = test::ground_scene(.45, options());

  template <class Law>
  void for_each_ring(const Law& law) {
    for (test::Scene* s : {&sphere_, &ground_}) {
      VertexRing ring(s->coloring.rings, s->targets);
      for (int v = 0; v < s->adjacency.vertex_count; ++v) {
        ring.gather(s->positions, v);
        law(*s, ring, v);
      }
    }
  }
  static RingModel model(const test::Scene& s, const VertexRing& ring, int v, const Vec3& x, const Vec3& a,
                         const Vec3& b) {
    RingShape shape;
    ring.shape(x, s.positions.normals.col(v), shape);
    return ring.model(shape, s.terms, a, b);
  }
};

TEST_P(RingLaws, TheEnergyChangesAsThatOfTheWholeMesh) {
  for_each_ring([](test::Scene& s, const VertexRing& ring, int v) {
    const Vec3 x = s.positions.points.col(v), n = s.positions.normals.col(v);
    RingShape here, there;
    const Vec3 y = x + .05 * s.L() * n.unitOrthogonal();
    ring.shape(x, n, here);
    ring.shape(y, n, there);
    const auto of_mesh = [&s] {
      return test::energy_by_definition(s.positions.points, s.positions.normals, s.adjacency, s.targets,
                                        s.terms);
    };
    const double before = of_mesh();
    s.positions.points.col(v) = y;
    const double after = of_mesh();
    s.positions.points.col(v) = x;
    EXPECT_NEAR(ring.energy(there, s.terms) - ring.energy(here, s.terms), after - before, 1e-10 * before);
  });
}

TEST_P(RingLaws, TheModelHasTheEnergyAndItsGradient) {
  for_each_ring([](test::Scene& s, const VertexRing& ring, int v) {
    const Vec3 x = s.positions.points.col(v), n = s.positions.normals.col(v);
    const Vec3 a = n.unitOrthogonal(), b = n.cross(a);
    const double h = 1e-6 * s.L();
    const auto energy = [&](const Vec3& at) {
      RingShape shape;
      ring.shape(at, n, shape);
      return ring.energy(shape, s.terms);
    };
    const RingModel m = model(s, ring, v, x, a, b);
    EXPECT_NEAR(m.energy, energy(x), 1e-13 * m.energy);
    for (int k = 0; k < 2; ++k) {
      const Vec3 step = h * (k == 0 ? a : b);
      EXPECT_NEAR(m.gradient[k], (energy(x + step) - energy(x - step)) / (2 * h),
                  1e-5 * (1 + m.gradient.norm() + m.energy / s.L()));
    }
  });
}

/// The two evaluations of the common terms, over the whole mesh and about one vertex, agree.
TEST(RingEnergy, HasTheGradientOfTheWholeMesh) {
  test::Scene s(test::sphere(2, .45, 7), test::to_unit_sphere);
  VertexRing ring(s.coloring.rings, s.targets);
  Mat3X gradient;
  s.energy(s.positions.points, s.positions.normals, &gradient);
  for (int v = 0; v < s.adjacency.vertex_count; ++v) {
    const Vec3 n = s.positions.normals.col(v), a = n.unitOrthogonal(), b = n.cross(a);
    RingShape here;
    ring.gather(s.positions, v);
    ring.shape(s.positions.points.col(v), n, here);
    const RingModel m = ring.model(here, s.terms, a, b);
    EXPECT_NEAR(m.gradient[0], gradient.col(v).dot(a), 1e-10 * (1 + gradient.col(v).norm()));
    EXPECT_NEAR(m.gradient[1], gradient.col(v).dot(b), 1e-10 * (1 + gradient.col(v).norm()));
  }
}

TEST_P(RingLaws, TheHessianEqualsDifferencesOfTheGradient) {
  for_each_ring([](test::Scene& s, const VertexRing& ring, int v) {
    const double t = s.terms.angle > 0 ? s.terms.angle_threshold : 0;
    if (std::ranges::any_of(angles_about(s, v), [t](double a) { return a >= t && a <= angle_fade_out * t; }))
      return;
    const Vec3 x = s.positions.points.col(v);
    const Vec3 a =
        (s.positions.normals.col(v).unitOrthogonal() + .2 * s.positions.normals.col(v)).normalized();
    const Vec3 b = s.positions.normals.col(v).cross(a).normalized();
    const double h = 1e-6 * s.L();
    Eigen::Matrix2d differences;
    for (int k = 0; k < 2; ++k) {
      const Vec3 step = h * (k == 0 ? a : b);
      differences.col(k) =
          (model(s, ring, v, x + step, a, b).gradient - model(s, ring, v, x - step, a, b).gradient) / (2 * h);
    }
    const Eigen::Matrix2d hessian = model(s, ring, v, x, a, b).hessian;
    // A term that begins or ends within the step spoils its difference: second derivatives jump there.
    if ((differences - differences.transpose()).norm() > 1e-4 * differences.norm()) return;
    EXPECT_LT((hessian - differences).norm(), 1e-3 * differences.norm()) << v;
  });
}

TEST_P(RingLaws, TheHessianDoesNotLeapWhereAnglesReachTheirThreshold) {
  const RingTerms terms = GetParam().terms;
  for_each_ring([&terms](test::Scene& s, const VertexRing& ring, int v) {
    const Vec3 n = s.positions.normals.col(v), a = n.unitOrthogonal(), b = n.cross(a);
    RingShape here;
    ring.shape(s.positions.points.col(v), n, here);
    const auto hessian = [&](double threshold) {
      RingTerms moved = terms;
      moved.angle_threshold = threshold;
      return ring.model(here, moved, a, b).hessian;
    };
    for (double angle : angles_about(s, v)) {
      const Eigen::Matrix2d below = hessian((1 - 1e-9) * angle), above = hessian((1 + 1e-9) * angle);
      EXPECT_LT((above - below).norm(), 1e-6 * above.norm()) << v;
    }
  });
}

RingTerms all() {
  RingTerms t;
  t.string = .7;
  t.altitude = 1.3;
  t.angle = 2;
  t.angle_threshold = 1.2;
  return t;
}
RingTerms unfolding() {
  RingTerms t;
  t.unfold = 1;
  t.unfold_below = .95;
  return t;
}
INSTANTIATE_TEST_SUITE_P(All, RingLaws,
                         testing::Values(test::NamedTerms{"strings", test::only_strings()},
                                         test::NamedTerms{"altitudes", RingTerms{}},
                                         test::NamedTerms{"angles", test::only_angles()},
                                         test::NamedTerms{"all", all()},
                                         test::NamedTerms{"unfold", unfolding()}),
                         [](const auto& i) { return std::string(i.param.name); });

TEST(VertexRing, AFaceWithoutAreaHasAFiniteModel) {
  const test::Scene s(
      test::triangles({{0, 0, 0}, {1, 0, 0}, {.5, 0, 0}, {.5, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}),
      test::to_ground);
  VertexRing ring(s.coloring.rings, s.targets);
  RingShape shape;
  ring.gather(s.positions, 2);
  ring.shape(s.positions.points.col(2), Vec3::UnitZ(), shape);
  const RingModel m = ring.model(shape, s.terms, Vec3::UnitX(), Vec3::UnitY());
  EXPECT_TRUE(std::isfinite(m.energy) && m.gradient.allFinite() && m.hessian.allFinite());
  EXPECT_LT(m.gradient[1], 0);  // pushed open
}

}  // namespace hooke::vertex_ring_test
