// The JSON report of a run, schema hooke-remesh/report/1: parameters, measures of the input and the result,
// iterations and resources. Degrees, file units, 0-based ids; `null` for what does not exist. Values that
// vary from run to run stand only under `resources` and in keys that end in _s.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>

#include "hooke/core/stopwatch.h"
#include "hooke/measure/deviation.h"
#include "hooke/measure/quality.h"
#include "hooke/remesh/result.h"
#include "hooke/report/comparison.h"
#include "hooke/report/gates.h"
#include "hooke/report/paper_block.h"

namespace hooke {

struct PaperOptions;
struct RemeshOptions;

/// {min, mean, max}; null for what does not exist.
nlohmann::ordered_json to_json(const Range& range);

/// {min, p01, p05, median, mean, p95, max, std, histogram: {edges, counts}, non_finite}; the figures and the
/// histogram are null if there was no finite value.
nlohmann::ordered_json to_json(const Statistics& statistics);

/// The blocks `before` and `after`.
nlohmann::ordered_json to_json(const Quality& quality);

/// The block `geometry`.
nlohmann::ordered_json to_json(const Deviation& deviation);

/// The figures of the mesh itself in the blocks `input` and `output`, from `vertices` to `volume`.
nlohmann::ordered_json to_json(const Topology& topology, const Extent& extent);

/// A mesh file and the mesh in it.
struct FileRecord {
  std::string path;
  std::string sha256;  // of the bytes of the file
  std::string format;
  std::string connectivity_sha256;
};

/// The output; `preserved`: it is the input file with other coordinates, all else as it was.
struct OutputRecord : FileRecord {
  bool preserved = false;
};

struct Resources {
  int threads = 0;
  double wall_s = 0;
  double cpu_s = 0;
  long long peak_rss_bytes = 0;
};

/// The resources that the process has used so far.
Resources resources_used(double wall_seconds);

/// The target lengths of the edges, in file units.
struct TargetRecord {
  double mean = 0;
  double min = 0;
  double max = 0;
  double natural = 0;  // that of --length auto
  double faces = 0;    // that the lengths ask for; 0: as the mean does
};

/// The contents of a report. Parts that a run did not produce stay empty.
struct RunRecord {
  std::string tool_version;
  std::string status;  // see status_of()
  FileRecord input;
  std::optional<OutputRecord> output;
  ConnectivityMode connectivity = ConnectivityMode::fixed;
  TargetRecord target;
  nlohmann::ordered_json parameters;  // see parameters_json(); those that are missing have no part in the run
  Quality before;
  std::optional<Quality> after;
  PaperFigures paper_before;
  std::optional<PaperFigures> paper_after;
  std::optional<Deviation> deviation;
  std::optional<RemeshResult> result;
  Notes notes;         // what reading the file did to it, as it always does
  Notes repairs;       // what was mended as asked
  int seam_edges = 0;  // edges of the input that are kept as seams
  std::vector<GateOutcome> gates;
  std::optional<Comparison> comparison;  // with an older report
  Warnings warnings;
  std::vector<StageTime> stages;
  Resources resources;
};

/// "converged", "stalled", "jammed", "iteration_limit" or "interrupted".
std::string status_of(StopReason reason);

/// The whole report, with every key of report_keys.h.
nlohmann::ordered_json report_json(const RunRecord& run);

/// The report as indented text. Bytes that are not UTF-8 are replaced.
std::string report_text(const RunRecord& run);

/// The effective parameters of a run for its report, `null` for those without effect.
nlohmann::ordered_json parameters_json(const RemeshOptions& options);
/// The same for paper_remesh().
nlohmann::ordered_json parameters_json(const PaperOptions& options);

}  // namespace hooke
