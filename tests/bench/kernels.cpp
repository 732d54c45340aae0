// Time of the kernels in which a run spends its time, per vertex or face of a jittered sphere.
#include <benchmark/benchmark.h>

#include <numeric>

#include "hooke/constraints/constraints.h"
#include "hooke/core/parallel.h"
#include "hooke/filter/retraction.h"
#include "hooke/filter/surface_field.h"
#include "hooke/integrator/gauss_seidel.h"
#include "hooke/integrator/guards.h"
#include "hooke/integrator/relaxation.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/vertex_coloring.h"
#include "hooke/springs/energy.h"
#include "hooke/springs/forces.h"
#include "hooke/springs/hooke_law.h"
#include "hooke/springs/target_lengths.h"
#include "hooke/working_mesh/vertex_table.h"
#include "support/solids.h"

namespace hooke {
namespace {

/// 10 * 4^level vertices with all that a relaxation works on.
struct Sphere {
  explicit Sphere(int levels)
      : start(test::sphere(levels, .35, 7)),
        adjacency(std::make_shared<const Adjacency>(
            make_adjacency(static_cast<int>(start.points.cols()), start.faces))) {
    length.assign(start.points.cols(),
                  natural_length(total_area(start.points, start.faces), start.faces.size()));
    targets = spread_target_lengths(*adjacency, length);
    constraints = find_constraints(start.points, *adjacency, {});
    std::vector<int> hints(length.size());
    std::iota(hints.begin(), hints.end(), 0);
    positions = retraction.project_all(start.points, hints, constraints.segment);
  }

  Relaxation relaxation() {
    return {*adjacency, coloring, targets, vertices, retraction, {}, guards.limits()};
  }

  test::Triangles start;
  std::shared_ptr<const Adjacency> adjacency;
  VertexTable vertices;
  std::vector<double>& length = vertices.vertex_length;
  SurfacePositions& positions = vertices.positions;
  Constraints& constraints = vertices.constraints;
  VertexColoring coloring = color_vertices(*adjacency);
  TargetLengths targets;
  SurfaceField field{std::make_shared<const Mat3X>(start.points), adjacency};
  Retraction retraction{field.surface(), constraints, {}};
  Energy energy{*adjacency, targets, {}};
  Guards guards{*adjacency, targets, {}};
};

void per_item(benchmark::State& state, size_t items) {
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(items));
}

void energy_and_gradient(benchmark::State& state) {
  Sphere s(static_cast<int>(state.range(0)));
  Mat3X gradient;
  for (auto _ : state) benchmark::DoNotOptimize(s.energy(s.positions.points, s.positions.normals, &gradient));
  per_item(state, s.adjacency->faces.size());
}

/// String forces by the circulators of OpenMesh, in the order of a file and in memory order, and by flat
/// arrays.
void forces_by_circulators(benchmark::State& state) {
  const Sphere s(static_cast<int>(state.range(0)));
  const test::Triangles in_file = test::shuffled(s.start);
  const TriMesh mesh = state.range(1) ? build_mesh(s.start.points, *s.adjacency) : test::to_mesh(in_file);
  Mat3X forces(3, static_cast<Eigen::Index>(mesh.n_vertices()));
  for (auto _ : state) {
    for (const auto v : mesh.vertices()) {
      Vec3 sum = Vec3::Zero();
      for (const auto w : mesh.vv_range(v)) {
        const Vec3 way = mesh.point(w) - mesh.point(v);
        const double l = way.norm();
        sum += spring_potential(l, s.length[0]).slope / l * way;
      }
      forces.col(v.idx()) = sum;
    }
    benchmark::DoNotOptimize(forces.data());
  }
  per_item(state, s.length.size());
}

void forces_by_arrays(benchmark::State& state) {
  const Sphere s(static_cast<int>(state.range(0)));
  const ThreadLimit one_thread(1);
  const std::vector<double> lengths = s.targets.edge.values();
  Mat3X forces(3, s.start.points.cols());
  for (auto _ : state) {
    string_forces(s.start.points, *s.adjacency, lengths, forces);
    benchmark::DoNotOptimize(forces.data());
  }
  per_item(state, s.length.size());
}

void guards_of_all(benchmark::State& state) {
  Sphere s(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(s.guards.offenders(s.positions, s.positions));
  per_item(state, s.adjacency->faces.size());
}

void ring_curvature(benchmark::State& state) {
  Sphere s(static_cast<int>(state.range(0)));
  Relaxation r = s.relaxation();
  LocalNewton newton(r);
  for (auto _ : state)
    for (int v = 0; v < s.adjacency->vertex_count; ++v) benchmark::DoNotOptimize(newton.curvature(v));
  per_item(state, s.length.size());
}

void newton_sweep(benchmark::State& state) {
  Sphere s(static_cast<int>(state.range(0)));
  const SurfacePositions start = s.positions;
  Relaxation r = s.relaxation();
  for (auto _ : state) {
    s.positions = start;
    benchmark::DoNotOptimize(local_newton_sweep(r, {}, {}));
  }
  per_item(state, s.length.size());
}

void projection(benchmark::State& state) {
  const Sphere s(static_cast<int>(state.range(0)));
  for (auto _ : state)
    for (int v = 0; v < s.adjacency->vertex_count; ++v)
      benchmark::DoNotOptimize(s.field.project(1.01 * s.start.points.col(v), v, 1e-6 * s.length[0]));
  per_item(state, s.length.size());
}

void field_fit(benchmark::State& state) {
  const Sphere s(static_cast<int>(state.range(0)));
  const auto points = std::make_shared<const Mat3X>(s.start.points);
  for (auto _ : state) benchmark::DoNotOptimize(SurfaceField(points, s.adjacency));
  per_item(state, s.length.size());
}

void sweep_plan(benchmark::State& state) {
  const Sphere s(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(color_vertices(*s.adjacency));
  per_item(state, s.length.size());
}

BENCHMARK(energy_and_gradient)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(forces_by_circulators)->ArgsProduct({{7}, {0, 1}})->Unit(benchmark::kMillisecond);
BENCHMARK(forces_by_arrays)->Arg(7)->Unit(benchmark::kMillisecond);
BENCHMARK(guards_of_all)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(ring_curvature)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(newton_sweep)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(projection)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(field_fit)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK(sweep_plan)->Arg(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hooke
