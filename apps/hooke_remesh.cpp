// hooke-remesh: reads a mesh, optimizes it, writes it, and says what was reached.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <new>

#include "exit_codes.h"
#include "hooke/error.h"
#include "hooke/io/atomic_write.h"
#include "hooke/io/format_data.h"
#include "hooke/io/id_list.h"
#include "hooke/io/map_text.h"
#include "hooke/io/printable.h"
#include "hooke/io/read_mesh.h"
#include "hooke/io/write_mesh.h"
#include "hooke/normals.h"
#include "hooke/parallel.h"
#include "hooke/quality_table.h"
#include "hooke/report.h"
#include "messages.h"
#include "options.h"
#include "signals.h"

namespace hooke::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Everything that can be known to fail before the work is done.
void require_outputs(const Settings& s) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& file : {s.output, std::filesystem::path(s.report), s.trace, s.map}) {
    if (file.empty() || file == "-") continue;
    require_distinct(s.input, file);
    for (const std::filesystem::path& other : files) require_distinct(other, file);
    require_writable(file);
    files.push_back(file);
  }
}

void write_report(const Settings& s, const RunRecord& run) {
  if (s.report.empty()) return;
  const std::string text = report_json(run).dump(2) + "\n";
  if (s.report != "-") return write_file_atomically(s.report, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw OutputError("standard output: the report was not written; expected an open reader");
}

/// Edges that do not follow the sizing: what a mode can reach on a mesh whose lengths vary by four.
void warn_of_sizing(const Settings& s, RunRecord& run) {
  const Statistics& error = run.after->length_error;
  const double rms = std::hypot(error.mean, error.std), most = [&] {
    switch (s.remesh.connectivity) {
      case ConnectivityMode::fixed:
        return .35;
      case ConnectivityMode::flip:
        return .25;
      default:
        return .15;
    }
  }();
  if (s.sizing.kind == SizingSource::Kind::none || rms <= most) return;
  const char* advice = s.remesh.connectivity == ConnectivityMode::adapt
                           ? "a smaller --gradation, or lengths that the boundary can take"
                           : "--connectivity adapt, or lengths nearer to those of the input";
  run.warnings.push_back(
      {"sizing_missed",
       fmt::format(
           "{}: the edges miss the lengths of the sizing by {:.0f} % (rms), expected at most {:.0f} % "
           "with these vertices and faces; use {}",
           run.output->path, 100 * rms, 100 * most, advice)});
}

/// What the result must not hide, and what the length means where it is out of reach.
void add_result_warnings(const Settings& s, RunRecord& run) {
  const RemeshResult& r = *run.result;
  if (const std::vector<int> folded = folded_faces(run); !folded.empty()) {
    std::string ids;
    for (size_t i = 0; i < folded.size() && i < 10; ++i) ids += fmt::format(" {}", folded[i]);
    run.warnings.push_back(
        {"folded_faces", fmt::format("{}: {} faces lie against the surface, or at folds that the input has "
                                     "(ids{}{}); look at them in the input",
                                     run.input.path, folded.size(), ids, folded.size() > 10 ? " ..." : "")});
  }
  const size_t crossings = run.after->self_intersections.value_or(0),
               before = run.before.self_intersections.value_or(0);
  if (crossings > before)
    run.warnings.push_back({"self_intersections_added", fmt::format("{}: {} self-intersections, {} before",
                                                                    run.output->path, crossings, before)});
  const double faces = run.after->topology.faces, wanted = r.adaptation.wanted_faces;
  if (r.adaptation.rounds > 0 && std::abs(faces - wanted) > std::max(3., .03 * wanted))
    run.warnings.push_back(
        {"face_count_missed",
         fmt::format(
             "{}: {} faces, where the target length asks for {:.0f}; edges that the surface, a boundary "
             "or a fixed vertex needs stay; use a smaller length",
             run.output->path, faces, wanted)});
  warn_of_sizing(s, run);
  if (s.paper && r.reason != StopReason::converged)
    run.warnings.push_back({"paper_jams", fmt::format("{}: {}", run.input.path, paper_message(r))});
}

/// `length` is the covering_length() of the targets.
void warn_of_length(const Settings& s, double length, double natural, RunRecord& run) {
  const double ratio = length / natural;
  if (ratio >= .9 && ratio <= 1.1) return;
  if (s.sizing.kind != SizingSource::Kind::none) {
    run.warnings.push_back(
        {"length_out_of_reach",
         fmt::format("{}: the lengths of the sizing ask for {:.2f} times the faces there are; the faces are "
                     "as many as "
                     "they are, so the edges can not get there and only pull or push; use -L auto",
                     printable(s.input.string()), 1 / (ratio * ratio))});
    return;
  }
  run.warnings.push_back(
      {"length_out_of_reach",
       fmt::format(
           "{}: the target length {:.6g} is {:.2f} times the natural length {:.6g}; the faces are as many as "
           "they are, so the edges can not get there and only pull or push; use -L auto, or a value within "
           "0.9x and 1.1x",
           printable(s.input.string()), length, ratio, natural)});
}

/// What the input told of its vertices, for those of the result: the same while vertices stay what they were,
/// else the values at their places. Normals are always those of the result.
VertexData data_of_result(const Settings& s, const LoadedMesh& loaded, const MeasuredSurface& result,
                          RunRecord& run) {
  const bool same_places = s.paper || s.remesh.connectivity == ConnectivityMode::fixed;
  FormatData carried = data_for_format(
      same_places ? loaded.vertex_data
                  : carry_over(loaded.vertex_data, run.result->map, loaded.connectivity.faces),
      loaded.format, s.format);
  set_normals(carried.data, vertex_normals(result.points, result.connectivity));
  if (!carried.left_out.empty())
    run.warnings.push_back({"attributes_not_kept",
                            fmt::format("{}: {} files cannot hold {}; use PLY", printable(s.output.string()),
                                        s.format, fmt::join(carried.left_out, ", "))});
  return std::move(carried.data);
}

/// Against the target lengths that the vertices have now.
Quality measure(const MeasuredSurface& surface, const TriMesh& mesh, Stopwatch& stopwatch) {
  const std::vector<double> lengths = vertex_values(mesh, target_length_property);
  return measure_quality(surface, spread_target_lengths(surface.connectivity, lengths).edge, {}, &stopwatch);
}

/// Gives the vertices their target lengths and tells what they are.
void set_target_lengths(const Settings& s, TriMesh& mesh, const Connectivity& connectivity,
                        RunRecord& record) {
  const Mat3X points = positions(mesh);
  const Sizing sizing{read_sizing(s.sizing, s.input, points, connectivity), s.gradation};
  const std::vector<double> lengths = resolve_vertex_lengths(s.length, sizing, points, connectivity);
  set_vertex_values(mesh, target_length_property, lengths);

  const TargetLengths targets = spread_target_lengths(connectivity, lengths);
  const double natural = resolve_length({}, points, connectivity);
  const auto [least, most] = std::ranges::minmax_element(lengths);
  record.parameters.update({{"L", mean_length(points, connectivity, targets)},
                            {"L_min", *least},
                            {"L_max", *most},
                            {"L_spec", s.length_text},
                            {"L_natural", natural},
                            {"sizing", s.sizing_text}});
  record.parameters["gradation"] =
      std::isfinite(s.gradation) ? nlohmann::ordered_json(s.gradation) : nlohmann::ordered_json();
  if (!s.check && s.remesh.connectivity != ConnectivityMode::adapt)
    warn_of_length(s, covering_length(points, connectivity, targets), natural, record);
}

RemeshResult optimize(const Settings& s, TriMesh& mesh, Stopwatch& stopwatch) {
  ProgressLine line(s);
  const Observer observer = [&](const Progress& p) {
    line.show(p);
    return caught_signal() == 0;
  };
  try {
    return s.paper ? paper_remesh(mesh, s.paper_options, observer)
                   : remesh(mesh, s.remesh, observer, &stopwatch);
  } catch (const MeshError& e) {
    throw MeshError(printable(s.input.string()) + ": " + e.what());
  }
}

int run(Settings s) {
  const auto start = Clock::now();
  const ThreadLimit threads(s.threads);
  require_outputs(s);
  Stopwatch stopwatch;
  LoadedMesh loaded = timed(&stopwatch, "read", [&] { return read_mesh(s.input, &stopwatch); });
  TriMesh& mesh = loaded.mesh;
  const Connectivity& connectivity = loaded.connectivity;
  if (!s.fix.empty())
    s.remesh.constraints.fixed_vertices = s.paper_options.constraints.fixed_vertices =
        read_id_list(s.fix, connectivity.vertex_count);
  const Mat3X original = positions(mesh);
  const auto surface_of = [&](const Mat3X& points, const Connectivity& c) {
    return timed(&stopwatch, "tree", [&] { return MeasuredSurface(points, c); });
  };

  RunRecord record;
  record.tool_version = HOOKE_VERSION;
  record.status = "checked";
  record.input = {printable(s.input.string()), loaded.sha256, loaded.format,
                  timed(&stopwatch, "sha256", [&] { return connectivity_sha256(connectivity.faces); })};
  record.warnings = loaded.warnings;
  s.remesh.map |= !loaded.vertex_data.empty();
  record.parameters = s.paper ? parameters_json(s.paper_options) : parameters_json(s.remesh);
  timed(&stopwatch, "sizing", [&] { set_target_lengths(s, mesh, connectivity, record); });
  {  // memory for the work: the surface is made again when it is needed again
    const MeasuredSurface surface = surface_of(original, connectivity);
    record.before = timed(&stopwatch, "before", [&] { return measure(surface, mesh, stopwatch); });
  }

  if (!s.check) {
    record.result = timed(&stopwatch, "remesh", [&] { return optimize(s, mesh, stopwatch); });
    if (!positions(mesh).allFinite())
      throw NumericalError(
          fmt::format("{}: the result is not finite; nothing was written", record.input.path));
    record.status = status_of(record.result->reason);
    const bool faces_kept = s.paper || s.remesh.connectivity == ConnectivityMode::fixed;
    const Connectivity changed =
        faces_kept ? Connectivity{}
                   : make_connectivity(static_cast<int>(mesh.n_vertices()), triangles_of(mesh));
    const Connectivity& after = faces_kept ? connectivity : changed;
    const MeasuredSurface result = surface_of(positions(mesh), after);
    record.after = timed(&stopwatch, "after", [&] { return measure(result, mesh, stopwatch); });
    if (!record.result->holds.empty())
      for (WorstFace& face : record.after->worst_faces) face.reasons = hindrances(face, record.result->holds);
    const MeasuredSurface reference = surface_of(original, connectivity);
    record.deviation =
        timed(&stopwatch, "deviation", [&] { return measure_deviation(reference, result, &stopwatch); });
    if (record.result->adaptation.rounds > 0) record.deviation->displacement.reset();  // other vertices
    const VertexData data = data_of_result(s, loaded, result, record);
    const WrittenFile written = timed(&stopwatch, "write", [&] {
      return write_mesh(s.output, mesh, s.format, loaded.encoding, data, &stopwatch);
    });
    record.output = {printable(s.output.string()), written.sha256, s.format,
                     faces_kept ? record.input.connectivity_sha256 : connectivity_sha256(after.faces)};
    if (!s.map.empty()) write_file_atomically(s.map, map_text(record.result->map));
    add_result_warnings(s, record);
  }
  record.stages = stopwatch.stages();
  record.resources = resources_used(std::chrono::duration<double>(Clock::now() - start).count());
  for (const Warning& w : record.warnings) print_warning(w);
  if (!s.quiet) print_summary(s, record);
  if (!s.trace.empty()) write_file_atomically(s.trace, trace_csv(record.stages));
  write_report(s, record);
  return caught_signal() ? 128 + caught_signal() : done;
}

}  // namespace
}  // namespace hooke::app

int main(int argc, char** argv) {
  using namespace hooke;
  using namespace hooke::app;
  const Parsed parsed = parse_command_line(argc, argv);
  if (!parsed.settings) return parsed.exit_code;
  catch_signals();
  try {
    return run(*parsed.settings);
  } catch (const InputError& e) {
    print_error(e.what());
    return malformed_input;
  } catch (const MeshError& e) {
    print_error(e.what());
    return unacceptable_mesh;
  } catch (const OutputError& e) {
    print_error(e.what());
    return output_failed;
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
    print_error(printable(parsed.settings->input.string()) +
                ": out of memory; expected a smaller mesh or more memory");
    return limit_reached;
  } catch (const std::exception& e) {
    print_error(printable(parsed.settings->input.string()) + ": internal error: " + e.what());
    return internal_error;
  }
}
