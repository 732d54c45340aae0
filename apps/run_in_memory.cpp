#include "run_in_memory.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/io/sha256.h"
#include "hooke/mesh/junctions.h"
#include "judging.h"
#include "result_files.h"
#include "result_warnings.h"
#include "stages.h"
#include "target_lengths.h"

namespace hooke::app {
namespace {

/// Of the joined mesh.
std::string hash_of_faces(const TriMesh& mesh) {
  const std::optional<JoinedMesh> joined = join_sheets(mesh);
  return connectivity_sha256(joined ? joined->triangles : triangles_of(mesh));
}

}  // namespace

Settings memory_settings(std::vector<std::string> options) {
  if (std::ranges::find(options, "--check") == options.end())
    options.insert(options.end(), {"--output", result_name, "--format", "ply"});
  options.emplace_back(input_name);
  return parse_arguments(std::move(options));
}

RunRecord run_in_memory(Settings s, ValidMesh& mesh, const Observer& observer) {
  const auto start = std::chrono::steady_clock::now();
  const ThreadLimit threads(s.threads);
  const std::optional<ReportFigures> base = read_base(s);
  set_fixed_vertices(s, mesh.origin, mesh.memory_order.adjacency->vertex_count);
  RunRecord record;
  record.tool_version = HOOKE_VERSION;
  record.status = "checked";
  record.input = {input_name, "", "", hash_of_faces(mesh.mesh)};
  record.warnings = mesh.warnings;
  record.repairs = mesh.repairs;
  record.connectivity = s.remesh.connectivity;
  record.parameters = parameters_of(s);
  for (const char* of_files : {"preserve", "reproject_uv", "keep"}) record.parameters[of_files] = nullptr;
  if (s.repair.keep_junctions) record.parameters["keep"] = "non-manifold";
  Stopwatch stopwatch;
  Original original;
  timed(&stopwatch, "sizing",
        [&] { set_target_lengths(s, mesh.mesh, mesh.memory_order, mesh.origin, record); });
  measure_input(s, mesh.mesh, mesh.memory_order, original, record, stopwatch);
  if (!s.check) {
    remesh_and_measure(s, mesh.mesh, mesh.memory_order, original, record, observer, stopwatch);
    record.output = {{result_name, "", "", hash_of_faces(mesh.mesh)}, false};
    add_result_warnings(s, mesh.mesh, record);
  }
  join_ids(mesh.mesh, mesh.origin, record);
  record.stages = stopwatch.stages();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  record.resources = resources_used(seconds.count());
  judge(s, base, record);
  return record;
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
