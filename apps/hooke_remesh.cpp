// hooke-remesh: reads a mesh, optimizes it, writes the result and reports its quality.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <new>
#include <utility>

#include "exit_codes.h"
#include "hooke/constraints/constraints.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"
#include "hooke/core/stopwatch.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/ply.h"
#include "hooke/io/preserve.h"
#include "hooke/io/read_mesh.h"
#include "hooke/io/rewrite.h"
#include "hooke/io/stl.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/io/write_mesh.h"
#include "hooke/measure/fields.h"
#include "hooke/measure/quality.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/paper_mode.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/remesh/result.h"
#include "hooke/report/report.h"
#include "hooke/springs/sizing.h"
#include "memory_limit.h"
#include "messages.h"
#include "options.h"
#include "output_files.h"
#include "result_warnings.h"
#include "signals.h"
#include "standard_streams.h"
#include "target_lengths.h"

namespace hooke::app {
namespace {

using Clock = std::chrono::steady_clock;

bool keeps_faces(const Settings& s) {
  return s.paper || s.remesh.connectivity == ConnectivityMode::fixed;
}

/// The input mesh, kept as the reference for measuring the result.
struct Original {
  Mat3X points;  // in memory order
  MemoryOrder memory_order;
  std::vector<int> tree_order;  // order of the faces in its bounding volume tree
};

/// Whether a user would expect the output to be the input's bytes with other digits: a file of a format that
/// can be, the same faces, and nothing repaired.
bool is_of_its_kind(const Settings& s, const LoadedMesh& loaded) {
  return keeps_faces(s) && loaded.format == s.format && can_rewrite(*s.format) && loaded.repairs.empty() &&
         !is_standard_input(s.input);
}

/// Why the output cannot be the input file with moved vertices; empty if nothing is known to be in the way.
std::string obstacle_to_preserving(const Settings& s, const LoadedMesh& loaded) {
  if (!keeps_faces(s)) return "faces change with this --connectivity";
  if (loaded.format != s.format)
    return fmt::format("the input is {} and the output {}", name_of(loaded.format), name_of(*s.format));
  if (!can_rewrite(*s.format)) return fmt::format("{} files are always written anew", name_of(*s.format));
  if (!loaded.repairs.empty()) return "the input was repaired";
  if (is_standard_input(s.input)) return "standard input cannot be read again";
  if (!s.preserve_given && !loaded.misread.empty())
    return fmt::format("simple readers would misread its {}; --preserve on keeps them", loaded.misread);
  return "";
}

/// The vertex data of the result: that of the input if the faces are kept, else interpolated at the surface
/// positions of its vertices. Normals are always recomputed from the result.
VertexData data_of_result(const Settings& s, const LoadedMesh& loaded, const Original& original,
                          const Mat3X& points, const MemoryOrder& memory_order, RunRecord& run) {
  const bool interpolated = !keeps_faces(s) && !loaded.vertex_data.empty();
  VertexData data =
      interpolated ? interpolate(loaded.vertex_data, run.result->map,
                                 original.memory_order.order.scatter(original.memory_order.adjacency->faces))
                   : loaded.vertex_data;
  if (has_normals(data))
    set_normals(data, memory_order.order.scatter(vertex_normals(points, *memory_order.adjacency)));
  FormatData converted = data_for_format(data, loaded.format, *s.format);
  if (!converted.dropped.empty())
    run.warnings.push_back(
        {"attributes_not_kept", fmt::format("{}: {} files cannot hold {}; use PLY", name_of_output(s.output),
                                            name_of(*s.format), fmt::join(converted.dropped, ", "))});
  return std::move(converted.data);
}

/// A file of the input's format is encoded like the input, others are binary where they can be.
PlyEncoding encoding_of_output(const Settings& s, const LoadedMesh& loaded) {
  return s.format == loaded.format ? loaded.encoding : PlyEncoding::binary_little_endian;
}

/// The face data of the input that the output can hold, if the faces are the same.
FaceData face_data_of_result(const Settings& s, const LoadedMesh& loaded, PlyEncoding encoding,
                             RunRecord& run) {
  FormatFaceData converted = face_data_for_format(loaded.face_data, *s.format, encoding);
  const auto drop = [&](const std::string& why, const std::vector<std::string>& names) {
    run.warnings.push_back(
        {"attributes_not_kept", fmt::format("{}: face data not kept: {}: {}", name_of_output(s.output),
                                            fmt::join(names, ", "), why)});
  };
  if (!converted.dropped.empty())
    drop(fmt::format("{} files cannot hold it; use MSH", name_of(*s.format)), converted.dropped);
  if (keeps_faces(s) || converted.data.empty()) return std::move(converted.data);
  std::vector<std::string> names;
  for (const FaceChannel& channel : converted.data) names.push_back(channel.name);
  drop("new faces have none; use --connectivity fixed", names);
  return {};
}

MeasuredSurface surface_of(Mat3X points, const MemoryOrder& memory_order, Stopwatch& stopwatch,
                           const std::vector<int>& tree_order = {}) {
  return timed(&stopwatch, "tree", [&] {
    return MeasuredSurface(std::move(points), *memory_order.adjacency, memory_order.order.old_ids(),
                           tree_order);
  });
}

/// Measures the quality relative to the current target lengths of the vertices.
Quality measure(const MeasuredSurface& surface, const TriMesh& mesh, const Permutation& order,
                Stopwatch& stopwatch) {
  return measure_quality(surface, target_lengths_of(mesh, order, surface.adjacency).edge, {}, &stopwatch);
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
  }
}

RemeshResult optimize(const Settings& s, TriMesh& mesh, MemoryOrder memory_order, const KnownInput& known,
                      Stopwatch& stopwatch) {
  ProgressLine line(s);
  const Observer observer = [&](const Progress& p) {
    line.show(p);
    return caught_signal() == 0;
  };
  return in_the_name_of(name_of_input(s.input), [&] {
    return s.paper ? paper_remesh(mesh, std::move(memory_order), s.paper_options, observer)
                   : preserving_remesh(mesh, std::move(memory_order), s.remesh, s.preservation, known,
                                       observer, &stopwatch);
  });
}

/// Sets the target lengths of the input and measures it. Returns the order of the faces in its tree.
std::vector<int> measure_input(const Settings& s, LoadedMesh& loaded, RunRecord& record,
                               Stopwatch& stopwatch) {
  TriMesh& mesh = loaded.mesh;
  const MemoryOrder& memory_order = loaded.memory_order;
  Mat3X points = memory_order.order.gather(vertex_points(mesh));
  if (!s.check)
    warn_of_coincident_boundary(s, coincident_boundary_vertices(points, *memory_order.adjacency).size(),
                                record);
  timed(&stopwatch, "seams", [&] { warn_of_near_boundary(points, *memory_order.adjacency, record); });
  timed(&stopwatch, "sizing",
        [&] { set_target_lengths(s, mesh, memory_order, loaded.origin, points, record); });
  record.paper_before = measure_paper_figures(
      points, *memory_order.adjacency,
      target_lengths_of(mesh, memory_order.order, *memory_order.adjacency).edge, s.paper);
  const MeasuredSurface surface = surface_of(std::move(points), memory_order, stopwatch);
  record.before =
      timed(&stopwatch, "before", [&] { return measure(surface, mesh, memory_order.order, stopwatch); });
  warn_of_inside_out(record);
  return surface.tree.order();
}

/// The values at the vertices and faces of the result as a PLY file, in the order of the output's.
std::string fields_text(const TriMesh& mesh, const Mat3X& points, const Original& original,
                        const MemoryOrder& memory_order, const RunRecord& record) {
  const Permutation& order = memory_order.order;
  const Adjacency& adjacency = *memory_order.adjacency;
  const bool corresponds = record.deviation->displacement.has_value();
  const Mat3X start =
      corresponds ? order.gather(original.memory_order.order.scatter(original.points)) : Mat3X();
  Fields fields =
      measure_fields(points, adjacency, target_lengths_of(mesh, order, adjacency).edge,
                     record.deviation->vertices_to_reference.distances, corresponds ? &start : nullptr);
  for (VertexChannel& channel : fields.vertices) channel.values = order.scatter(channel.values);
  for (VertexChannel& channel : fields.faces) {
    const std::vector<double> in_memory = std::exchange(channel.values, {});
    channel.values.resize(in_memory.size());
    for (size_t f = 0; f < in_memory.size(); ++f)
      channel.values[static_cast<size_t>(order.old_face[f])] = in_memory[f];
  }
  return write_ply(vertex_points(mesh), triangles_of(mesh), PlyEncoding::binary_little_endian,
                   fields.vertices, fields.faces);
}

void measure_deviation_from_input(const Original& original, const MeasuredSurface& result, RunRecord& record,
                                  Stopwatch& stopwatch) {
  const MeasuredSurface reference =
      surface_of(original.points, original.memory_order, stopwatch, original.tree_order);
  record.deviation =
      timed(&stopwatch, "deviation", [&] { return measure_deviation(reference, result, &stopwatch); });
}

/// Throws ResultError if the result does not keep what it must keep and is not accepted nevertheless.
void require_promises(const Settings& s, const RunRecord& record) {
  if (s.accept_invalid || record.result->reason == StopReason::interrupted) return;
  const std::string broken = broken_promises(s, record);
  if (!broken.empty()) throw ResultError(name_of_output(s.output) + ": not written: " + broken);
}

/// Prepares the output: the input file with moved vertices if that can be and is not switched off, else a new
/// file. Records which of them, and what that means for the content of the input.
PendingMesh prepare_output(const Settings& s, const LoadedMesh& loaded, const Original& original,
                           const Mat3X& points, const MemoryOrder& memory_order, RunRecord& record,
                           Stopwatch& stopwatch) {
  record.output.emplace();
  std::string obstacle = obstacle_to_preserving(s, loaded);
  if (s.preserve && obstacle.empty()) {
    PreservedMesh preserved = prepare_preserved_mesh(
        s.output, loaded.mesh, {s.input, loaded.format, loaded.sha256, loaded.connectivity_sha256},
        s.reproject_uv ? &record.result->map : nullptr, &stopwatch);
    if (preserved.mesh) {
      record.output->preserved = true;
      append(record.warnings, loaded.content.preserved);
      append(record.warnings, preserved.warnings);
      return *std::move(preserved.mesh);
    }
    obstacle = std::move(preserved.obstacle);
  }
  append(record.warnings, loaded.content.anew);
  if (s.preserve && (s.preserve_given || is_of_its_kind(s, loaded)))
    record.warnings.push_back(
        {"not_preserved", fmt::format("{}: is a new file, and not {} with moved vertices: {}",
                                      name_of_output(s.output), record.input.path, obstacle)});
  const VertexData data = data_of_result(s, loaded, original, points, memory_order, record);
  const PlyEncoding encoding = encoding_of_output(s, loaded);
  const FaceData face_data = face_data_of_result(s, loaded, encoding, record);
  if (s.format == MeshFormat::stl)
    append(record.warnings, losses_in_stl(vertex_points(loaded.mesh), triangles_of(loaded.mesh), encoding,
                                          name_of_output(s.output)));
  return prepare_mesh(s.output, loaded.mesh, *s.format, encoding, data, face_data, &stopwatch);
}

/// Optimizes the mesh, measures the result and prepares its output files.
void make_result(const Settings& s, LoadedMesh& loaded, Original& original, RunRecord& record,
                 OutputFiles& files, Stopwatch& stopwatch) {
  TriMesh& mesh = loaded.mesh;
  if (!keeps_faces(s)) original.memory_order = loaded.memory_order;
  record.result = timed(&stopwatch, "remesh", [&] {
    return optimize(s, mesh, std::move(loaded.memory_order), {&record.before, original.tree_order},
                    stopwatch);
  });
  return_free_memory();
  RemeshResult& done = *record.result;
  const MemoryOrder memory_order = std::move(done.memory_order);
  if (keeps_faces(s)) original.memory_order = memory_order;
  original.points = original.memory_order.order.gather(std::exchange(done.input_points, {}));
  if (!vertex_points(mesh).allFinite())
    throw NumericalError(fmt::format("{}: the result is not finite; nothing was written", record.input.path));
  record.status = status_of(done.reason);
  Mat3X points = memory_order.order.gather(vertex_points(mesh));
  if (done.measures) {
    record.before = std::move(done.measures->input_quality);
    record.after = std::move(done.measures->quality);
    record.deviation = std::move(done.measures->deviation);
  } else {
    const MeasuredSurface result = surface_of(points, memory_order, stopwatch, original.tree_order);
    record.after =
        timed(&stopwatch, "after", [&] { return measure(result, mesh, memory_order.order, stopwatch); });
    measure_deviation_from_input(original, result, record, stopwatch);
  }
  if (done.adaptation.rounds > 0) record.deviation->displacement.reset();  // vertices do not correspond
  record.paper_after = measure_paper_figures(
      points, *memory_order.adjacency,
      target_lengths_of(mesh, memory_order.order, *memory_order.adjacency).edge, s.paper);
  require_promises(s, record);
  if (!done.vertex_limits.empty())
    for (WorstFace& face : record.after->worst_faces)
      face.reasons = limiting_factors(face, done.vertex_limits);
  PendingMesh written = timed(&stopwatch, "write", [&] {
    return prepare_output(s, loaded, original, points, memory_order, record, stopwatch);
  });
  static_cast<FileRecord&>(*record.output) = {name_of_output(s.output), written.sha256, name_of(*s.format),
                                              written.connectivity_sha256};
  files.add(std::move(written.file));
  if (!s.fields.empty())
    files.add(PendingFile(s.fields, fields_text(mesh, points, original, memory_order, record)));
  if (!s.map.empty()) files.add(PendingFile(s.map, map_text(map_to_old(done.map, loaded.origin))));
  add_result_warnings(s, record);
}

/// Writes the remaining outputs, then commits all files, so that no file is replaced before everything that
/// can fail has succeeded. Prints the warnings and the summary.
void finish(const Settings& s, RunRecord& record, OutputFiles& files) {
  record.gates = judge_gates(s.gates, report_json(record));
  if (!s.trace.empty()) files.add(PendingFile(s.trace, trace_csv(record.stages)));
  if (!s.trace_steps.empty())
    files.add(PendingFile(s.trace_steps, time_steps_csv(record.result->time_steps)));
  if (!s.report.empty() && s.report != "-") files.add(PendingFile(s.report, report_text(record)));
  if (s.report == "-") write_to_standard_output(report_text(record));
  files.commit();
  if (!s.quiet)
    for (const Note& note : record.notes) print_note(note);
  for (const Note& repair : record.repairs) print_warning(repair);
  for (const Warning& w : record.warnings) print_warning(w);
  if (!s.quiet) print_summary(s, record);
  for (const GateOutcome& gate : record.gates)
    if (!gate.passed)
      print_error(fmt::format("{}: required {}; it is {}", record.input.path, printable(gate.condition),
                              gate.value ? fmt::format("{:.6g}", *gate.value) : "not there"));
}

/// The fixed vertices of the mesh; the list has the ids of the file.
std::vector<int> read_fixed(const Settings& s, const LoadedMesh& loaded) {
  if (loaded.origin.vertex.empty()) return read_id_list(s.fix, loaded.memory_order.adjacency->vertex_count);
  const std::vector<int> ids = read_id_list(s.fix, static_cast<int>(loaded.origin.merged.size()));
  int lost = -1;
  std::vector<int> fixed = vertices_from(loaded.origin, ids, &lost);
  if (lost >= 0)
    throw InputError(
        fmt::format("{}: vertex {} was dropped by --repair; expected one that is left; remove its line",
                    printable(s.fix.string()), lost));
  return fixed;
}

int run(Settings s) {
  const auto start = Clock::now();
  const ThreadLimit threads(s.threads);
  require_outputs(s);
  s.remesh.filter.memory_limit_bytes = s.paper_options.filter.memory_limit_bytes = memory_limit();
  Stopwatch stopwatch;
  LoadedMesh loaded = timed(&stopwatch, "read", [&] {
    return read_mesh(s.input, &stopwatch, {s.input_format, s.repair});
  });
  if (s.format == MeshFormat::msh && loaded.format == MeshFormat::msh2 && !s.format_given)
    s.format = MeshFormat::msh2;
  if (!s.fix.empty())
    s.remesh.constraints.fixed_vertices = s.paper_options.constraints.fixed_vertices = read_fixed(s, loaded);

  RunRecord record;
  record.tool_version = HOOKE_VERSION;
  record.status = "checked";
  record.input = {name_of_input(s.input), loaded.sha256, name_of(loaded.format), loaded.connectivity_sha256};
  record.warnings = loaded.warnings;
  record.notes = loaded.notes;
  record.repairs = loaded.repairs;
  s.remesh.map |= !loaded.vertex_data.empty();
  record.parameters = s.paper ? parameters_json(s.paper_options) : parameters_json(s.remesh, s.effort);
  record.parameters.update({{"repair", s.repair.repair},
                            {"weld", s.weld_text},
                            {"drop_components", s.repair.drop_components},
                            {"fill_holes", s.repair.fill_holes}});
  const std::string obstacle = obstacle_to_preserving(s, loaded);
  record.parameters["preserve"] = s.preserve && obstacle.empty() ? "on" : "off";
  record.parameters["reproject_uv"] = s.reproject_uv ? "on" : "off";
  if (s.reproject_uv && (s.format != MeshFormat::obj || !obstacle.empty()))
    throw Error("--reproject-uv is of OBJ files that are preserved; " +
                (obstacle.empty() ? record.input.path + " is " + name_of(loaded.format) : obstacle));
  Original original;
  original.tree_order = measure_input(s, loaded, record, stopwatch);
  require_metrics(s.gates, to_json(record.before));
  if (s.max_distance_share > 0)
    s.preservation.max_distance = s.max_distance_share * record.before.extent.diagonal;

  OutputFiles files;
  if (!s.check) make_result(s, loaded, original, record, files, stopwatch);
  record.stages = stopwatch.stages();
  record.resources = resources_used(std::chrono::duration<double>(Clock::now() - start).count());
  finish(s, record, files);
  if (caught_signal()) return 128 + caught_signal();
  return std::ranges::all_of(record.gates, &GateOutcome::passed) ? done : gate_failed;
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
