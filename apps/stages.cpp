#include "stages.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "hooke/constraints/constraints.h"
#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/core/stopwatch.h"
#include "hooke/io/read_mesh.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/io/write_mesh.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/paper_mode.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/report/paper_block.h"
#include "hooke/springs/sizing.h"
#include "memory_limit.h"
#include "mesh_memory.h"
#include "result_warnings.h"
#include "target_lengths.h"

namespace hooke::app {

bool keeps_faces(const Settings& s) {
  return s.paper || s.remesh.connectivity == ConnectivityMode::fixed;
}

namespace {

/// As --keep takes it.
std::string text_of(const Settings& s) {
  std::vector<const char*> words;
  if (s.keep.texture) words.push_back("seams");
  if (s.keep.hard_edges) words.push_back("hard-edges");
  if (s.keep.materials) words.push_back("materials");
  if (s.keep.groups) words.push_back("groups");
  if (s.repair.keep_junctions) words.push_back("non-manifold");
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ","));
}

}  // namespace

nlohmann::ordered_json parameters_of(const Settings& s) {
  nlohmann::ordered_json parameters = s.paper ? parameters_json(s.paper_options) : parameters_json(s.remesh);
  parameters.update({{"repair", s.repair.repair},
                     {"weld", s.weld_text},
                     {"drop_components", s.repair.drop_components},
                     {"fill_holes", s.repair.fill_holes},
                     {"keep", nullptr}});
  if (!keeps_faces(s) || s.repair.keep_junctions) parameters["keep"] = text_of(s);
  if (s.time_limit > 0) parameters["time_limit"] = s.time_limit;
  if (s.paper) return parameters;
  parameters["accept_invalid"] = s.accept_invalid;
  const double distance = s.preservation.max_distance.value_or(s.max_distance_share);
  parameters["distance_limit"] = distance == 0 ? "curvature" : std::isinf(distance) ? "off" : "given";
  if (s.preservation.max_distance && std::isfinite(distance)) parameters["max_distance"] = distance;
  return parameters;
}

namespace {

/// `joined`: in memory order, see mesh/junctions.h.
MeasuredSurface surface_of(Mat3X points, const MemoryOrder& memory_order, std::vector<int> joined,
                           Stopwatch& stopwatch, const std::vector<int>& tree_order = {}) {
  return timed(&stopwatch, "tree", [&] {
    return MeasuredSurface(std::move(points), *memory_order.adjacency, memory_order.order.old_ids(),
                           tree_order, std::move(joined));
  });
}

UniformVector edge_targets(const TriMesh& mesh, const MemoryOrder& memory_order) {
  return target_lengths_of(mesh, memory_order.order, *memory_order.adjacency).edge;
}

/// The same without the ratios of quadrilaterals, which the paper does not have.
UniformVector paper_targets(const TriMesh& mesh, const MemoryOrder& memory_order) {
  OpenMesh::EPropHandleT<double> ratios;
  if (!mesh.get_property_handle(ratios, rest_ratio_property)) return edge_targets(mesh, memory_order);
  const std::vector<double> lengths = vertex_values(mesh, target_length_property);
  return spread_target_lengths(*memory_order.adjacency, memory_order.order.gather(lengths)).edge;
}

/// Returns work(). Puts the name of the input in front of the messages of its errors.
template <typename Work>
auto in_the_name_of(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const MeshError& e) {
    throw MeshError(name + ": " + e.what());
  } catch (const LimitError& e) {
    throw LimitError(name + ": " + e.what());
  } catch (const NumericalError& e) {
    throw NumericalError(name + ": " + e.what());
  } catch (const ResultError& e) {
    throw ResultError(name + ": " + e.what());
  }
}

/// Measures the result and its deviation from the input; anew what it keeps of that, where that was measured.
void measure_result(const Settings& s, const TriMesh& mesh, const MemoryOrder& memory_order,
                    const Original& original, RunRecord& record, Stopwatch& stopwatch) {
  const MeasuredSurface result = surface_of(memory_order.order.gather(vertex_points(mesh)), memory_order,
                                            joined_vertices(mesh, memory_order.order), stopwatch,
                                            keeps_faces(s) ? original.tree_order : std::vector<int>());
  const MeasuredSurface input =
      surface_of(original.points, original.memory_order, original.joined, stopwatch, original.tree_order);
  record.after = timed(&stopwatch, "after", [&] {
    return measure_quality(result, edge_targets(mesh, memory_order), {}, &stopwatch);
  });
  record.deviation =
      timed(&stopwatch, "deviation", [&] { return measure_deviation(input, result, &stopwatch); });
  if (!record.result->measures) return;
  ResultMeasures& measures = *record.result->measures;
  const std::vector<Edge> before = original.memory_order.order.new_edges(record.result->input_creases),
                          after = memory_order.order.new_edges(record.result->crease_edges);
  apply_creases(*record.after, result, after);
  measures.preservation = timed(&stopwatch, "preservation", [&] {
    return measure_preservation({input, record.before, before}, {result, *record.after, after},
                                *record.deviation, measures.judged_by);
  });
}

/// Throws ResultError, or LimitError at the end of the time, if the result does not keep what it must keep
/// and is not accepted nevertheless.
void require_promises(const Settings& s, const RunRecord& record, BrokenBy cause) {
  const bool is_out_of_time = record.status == "time_limit";
  if (s.accept_invalid || (record.result->reason == StopReason::interrupted && !is_out_of_time)) return;
  const std::string broken = broken_promises(s, record, cause);
  if (is_out_of_time && cause == BrokenBy::method && !broken.empty())
    throw LimitError(fmt::format("{}: no valid mesh within --time-limit {:g}: {}", name_of_input(s.input),
                                 s.time_limit, broken));
  if (!broken.empty())
    throw ResultError(fmt::format("{}: its result would break a promise, {} was not written: {}",
                                  name_of_input(s.input), name_of_output(s.output), broken));
}

/// After either measurement of the result: the figures of the paper, the promises, and what limits angles.
void judge_result(const Settings& s, const TriMesh& mesh, const MemoryOrder& memory_order, BrokenBy cause,
                  RunRecord& record) {
  record.paper_after =
      measure_paper_figures(memory_order.order.gather(vertex_points(mesh)), *memory_order.adjacency,
                            paper_targets(mesh, memory_order), s.paper);
  if (record.result->adaptation.rounds > 0)
    record.deviation->displacement.reset();  // vertices do not correspond
  require_promises(s, record, cause);
  if (record.result->vertex_limits.empty()) return;
  for (WorstFace& face : record.after->worst_faces)
    face.reasons = limiting_factors(face, record.result->vertex_limits);
}

}  // namespace

void set_fixed_vertices(Settings& s, const MeshOrigin& origin, int vertices) {
  std::vector<int>& fixed = s.remesh.constraints.fixed_vertices;
  const bool repaired = !origin.vertex.empty();
  if (!s.fix.empty())
    fixed = read_id_list(s.fix, repaired ? static_cast<int>(origin.merged.size()) : vertices);
  int lost = -1;
  if (repaired) fixed = vertices_from(origin, fixed, &lost);
  const auto problem = [&](const std::string& list, const char* remedy) {
    return fmt::format("{}: vertex {} was dropped in the repair; expected one that is left; {}", list, lost,
                       remedy);
  };
  if (lost >= 0 && s.fix.empty()) throw Error(problem("fix", "leave it out"));
  if (lost >= 0) throw InputError(problem(printable(s.fix.string()), "remove its line"));
  s.paper_options.constraints.fixed_vertices = fixed;
}

namespace {

/// The boundary vertices that share their place with another, those of junctions left out.
std::size_t count_coincident(const Mat3X& points, const Adjacency& c, const std::vector<int>& joined) {
  const std::vector<int> coincident = coincident_boundary_vertices(points, c);
  const std::vector<int> known = find_junctions(c, joined).vertices;
  return std::ranges::count_if(coincident, [&](int v) { return !std::ranges::binary_search(known, v); });
}

}  // namespace

void measure_input(Settings& s, const TriMesh& mesh, const MemoryOrder& memory_order, Original& original,
                   RunRecord& record, Stopwatch& stopwatch) {
  Mat3X points = memory_order.order.gather(vertex_points(mesh));
  original.joined = joined_vertices(mesh, memory_order.order);
  if (!s.check)
    warn_of_coincident_boundary(s, count_coincident(points, *memory_order.adjacency, original.joined),
                                record);
  timed(&stopwatch, "boundary", [&] {
    warn_of_near_boundary(points, *memory_order.adjacency, record);
    warn_of_cracks(s, points, *memory_order.adjacency, record);
  });
  set_min_length(s, mesh, memory_order, points, record);
  const UniformVector targets = edge_targets(mesh, memory_order);
  record.paper_before =
      measure_paper_figures(points, *memory_order.adjacency, paper_targets(mesh, memory_order), s.paper);
  const MeasuredSurface surface = surface_of(std::move(points), memory_order, original.joined, stopwatch);
  record.before =
      timed(&stopwatch, "before", [&] { return measure_quality(surface, targets, {}, &stopwatch); });
  warn_of_inside_out(record);
  warn_of_junctions(s, !original.joined.empty(), record);
  original.tree_order = surface.tree.order();
  s.remesh.filter.memory_limit_bytes = s.paper_options.filter.memory_limit_bytes = memory_allowed(s);
  require_memory(s, mesh.n_vertices(), record);
  if (s.max_distance_share > 0)
    record.parameters["max_distance"] =
        s.preservation.max_distance.emplace(s.max_distance_share * record.before.extent.diagonal);
}

void remesh_and_measure(const Settings& s, TriMesh& mesh, MemoryOrder& memory_order, Original& original,
                        RunRecord& record, const Observer& observer, Stopwatch& stopwatch) {
  const std::string name = name_of_input(s.input);
  if (!keeps_faces(s)) original.memory_order = memory_order;
  bool is_out_of_time = false;
  const Observer limited = [&](const Progress& p) {
    if (observer && !observer(p)) return false;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - s.started;
    is_out_of_time = s.time_limit > 0 && elapsed.count() > s.time_limit;
    return !is_out_of_time;
  };
  record.result = timed(&stopwatch, "remesh", [&] {
    return in_the_name_of(name, [&] {
      RemeshResult result = s.paper
                                ? paper_remesh(mesh, std::move(memory_order), s.paper_options, limited)
                                : preserving_remesh(mesh, std::move(memory_order), s.remesh, s.preservation,
                                                    {&record.before, original.tree_order, original.polygons},
                                                    limited, &stopwatch);
      join_sheets(mesh);  // throws if they have come apart
      return result;
    });
  });
  return_free_memory();
  RemeshResult& done = *record.result;
  memory_order = std::move(done.memory_order);
  if (keeps_faces(s)) original.memory_order = memory_order;
  original.points = original.memory_order.order.gather(std::exchange(done.input_points, {}));
  if (!vertex_points(mesh).allFinite())
    throw NumericalError(fmt::format("{}: the result is not finite; nothing was written", name));
  is_out_of_time &= done.reason == StopReason::interrupted;
  record.status = is_out_of_time ? "time_limit" : status_of(done.reason);
  if (done.measures) {
    record.before = std::move(done.measures->input_quality);
    record.after = std::move(done.measures->quality);
    record.deviation = std::move(done.measures->deviation);
  } else {
    measure_result(s, mesh, memory_order, original, record, stopwatch);
  }
  judge_result(s, mesh, memory_order, BrokenBy::method, record);
}

void measure_rounded(const Settings& s, const Mat3X& rounded, TriMesh& mesh, const MemoryOrder& memory_order,
                     const Original& original, RunRecord& record, Stopwatch& stopwatch) {
  vertex_points(mesh) = rounded;
  measure_result(s, mesh, memory_order, original, record, stopwatch);
  judge_result(s, mesh, memory_order, BrokenBy::rounding, record);
}

}  // namespace hooke::app
