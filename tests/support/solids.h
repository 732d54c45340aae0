// Small solids with figures known by heart, and the motions that must not change them. For tests.
#pragma once

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include "hooke/mesh/adjacency.h"
#include "support/meshes.h"

namespace hooke::test {

inline Adjacency connect(const Triangles& t) {
  return make_adjacency(static_cast<int>(t.points.cols()), t.faces);
}

inline Triangles triangles(std::initializer_list<Vec3> points, std::vector<Triangle> faces) {
  Triangles t{Mat3X(3, static_cast<Eigen::Index>(points.size())), std::move(faces)};
  Eigen::Index i = 0;
  for (const Vec3& p : points) t.points.col(i++) = p;
  return t;
}

inline Triangles equilateral() {
  return triangles({{0, 0, 0}, {1, 0, 0}, {.5, std::numbers::sqrt3 / 2, 0}}, {{0, 1, 2}});
}

/// Edge length sqrt(8).
inline Triangles tetrahedron() {
  return triangles({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                   {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
}

/// [0, 1]^3, two triangles a side.
inline Triangles cube() {
  return triangles({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                   {{0, 2, 1},
                    {0, 3, 2},
                    {4, 5, 6},
                    {4, 6, 7},
                    {0, 1, 5},
                    {0, 5, 4},
                    {1, 2, 6},
                    {1, 6, 5},
                    {2, 3, 7},
                    {2, 7, 6},
                    {3, 0, 4},
                    {3, 4, 7}});
}

/// A unit sphere of quadrilaterals cut in two between meridians and circles of latitude; triangles at the
/// poles.
inline Triangles globe(int meridians, int bands) {
  std::vector<Vec3> p = {{0, 0, 1}};
  Triangles t;
  const auto vertex = [&](int band, int i) { return 1 + (band - 1) * meridians + i % meridians; };
  for (int j = 1; j < bands; ++j)
    for (int i = 0; i < meridians; ++i) {
      const double north = std::numbers::pi * j / bands, east = 2 * std::numbers::pi * i / meridians;
      p.emplace_back(std::sin(north) * std::cos(east), std::sin(north) * std::sin(east), std::cos(north));
    }
  const int south = static_cast<int>(p.size());
  p.emplace_back(0, 0, -1);
  for (int i = 0; i < meridians; ++i) {
    t.faces.push_back({0, vertex(1, i), vertex(1, i + 1)});
    t.faces.push_back({south, vertex(bands - 1, i + 1), vertex(bands - 1, i)});
    for (int j = 1; j < bands - 1; ++j) {
      t.faces.push_back({vertex(j, i), vertex(j + 1, i), vertex(j + 1, i + 1)});
      t.faces.push_back({vertex(j, i), vertex(j + 1, i + 1), vertex(j, i + 1)});
    }
  }
  t.points.resize(3, static_cast<Eigen::Index>(p.size()));
  for (size_t v = 0; v < p.size(); ++v) t.points.col(static_cast<Eigen::Index>(v)) = p[v];
  return t;
}

/// Radii 1 and .4. Each point is moved along the torus by up to `jitter` cells.
inline Triangles torus(int around, int across, double jitter) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  Triangles t;
  t.points.resize(3, around * across);
  const auto id = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * (i + shift(random)) / around;
      const double v = 2 * std::numbers::pi * (j + shift(random)) / across;
      t.points.col(id(i, j)) =
          Vec3((1 + .4 * std::cos(v)) * std::cos(u), (1 + .4 * std::cos(v)) * std::sin(u), .4 * std::sin(v));
      t.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      t.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return t;
}

/// A ring turned on a lathe: the closed profile of radii and heights, counterclockwise, in long facets.
inline Triangles turned(const std::vector<Eigen::Vector2d>& profile, int around) {
  const auto n = static_cast<int>(profile.size());
  Triangles t{Mat3X(3, n * around), {}};
  const auto id = [&](int i, int k) { return (i % around) * n + k % n; };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < n; ++k) {
      const double turn = 2 * std::numbers::pi * i / around;
      t.points.col(id(i, k)) =
          Vec3(profile[k][0] * std::cos(turn), profile[k][0] * std::sin(turn), profile[k][1]);
      t.faces.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
      t.faces.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
    }
  return t;
}

/// A pipe with a wall of 1 that narrows: it bends by 22 degrees where its cone begins, at half its height,
/// and ends.
inline Triangles reducer(int around) {
  return turned({{9, 0}, {10, 0}, {10, 15}, {6, 25}, {6, 40}, {5, 40}, {5, 25}, {9, 15}}, around);
}

/// A cylinder of radius 1 without vertices between its rims: its sides are needles, its caps are cut at
/// random.
inline Triangles drum(int sides, double height) {
  std::mt19937 random(5);
  Triangles t;
  t.points.resize(3, 2 * sides);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    t.points.col(i) << std::cos(angle), std::sin(angle), 0;
    t.points.col(sides + i) << std::cos(angle), std::sin(angle), height;
    const int next = (i + 1) % sides;
    t.faces.push_back({i, next, sides + next});
    t.faces.push_back({i, sides + next, sides + i});
  }
  const auto cut_caps = [&](const auto& self, int low, int high) -> void {
    if (high - low < 2) return;
    const int middle = std::uniform_int_distribution(low + 1, high - 1)(random);
    t.faces.push_back({low, high, middle});
    t.faces.push_back({sides + low, sides + middle, sides + high});
    self(self, low, middle);
    self(self, middle, high);
  };
  cut_caps(cut_caps, 0, sides - 1);
  return t;
}

/// A prism of radius 10 over a regular polygon, turned by `degrees` from its base to its top, in layers of
/// needles that reach from corner to corner.
inline Triangles twisted_prism(int sides, int layers, double degrees, double height) {
  Triangles t{Mat3X(3, sides * (layers + 1)), {}};
  for (int k = 0; k <= layers; ++k)
    for (int i = 0; i < sides; ++i) {
      const double turn = (360. * i / sides + degrees * k / layers) * std::numbers::pi / 180;
      t.points.col(k * sides + i) << 10 * std::cos(turn), 10 * std::sin(turn), height * k / layers;
    }
  for (int k = 0; k < layers; ++k)
    for (int i = 0; i < sides; ++i) {
      const int a = k * sides + i, b = k * sides + (i + 1) % sides;
      t.faces.push_back({a, b, b + sides});
      t.faces.push_back({a, b + sides, a + sides});
    }
  for (int i = 1; i + 1 < sides; ++i) {
    const int top = layers * sides;
    t.faces.push_back({0, i + 1, i});
    t.faces.push_back({top, top + i, top + i + 1});
  }
  return t;
}

inline Triangles both(const Triangles& a, const Triangles& b) {
  Triangles t{Mat3X(3, a.points.cols() + b.points.cols()), a.faces};
  t.points << a.points, b.points;
  const int shift = static_cast<int>(a.points.cols());
  for (const Triangle& f : b.faces) t.faces.push_back({f[0] + shift, f[1] + shift, f[2] + shift});
  return t;
}

inline Triangles moved(Triangles t, double scale = 1) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(1.1, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  t.points = (scale * (rotation * t.points)).eval();
  t.points.colwise() += Vec3(.3, -7, 2) * scale;
  return t;
}

/// The same with its vertices numbered at random.
inline Triangles shuffled(const Triangles& t, unsigned seed = 2) {
  std::vector<int> fresh(t.points.cols());
  std::iota(fresh.begin(), fresh.end(), 0);
  std::mt19937 random(seed);
  std::ranges::shuffle(fresh, random);
  Triangles result{Mat3X(3, t.points.cols()), t.faces};
  for (Eigen::Index v = 0; v < t.points.cols(); ++v) result.points.col(fresh[v]) = t.points.col(v);
  for (Triangle& face : result.faces)
    for (int& v : face) v = fresh[v];
  return result;
}

/// A sphere and a piece of a plane with a boundary, and three vertices without faces.
inline Triangles two_parts_and_loose_vertices() {
  Triangles t = both(sphere(2), grid(9, flat));
  t.points.conservativeResize(3, t.points.cols() + 3);
  t.points.rightCols(3).setConstant(9);
  return t;
}

/// Every coordinate shifted by up to `size`.
inline Triangles shaken(Triangles t, double size, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-size, size);
  for (double& x : t.points.reshaped()) x += shift(random);
  return t;
}

/// Splits every `step`-th face from `first` on at its centre, which has valence 3 then.
inline void split_at_centres(Triangles& t, size_t first, size_t step) {
  const size_t count = t.faces.size();
  for (size_t f = first; f < count; f += step) {
    const auto [a, b, c] = t.faces[f];
    const int centre = static_cast<int>(t.points.cols());
    t.points.conservativeResize(3, centre + 1);
    t.points.col(centre) = (t.points.col(a) + t.points.col(b) + t.points.col(c)) / 3;
    t.faces[f] = {a, b, centre};
    t.faces.push_back({b, c, centre});
    t.faces.push_back({c, a, centre});
  }
}

}  // namespace hooke::test
