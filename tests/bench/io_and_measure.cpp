// Seconds of reading, writing and measuring, by the number of vertices. Meshes are tori whose points are
// shaken and whose vertices and faces stand in random order, which is the hardest for the memory.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <random>

#include "hooke/io/read_mesh.h"
#include "hooke/io/write_mesh.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/mesh.h"

namespace hooke {
namespace {

struct Scene {
  Mat3X points, moved;
  std::vector<Triangle> faces;
  Adjacency adjacency;
};

Vec3 on_torus(double u, double v) {
  return {(1 + .4 * std::cos(v)) * std::cos(u), (1 + .4 * std::cos(v)) * std::sin(u), .4 * std::sin(v)};
}

/// Points of a 5 n x 2 n grid on a torus, each shaken by up to `noise` cells.
Mat3X torus_points(int n, double noise, const std::vector<int>& id, std::mt19937& random) {
  std::uniform_real_distribution<double> shake(-noise, noise);
  Mat3X points(3, 10 * n * n);
  for (int i = 0; i < 5 * n; ++i)
    for (int j = 0; j < 2 * n; ++j)
      points.col(id[2 * n * i + j]) = on_torus(2 * std::numbers::pi * (i + shake(random)) / (5 * n),
                                               std::numbers::pi * (j + shake(random)) / n);
  return points;
}

Scene make_scene(int vertices) {
  const int n = static_cast<int>(std::lround(std::sqrt(vertices / 10.)));
  std::mt19937 random(1);
  std::vector<int> id(10 * n * n);
  std::iota(id.begin(), id.end(), 0);
  std::shuffle(id.begin(), id.end(), random);
  Scene s;
  s.points = torus_points(n, .3, id, random);
  s.moved = torus_points(n, .3, id, random);
  const auto at = [&](int i, int j) { return id[2 * n * (i % (5 * n)) + j % (2 * n)]; };
  for (int i = 0; i < 5 * n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      s.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  std::shuffle(s.faces.begin(), s.faces.end(), random);
  s.adjacency = make_adjacency(static_cast<int>(s.points.cols()), s.faces);
  return s;
}

/// A file in the folder for temporary files, removed at the end of its scope.
struct TemporaryFile {
  explicit TemporaryFile(const std::string& ending)
      : path(std::filesystem::temp_directory_path() / ("hooke-bench" + ending)) {}
  ~TemporaryFile() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

struct Format {
  const char* ending;
  PlyEncoding encoding;
};
constexpr Format formats[] = {{".obj", PlyEncoding::ascii},
                              {".off", PlyEncoding::ascii},
                              {".ply", PlyEncoding::ascii},
                              {".ply", PlyEncoding::binary_little_endian}};

void write(benchmark::State& state, const Format& format) {
  const Scene s = make_scene(static_cast<int>(state.range(0)));
  const TriMesh mesh = build_mesh(s.points, s.adjacency);
  const TemporaryFile file(format.ending);
  for (auto _ : state) prepare_mesh(file.path, mesh, format_of(file.path), format.encoding).file.commit();
}

void read(benchmark::State& state, const Format& format) {
  const Scene s = make_scene(static_cast<int>(state.range(0)));
  const TemporaryFile file(format.ending);
  prepare_mesh(file.path, build_mesh(s.points, s.adjacency), format_of(file.path), format.encoding)
      .file.commit();
  for (auto _ : state) benchmark::DoNotOptimize(read_mesh(file.path));
}

void adjacency(benchmark::State& state) {
  const Scene s = make_scene(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(make_adjacency(static_cast<int>(s.points.cols()), s.faces));
}

void tree(benchmark::State& state) {
  const Scene s = make_scene(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(AabbTree(s.points, s.faces));
}

void quality(benchmark::State& state, bool self_intersections) {
  const Scene s = make_scene(static_cast<int>(state.range(0)));
  const MeasuredSurface surface(s.points, s.adjacency);
  for (auto _ : state)
    benchmark::DoNotOptimize(measure_quality(surface, {}, {.self_intersections = self_intersections}));
}

void deviation(benchmark::State& state) {
  const Scene s = make_scene(static_cast<int>(state.range(0)));
  const MeasuredSurface before(s.points, s.adjacency), after(s.moved, s.adjacency);
  for (auto _ : state) benchmark::DoNotOptimize(measure_deviation(before, after));
}

void with_sizes(benchmark::internal::Benchmark* b) {
  for (int vertices : {1000, 10000, 100000, 1000000}) b->Arg(vertices);
  b->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(read, obj, formats[0])->Apply(with_sizes);
BENCHMARK_CAPTURE(read, off, formats[1])->Apply(with_sizes);
BENCHMARK_CAPTURE(read, ply_ascii, formats[2])->Apply(with_sizes);
BENCHMARK_CAPTURE(read, ply_binary, formats[3])->Apply(with_sizes);
BENCHMARK_CAPTURE(write, obj, formats[0])->Apply(with_sizes);
BENCHMARK_CAPTURE(write, off, formats[1])->Apply(with_sizes);
BENCHMARK_CAPTURE(write, ply_ascii, formats[2])->Apply(with_sizes);
BENCHMARK_CAPTURE(write, ply_binary, formats[3])->Apply(with_sizes);
BENCHMARK(adjacency)->Apply(with_sizes);
BENCHMARK(tree)->Apply(with_sizes);
BENCHMARK_CAPTURE(quality, without_self_intersections, false)->Apply(with_sizes);
BENCHMARK_CAPTURE(quality, with_self_intersections, true)->Apply(with_sizes);
BENCHMARK(deviation)->Apply(with_sizes);

}  // namespace
}  // namespace hooke

BENCHMARK_MAIN();
