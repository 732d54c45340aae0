// The measured figures as JSON, for the report. Degrees, file units, 0-based ids; `null` for what does not
// exist.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"
#include "hooke/remesh/result.h"

namespace hooke {

struct RestartOptions;
struct PaperOptions;
struct RemeshOptions;

/// {min, p01, p05, median, mean, p95, max, std, histogram: {edges, counts}, non_finite}; the figures and the
/// histogram are null when there was no finite number.
nlohmann::ordered_json to_json(const Statistics& statistics);

/// The blocks `before` and `after`.
nlohmann::ordered_json to_json(const Quality& quality);

/// The block `geometry`.
nlohmann::ordered_json to_json(const Deviation& deviation);

/// The figures of the mesh itself in the blocks `input` and `output`, from `vertices` to `volume`.
nlohmann::ordered_json to_json(const Topology& topology, const Extent& extent);

// The JSON report of a run: what went in, what came out, and what the way cost. Schema hooke-remesh/report/1:
// degrees, file units, 0-based ids; `null` for what does not exist. What varies from run to run stands only
// under `resources` and in keys that end in _s.

/// A mesh file and the mesh in it.
struct FileRecord {
  std::string path;
  std::string sha256;  // of the bytes
  std::string format;
  std::string connectivity_sha256;
};

struct Resources {
  int threads = 0;
  double wall_s = 0;
  double cpu_s = 0;
  long long peak_rss_bytes = 0;
};

/// What the process has used so far.
Resources resources_used(double wall_seconds);

/// All that a report tells. What a run has not done stays empty.
struct RunRecord {
  std::string tool_version;
  std::string status;  // see status_of()
  FileRecord input;
  std::optional<FileRecord> output;
  nlohmann::ordered_json parameters;  // see parameters_json.h
  Quality before;
  std::optional<Quality> after;
  std::optional<Deviation> deviation;
  std::optional<RemeshResult> result;
  Warnings warnings;
  std::vector<StageTime> stages;
  Resources resources;
};

/// "converged", "stalled", "iteration_limit" or "interrupted".
std::string status_of(StopReason reason);

/// Ids, ascending, of the result's faces that lie against the surface, by the optimizer's measure or by the
/// deviation's, or at folds of the input. Pre-condition: the run has a result and a deviation.
std::vector<int> folded_faces(const RunRecord& run);

nlohmann::ordered_json report_json(const RunRecord& run);

/// The report as a text. What is not UTF-8 in names is replaced.
std::string report_text(const RunRecord& run);

// The parameters of a run, for its report.

/// Every effective value of a run, `null` for what has no effect in it. `effort` is what the options were set
/// for.
nlohmann::ordered_json parameters_json(const RemeshOptions& options, const RestartOptions& restarts,
                                       Effort effort);
nlohmann::ordered_json parameters_json(const PaperOptions& options);

}  // namespace hooke
