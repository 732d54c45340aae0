#include "support/meshes.h"

#include <map>
#include <random>

namespace hooke::test {

Triangles grid(int n, double (*height)(double, double), double jitter, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter / n, jitter / n);
  Triangles t;
  t.points.resize(3, (n + 1) * (n + 1));
  for (int j = 0, v = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i, ++v) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const double x = double(i) / n + (inside ? shift(random) : 0);
      const double y = double(j) / n + (inside ? shift(random) : 0);
      t.points.col(v) = Vec3(x, y, height(x, y));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      t.faces.push_back({a, b, c});
      t.faces.push_back({a, c, d});
    }
  return t;
}

Triangles sphere(int levels, double jitter, unsigned seed) {
  const double g = (1 + std::sqrt(5.)) / 2;
  std::vector<Vec3> p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Vec3& v : p) v.normalize();
  std::vector<Triangle> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto split = [&](int a, int b) {
      const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(p.size()));
      if (fresh) p.push_back((p[size_t(a)] + p[size_t(b)]).normalized());
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = split(a, b), bc = split(b, c), ca = split(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  const double edge = (p[size_t(faces[0][0])] - p[size_t(faces[0][1])]).norm();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter * edge, jitter * edge);
  Triangles t{Mat3X(3, static_cast<Eigen::Index>(p.size())), faces};
  for (size_t v = 0; v < p.size(); ++v) {
    const double z = shift(random), y = shift(random), x = shift(random);
    t.points.col(static_cast<Eigen::Index>(v)) = (p[v] + Vec3(x, y, z)).normalized();
  }
  return t;
}

}  // namespace hooke::test
