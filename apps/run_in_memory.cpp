#include "run_in_memory.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/io/sha256.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/preserving_remesh.h"
#include "memory_limit.h"
#include "result_warnings.h"
#include "target_lengths.h"

namespace hooke::app {
namespace {

class Run {
 public:
  Run(Settings settings, ValidMesh& mesh, const Observer& observer)
      : s_(std::move(settings)), mesh_(mesh.mesh), memory_order_(mesh.memory_order), observer_(observer) {
    s_.remesh.filter.memory_limit_bytes = s_.paper_options.filter.memory_limit_bytes = memory_limit();
    if (!s_.fix.empty())
      s_.remesh.constraints.fixed_vertices = s_.paper_options.constraints.fixed_vertices =
          read_id_list(s_.fix, memory_order_.adjacency->vertex_count);
    record_.tool_version = HOOKE_VERSION;
    record_.status = "checked";
    record_.input = {input_name, "", "", connectivity_sha256(triangles_of(mesh_))};
    record_.warnings = mesh.warnings;
    record_.parameters = s_.paper ? parameters_json(s_.paper_options) : parameters_json(s_.remesh, s_.effort);
    record_.parameters.update({{"repair", s_.repair.repair},
                               {"weld", s_.weld_text},
                               {"drop_components", s_.repair.drop_components},
                               {"fill_holes", s_.repair.fill_holes},
                               {"preserve", nullptr},  // of files
                               {"reproject_uv", nullptr}});
  }

  RunRecord run() {
    const auto start = std::chrono::steady_clock::now();
    measure_input();
    if (!s_.check) {
      optimize();
      measure_result();
    }
    record_.stages = stopwatch_.stages();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    record_.resources = resources_used(seconds.count());
    record_.gates = judge_gates(s_.gates, report_json(record_));
    return std::move(record_);
  }

 private:
  UniformVector edge_lengths() const {
    return target_lengths_of(mesh_, memory_order_.order, *memory_order_.adjacency).edge;
  }

  Mat3X points() const { return memory_order_.order.gather(vertex_points(mesh_)); }

  PaperFigures paper_figures() const {
    return measure_paper_figures(points(), *memory_order_.adjacency, edge_lengths(), s_.paper);
  }

  MeasuredSurface surface_of(Mat3X points, const MemoryOrder& memory_order) const {
    return {std::move(points), *memory_order.adjacency, memory_order.order.old_ids(), tree_order_};
  }

  void measure_input() {
    if (!s_.check)
      warn_of_coincident_boundary(s_, coincident_boundary_vertices(points(), *memory_order_.adjacency).size(),
                                  record_);
    timed(&stopwatch_, "seams", [&] { warn_of_near_boundary(points(), *memory_order_.adjacency, record_); });
    timed(&stopwatch_, "sizing",
          [&] { set_target_lengths(s_, mesh_, memory_order_, {}, points(), record_); });
    record_.paper_before = paper_figures();
    const MeasuredSurface surface = surface_of(points(), memory_order_);
    record_.before = timed(&stopwatch_, "before",
                           [&] { return measure_quality(surface, edge_lengths(), {}, &stopwatch_); });
    warn_of_inside_out(record_);
    require_metrics(s_.gates, to_json(record_.before));
    tree_order_ = surface.tree.order();
    if (s_.max_distance_share > 0)
      s_.preservation.max_distance = s_.max_distance_share * record_.before.extent.diagonal;
  }

  void optimize() {
    const bool keeps_faces = s_.paper || s_.remesh.connectivity == ConnectivityMode::fixed;
    if (!keeps_faces) input_order_ = memory_order_;
    record_.result = timed(&stopwatch_, "remesh", [&] {
      return s_.paper ? paper_remesh(mesh_, std::move(memory_order_), s_.paper_options, observer_)
                      : preserving_remesh(mesh_, std::move(memory_order_), s_.remesh, s_.preservation,
                                          {&record_.before, tree_order_}, observer_, &stopwatch_);
    });
    return_free_memory();
    memory_order_ = std::move(record_.result->memory_order);
    if (keeps_faces) input_order_ = memory_order_;
    record_.status = status_of(record_.result->reason);
    if (!vertex_points(mesh_).allFinite())
      throw NumericalError(std::string(input_name) + ": the result is not finite");
  }

  void measure_result() {
    RemeshResult& done = *record_.result;
    if (done.measures) {
      record_.before = std::move(done.measures->input_quality);
      record_.after = std::move(done.measures->quality);
      record_.deviation = std::move(done.measures->deviation);
    } else {
      const MeasuredSurface result = surface_of(points(), memory_order_);
      record_.after = measure_quality(result, edge_lengths(), {}, &stopwatch_);
      const MeasuredSurface reference =
          surface_of(input_order_.order.gather(done.input_points), input_order_);
      record_.deviation = measure_deviation(reference, result, &stopwatch_);
    }
    if (done.adaptation.rounds > 0) record_.deviation->displacement.reset();  // vertices do not correspond
    record_.paper_after = paper_figures();
    record_.output = {result_name, "", "", connectivity_sha256(triangles_of(mesh_))};
    require_promises();
    if (!done.vertex_limits.empty())
      for (WorstFace& face : record_.after->worst_faces)
        face.reasons = limiting_factors(face, done.vertex_limits);
    add_result_warnings(s_, record_);
  }

  void require_promises() const {
    if (s_.accept_invalid || record_.result->reason == StopReason::interrupted) return;
    const std::string broken = broken_promises(s_, record_);
    if (!broken.empty()) throw ResultError(std::string(result_name) + ": " + broken);
  }

  Settings s_;
  const ThreadLimit threads_{s_.threads};
  TriMesh& mesh_;
  MemoryOrder& memory_order_;  // of the mesh as it is now
  MemoryOrder input_order_;
  std::vector<int> tree_order_;
  const Observer& observer_;
  RunRecord record_;
  Stopwatch stopwatch_;
};

}  // namespace

Settings memory_settings(std::vector<std::string> options) {
  if (std::ranges::find(options, "--check") == options.end())
    options.insert(options.end(), {"--output", result_name, "--format", "ply"});
  options.emplace_back(input_name);
  return parse_arguments(std::move(options));
}

RunRecord run_in_memory(Settings settings, ValidMesh& mesh, const Observer& observer) {
  return Run(std::move(settings), mesh, observer).run();
}

nlohmann::ordered_json report_of_memory(const RunRecord& record) {
  nlohmann::ordered_json report = report_json(record);
  for (const char* mesh : {"input", "output"})
    if (report[mesh].is_object())
      for (const char* key : {"path", "sha256", "format", "preserved"})
        if (report[mesh].contains(key)) report[mesh][key] = nullptr;
  return report;
}

}  // namespace hooke::app
