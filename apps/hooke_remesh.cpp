// hooke-remesh: reads a mesh, optimizes it, writes the result and reports its quality.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <new>
#include <utility>

#include "batch.h"
#include "exit_codes.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/stopwatch.h"
#include "hooke/io/read_mesh.h"
#include "hooke/measure/polygon_angles.h"
#include "hooke/mesh/mesh.h"
#include "hooke/report/paper_block.h"
#include "hooke/report/report.h"
#include "judging.h"
#include "kept_data.h"
#include "mesh_memory.h"
#include "messages.h"
#include "options.h"
#include "progress_bar.h"
#include "result_files.h"
#include "result_warnings.h"
#include "run_files.h"
#include "signals.h"
#include "stages.h"
#include "target_lengths.h"

namespace hooke::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Optimizes the mesh, measures the result and prepares its output files.
void make_result(const Settings& s, LoadedMesh& loaded, Original& original, RunRecord& record,
                 OutputFiles& files, RunProgress& progress, Stopwatch& stopwatch) {
  const Observer observer = [&](const Progress& p) {
    progress.show(p);
    return caught_signal() == 0;
  };
  remesh_and_measure(s, loaded.mesh, loaded.memory_order, original, record, observer, stopwatch);
  progress.enter("write");
  timed(&stopwatch, "data", [&] { carry_data(s, loaded, original, record); });
  Mat3X points = loaded.memory_order.order.gather(vertex_points(loaded.mesh));
  PendingMesh written = timed(&stopwatch, "write",
                              [&] { return prepare_output(s, loaded, original, points, record, stopwatch); });
  static_cast<FileRecord&>(*record.output) = {name_of_output(s.output), written.sha256, name_of(*s.format),
                                              written.connectivity_sha256};
  files.add(std::move(written.file));
  if (written.rounded.size() > 0 && written.rounded != vertex_points(loaded.mesh)) {
    measure_rounded(s, written.rounded, loaded.mesh, loaded.memory_order, original, record, stopwatch);
    points = loaded.memory_order.order.gather(vertex_points(loaded.mesh));
  }
  if (keeps_polygons(s, loaded))
    record.after->polygon_angles = measure_polygon_angles(vertex_points(loaded.mesh), loaded.polygons);
  if (!s.fields.empty()) files.add(PendingFile(s.fields, fields_text(loaded, points, original, record)));
  if (!s.map.empty())
    files.add(PendingFile(s.map, map_text(map_of_output(loaded.mesh, loaded.origin, record))));
  add_result_warnings(s, loaded.mesh, record);
}

/// Writes the remaining outputs, then commits all files, so that no file is replaced before everything that
/// can fail has succeeded. Prints the warnings and the summary.
void finish(const Settings& s, RunRecord& record, OutputFiles& files) {
  if (!s.trace.empty()) files.add(PendingFile(s.trace, trace_csv(record.stages)));
  if (!s.trace_steps.empty())
    files.add(PendingFile(s.trace_steps, time_steps_csv(record.result->time_steps)));
  if (s.report == "-")
    files.add(PendingFile::to_standard_output(report_text(record)));
  else if (!s.report.empty())
    files.add(PendingFile(s.report, report_text(record)));
  files.commit();
  if (!s.quiet)
    for (const Note& note : record.notes) print_note(note);
  for (const Note& repair : record.repairs) print_warning(repair);
  for (const Warning& w : record.warnings) print_warning(w);
  if (!s.quiet) print_summary(s, record);
  print_judgement(s, record);
}

int run(Settings s) {
  const auto start = Clock::now();
  const ThreadLimit threads(s.threads);
  require_outputs(s);
  const std::optional<ReportFigures> base = read_base(s);
  RunProgress progress(s);
  progress.enter("read");
  require_memory_for_file(s);
  Stopwatch stopwatch;
  LoadedMesh loaded = timed(&stopwatch, "read", [&] {
    return read_mesh(s.input, &stopwatch, {s.input_format, s.repair});
  });
  if (s.format == MeshFormat::msh && loaded.format == MeshFormat::msh2 && !s.format_given)
    s.format = MeshFormat::msh2;
  set_fixed_vertices(s, loaded.origin, loaded.memory_order.adjacency->vertex_count);

  RunRecord record;
  record.tool_version = HOOKE_VERSION;
  record.status = "checked";
  record.input = {name_of_input(s.input), loaded.sha256, name_of(loaded.format), loaded.connectivity_sha256};
  record.warnings = loaded.warnings;
  record.notes = loaded.notes;
  record.repairs = loaded.repairs;
  s.remesh.map |= !loaded.vertex_data.empty();
  record.connectivity = s.remesh.connectivity;
  record.parameters = parameters_of(s);
  const std::string obstacle = obstacle_to_preserving(s, loaded);
  record.parameters["preserve"] = s.preserve && obstacle.empty() ? "on" : "off";
  record.parameters["reproject_uv"] = s.reproject_uv ? "on" : "off";
  if (s.reproject_uv && (s.format != MeshFormat::obj || !obstacle.empty()))
    throw Error("--reproject-uv is of OBJ files that are preserved; " +
                (obstacle.empty() ? record.input.path + " is " + name_of(loaded.format) : obstacle));
  require_memory(s, loaded.mesh.n_vertices(), record);
  if (!s.check) timed(&stopwatch, "seams", [&] { keep_seams(s, loaded, record); });
  progress.enter("measure");
  timed(&stopwatch, "sizing", [&] {
    set_target_lengths(s, loaded.mesh, loaded.memory_order, loaded.origin, record);
    set_rest_ratios(s, loaded);
  });
  Original original;
  if (guards_polygons(s, loaded)) original.polygons = &loaded.polygons;
  measure_input(s, loaded.mesh, loaded.memory_order, original, record, stopwatch);
  if (keeps_polygons(s, loaded))
    record.before.polygon_angles = measure_polygon_angles(vertex_points(loaded.mesh), loaded.polygons);

  OutputFiles files;
  s.preservation.has_float_points = has_float_points(s, loaded);
  if (!s.check) make_result(s, loaded, original, record, files, progress, stopwatch);
  join_ids(loaded.mesh, loaded.origin, record);
  record.stages = stopwatch.stages();
  record.resources = resources_used(std::chrono::duration<double>(Clock::now() - start).count());
  judge(s, base, record);
  progress.clear();
  finish(s, record, files);
  if (caught_signal()) return 128 + caught_signal();
  return passes(record) ? done : gate_failed;
}

/// Opens /dev/null, read-only, for each standard stream that is closed. Otherwise the next file to be opened
/// would take its descriptor and receive its output.
void occupy_standard_streams() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDONLY) != stream) return;
}

}  // namespace
}  // namespace hooke::app

int main(int argc, char** argv) {
  using namespace hooke;
  using namespace hooke::app;
  occupy_standard_streams();
  catch_signals();
  const Parsed parsed = parse_command_line(argc, argv);
  if (!parsed.settings) return parsed.exit_code;
  const bool batch = is_batch(*parsed.settings);
  const bool answered_by_another = batch && parsed.settings->inputs.size() == 1;
  if (!parsed.settings->quiet && !answered_by_another) answer_signals();
  try {
    return batch ? run_batch(*parsed.settings) : run(*parsed.settings);
  } catch (const InputError& e) {
    print_error(e.what());
    return malformed_input;
  } catch (const MeshError& e) {
    print_error(e.what());
    return unacceptable_mesh;
  } catch (const OutputError& e) {
    print_error(e.what());
    return output_failed;
  } catch (const ResultError& e) {
    print_error(e.what());
    return promise_broken;
  } catch (const NumericalError& e) {
    print_error(e.what());
    return numerical_failure;
  } catch (const LimitError& e) {
    print_error(e.what());
    return limit_reached;
  } catch (const Error& e) {
    print_error(e.what());
    return usage;
  } catch (const std::bad_alloc&) {
    print_error(name_of_input(parsed.settings->input) +
                ": out of memory; expected a smaller mesh or more memory");
    return limit_reached;
  } catch (const std::exception& e) {
    print_error(name_of_input(parsed.settings->input) + ": internal error: " + e.what());
    return internal_error;
  }
}
