#include "result_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "messages.h"

#include "hooke/mesh/repair.h"
#include "hooke/mesh/vertex_welding.h"
#include "hooke/remesh/limiting_factors.h"
#include "hooke/remesh/preserving_remesh.h"
#include "hooke/springs/sizing.h"
#include "stages.h"

namespace hooke::app {
namespace {

/// A distance in file units and in percent of the size.
std::string with_share(double distance, const RunRecord& run) {
  return fmt::format("{:.4g} ({:.2g} % of the size)", distance, 100 * distance / run.deviation->diagonal);
}

/// The coordinates, to about a millionth of the size or better.
std::string place(const Vec3& x, const RunRecord& run) {
  constexpr double digits = 6, most = 17;
  const double far = x.cwiseAbs().maxCoeff() / run.before.extent.diagonal;
  const int precision =
      static_cast<int>(far > 1 ? std::min(digits + std::ceil(std::log10(far)), most) : digits);
  return fmt::format("{:.{}g} {:.{}g} {:.{}g}", x[0], precision, x[1], precision, x[2], precision);
}

/// Empty for meshes without a volume.
std::string volume_change(const RunRecord& run) {
  const std::optional<double>& change = run.deviation->volume_change;
  return change ? fmt::format(", volume {:+.2g} %", 100 * *change) : "";
}

void warn_of_time(const Settings& s, RunRecord& run) {
  if (run.status == "time_limit")
    run.warnings.push_back(
        {"time_limit",
         fmt::format(
             "{}: the time limit of {:g} s ended the work; {} is the best valid mesh so far; a longer "
             "--time-limit goes on",
             run.input.path, s.time_limit, run.output->path)});
}

void warn_of_folds(RunRecord& run) {
  std::vector<int> folded = run.deviation->opposing_faces;
  const bool is_unchanged =
      run.result->flips.flips == 0 && run.deviation->displacement && run.deviation->displacement->max == 0;
  if (folded.empty() || is_unchanged) return;
  constexpr size_t max_listed = 10;
  const size_t count = folded.size();
  folded.resize(std::min(count, max_listed));
  run.warnings.push_back(
      {"folded_faces",
       fmt::format(
           "{}: {} of its faces point the other way than {} does near them, which is folded there or has "
           "two sheets close together: faces {}{}; look whether that is meant",
           run.output->path, count, run.input.path, fmt::join(folded, " "),
           count > max_listed ? " ..." : "")});
}

/// Tells of faces that look down in a terrain.
void warn_of_overhangs(const Settings& s, RunRecord& run) {
  const int count = run.deviation->overhangs;
  if (count == 0) return;
  const bool is_closest = s.remesh.filter.kind == FilterKind::closest;
  run.warnings.push_back(
      {"overhangs",
       fmt::format(
           "{}: {} of its faces look down, where all of {} look up (or so along another axis): steep places "
           "lean over; {}--feature-noise off, which keeps edges there, may have fewer",
           run.output->path, count, run.input.path, is_closest ? "" : "--filter closest or ")});
}

void warn_of_crossings(RunRecord& run) {
  const size_t crossings = run.after->self_intersections.value_or(0),
               before = run.before.self_intersections.value_or(0);
  if (crossings <= before) return;
  const auto& measures = run.result->measures;
  const bool only_there = measures && measures->preservation.new_crossings == 0;
  run.warnings.push_back(
      {"self_intersections_added",
       fmt::format("{}: {} self-intersections, {} before{}", run.output->path, crossings, before,
                   only_there ? ", all where the surface crosses or touches itself already" : "")});
}

/// Has a closed body lost or gained more than a fiftieth of its volume, as a thin tube of long edges does?
/// No if that is less than .005 of a natural length all over, as where two sheets enclose nearly
/// nothing.
bool changes_volume(const RunRecord& run) {
  constexpr double max_share = .02, min_lengths = .005;
  const double change = std::abs(run.deviation->volume_change.value_or(0));
  return change > max_share && change * std::abs(run.before.extent.volume.value_or(0)) >
                                   min_lengths * run.target.natural * run.before.extent.area;
}

/// Warns if the surfaces are more than half a natural length or a fiftieth of the size apart, or the volume
/// is another.
void warn_of_distance(const Settings& s, RunRecord& run) {
  constexpr double max_lengths = .5, max_share = .02;
  const double distance = std::max(run.deviation->to_reference.max, run.deviation->from_reference.max);
  if (distance <= std::min(max_lengths * run.target.natural, max_share * run.deviation->diagonal) &&
      !changes_volume(run))
    return;
  const std::string limit = fmt::format("--max-distance {:.2g}%", 25 * distance / run.deviation->diagonal);
  const auto remedy = [&]() -> std::string {
    if (s.paper) return "without --paper";
    if (s.remesh.connectivity == ConnectivityMode::adapt)
      return limit + ", for which edges there get shorter, or a smaller --length";
    const bool closest = s.remesh.filter.kind == FilterKind::closest;
    return fmt::format("{}another --feature-angle, or --connectivity adapt with {}",
                       closest ? "" : "--filter closest, ", limit);
  };
  run.warnings.push_back(
      {"surface_left",
       fmt::format("{}: its surface and that of {} are up to {} apart{}; try {}", run.output->path,
                   run.input.path, with_share(distance, run), volume_change(run), remedy())});
}

/// Warns if bends of the result are sharp where the input is smooth, unless so few of its edges are that it
/// hardly matters.
void warn_of_bends(RunRecord& run) {
  constexpr double few = .0025, at_least = 4;  // of all edges
  const RemeshResult& result = *run.result;
  if (result.sharp_bends <= std::max(at_least, few * 1.5 * run.after->topology.faces)) return;
  run.warnings.push_back(
      {"sharp_bends",
       fmt::format("{}: {} edges turn by more than 60 degrees, up to {:.0f} near {}, where "
                   "{} bends less: narrow or sharply curved parts are coarser there; a smaller --length "
                   "follows them",
                   run.output->path, result.sharp_bends, result.sharpest_bend,
                   place(result.sharpest_place, run), run.input.path)});
}

/// Warns if walls or gaps are not as thick as they were, unless it is at so few places that it hardly
/// matters.
void warn_of_walls(const Settings& s, RunRecord& run) {
  constexpr double few = .001, at_least = 4;  // of the faces of the input
  constexpr double in_reach = 2e-4;           // of the diagonal: smaller distances can hardly be kept
  const RemeshResult& result = *run.result;
  if (result.left_walls <= std::max(at_least, few * run.before.topology.faces)) return;
  const double distance = .1 * result.thickness;
  const double allowed = s.preservation.max_distance.value_or(std::numeric_limits<double>::infinity());
  const auto remedy = [&] {
    std::vector<std::string> options;
    if (s.remesh.connectivity == ConnectivityMode::adapt) {
      if (distance < allowed && distance >= in_reach * run.deviation->diagonal)
        options.push_back(fmt::format("--max-distance {:.2g}", distance));
      options.emplace_back("a smaller --length");
    } else {
      if (s.remesh.filter.kind != FilterKind::closest) options.emplace_back("--filter closest");
      options.emplace_back("--connectivity adapt");
    }
    const std::string last = options.back();
    options.pop_back();
    return options.empty() ? last : fmt::format("{} or {}", fmt::join(options, ", "), last);
  };
  run.warnings.push_back(
      {"thin_walls", fmt::format("{}: walls or gaps are not as thick as in {}: where one is {:.3g}, near "
                                 "{}, a side is {:.3g} off; {} keeps them better",
                                 run.output->path, run.input.path, result.thickness,
                                 place(result.thin_place, run), result.lost_thickness, remedy())});
}

void warn_of_count(RunRecord& run) {
  const AdaptResult& adapted = run.result->adaptation;
  if (run.result->reason == StopReason::interrupted) return;  // adaptation may be incomplete
  if (run.result->rescue == Rescue::kept_faces) return;       // another warning tells that
  const double faces = run.after->topology.faces, expected = adapted.target_faces;
  if (adapted.rounds > 0 && std::abs(faces - expected) > (1 + 1e-9) * std::max(3., .03 * expected))
    run.warnings.push_back(
        {"face_count_missed",
         fmt::format(
             "{}: {} faces, where the target length asks for {:.0f}; edges that the surface, a boundary "
             "or a fixed vertex needs stay{}",
             run.output->path, faces, expected,
             faces < expected ? "; use a smaller length" : ", though they are shorter")});
}

/// The rms length error that each mode can achieve on a mesh whose target lengths vary by a factor of four.
double reachable_length_error(ConnectivityMode mode) {
  switch (mode) {
    case ConnectivityMode::fixed:
      return .35;
    case ConnectivityMode::flip:
      return .25;
    case ConnectivityMode::adapt:
      break;
  }
  return .15;
}

void warn_of_sizing(const Settings& s, RunRecord& run) {
  const Statistics& error = run.after->length_error;
  const double rms = std::hypot(error.mean, error.std);
  const double max_rms = reachable_length_error(s.remesh.connectivity);
  if (s.sizing.kind == SizingSource::Kind::none || rms <= max_rms) return;
  const char* advice = s.remesh.connectivity == ConnectivityMode::adapt
                           ? "a smaller --gradation, or lengths that the boundary can take"
                           : "--connectivity adapt, or lengths nearer to those of the input";
  run.warnings.push_back(
      {"sizing_missed",
       fmt::format(
           "{}: the edges miss the lengths of the sizing by {:.0f} % (rms), expected at most {:.0f} % "
           "with these vertices and faces; use {}",
           run.output->path, 100 * rms, 100 * max_rms, advice)});
}

/// In what the topology of the result is not that of the input.
std::string topology_change(const Topology& before, const Topology& after) {
  std::vector<std::string> changes;
  const auto compare = [&](const char* what, int was, int is) {
    if (is != was) changes.push_back(fmt::format("{} {}, not {}", what, is, was));
  };
  compare("components", before.components, after.components);
  compare("boundary loops", before.boundary_loops, after.boundary_loops);
  compare("Euler number", before.euler, after.euler);
  if (changes.empty()) return "the lines in which sheets meet would be others";
  return fmt::format("its topology would be another: {}", fmt::join(changes, ", "));
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// What the result does not keep of the input; empty if it keeps all, or was not measured.
std::string what_is_broken(const RunRecord& run) {
  if (!run.result->measures || run.result->measures->preservation.holds()) return "";
  const Preservation& p = run.result->measures->preservation;
  std::vector<std::string> broken;
  const std::string where = place(p.place, run), at = p.excess > 1 ? "" : ", one at " + where;
  if (!p.topology_kept) broken.push_back(topology_change(run.before.topology, run.after->topology));
  if (!p.far_vertices.empty() || !p.lost_vertices.empty() || !p.within_max_distance)
    broken.push_back(fmt::format("the surface would be {} from that of {} at {}{}",
                                 with_share(p.distance, run), run.input.path, where, volume_change(run)));
  if (!p.creases_kept)
    broken.push_back(fmt::format("sharp edges would be lost, up to {:.4g} away{}", p.crease_loss,
                                 p.flipped_faces + p.new_crossings + p.new_degenerate_faces == 0 ? at : ""));
  if (p.flipped_faces > 0) broken.push_back(counted(p.flipped_faces, "face", "faces") + " turned over" + at);
  if (p.new_folds > 0) broken.push_back(counted(p.new_folds, "new fold", "new folds"));
  if (p.new_crossings > 0)
    broken.push_back(counted(p.new_crossings, "new self-intersection", "new self-intersections") +
                     (p.flipped_faces == 0 ? at : ""));
  if (p.new_degenerate_faces > 0)
    broken.push_back(counted(p.new_degenerate_faces, "new face", "new faces") + " without area" +
                     (p.flipped_faces + p.new_crossings == 0 ? at : ""));
  return fmt::format("{}", fmt::join(broken, "; "));
}

void warn_of_promises(RunRecord& run) {
  const std::string broken = what_is_broken(run);
  if (broken.empty()) return;
  run.warnings.push_back({"promise_broken", fmt::format("{}: {}", run.output->path, broken)});
}

/// Tells of a result that was not made as asked, because it would have broken a promise.
void warn_of_rescue(RunRecord& run) {
  const auto why = [&]() -> std::string {
    const auto count = std::ranges::count_if(
        run.result->vertex_limits, [](unsigned char limits) { return limits & VertexLimit::put_back; });
    const int parts = run.result->rescued_shells;
    const std::string of_parts = parts > 0 ? fmt::format(" of {} of its connected parts", parts) : "";
    constexpr double margin = 1.2;
    const double distance = run.result->refused_distance / run.deviation->diagonal;
    const std::string allowing =
        distance > 0 ? fmt::format("--max-distance {:.2g}% allows what was {:.2g} % of the size away",
                                   100 * margin * distance, 100 * distance)
                     : "";
    switch (run.result->rescue) {
      case Rescue::none:
        return "";
      case Rescue::tips:
        return fmt::format("vertices at tips of the surface{} stand still; without that it would lose them",
                           of_parts);
      case Rescue::junctions:
        return fmt::format(
            "the vertices of edges with three faces or more{} stand still; if they slid it would not keep "
            "the input",
            of_parts);
      case Rescue::closest:
        return fmt::format(
            "{} vertices{} lie on the faces of the input; on a smooth surface it would not keep the input, "
            "or only with small angles",
            parts > 0 ? "the" : "its", of_parts);
      case Rescue::put_back: {
        const std::string what =
            count > 0
                ? fmt::format(
                      "{} of {} vertices were put back to where they were, with the faces of the input,",
                      count, run.result->vertex_limits.size())
                : "it has the faces of the input";
        return fmt::format(
            "{} to keep its surface and the angles of its faces; {}--connectivity adapt, which makes new "
            "vertices and triangles, can do more",
            what, allowing.empty() ? "" : allowing + ", and ");
      }
      case Rescue::kept_faces:
        return fmt::format(
            "{} of {} vertices and the faces between them are those of {}, where others would not keep its "
            "surface{}",
            count, run.result->vertex_limits.size(), run.input.path,
            allowing.empty() ? ", as at folds and self-intersections" : "; " + allowing);
    }
    return "";
  };
  if (const std::string text = why(); !text.empty())
    run.warnings.push_back({"result_rescued", fmt::format("{}: {}", run.output->path, text)});
}

/// Tells that target lengths were shortened.
void warn_of_shortening(RunRecord& run) {
  if (const int count = run.result->shortened; count > 0)
    run.warnings.push_back(
        {"lengths_shortened",
         fmt::format(
             "{}: edges at {} of its {} vertices are shorter than asked, as longer ones would not keep the "
             "surface there; a smaller --length makes all edges alike",
             run.output->path, count, run.after->topology.vertices)});
}

/// Warns if large angles have come with larger small ones, as of needles that became flat triangles.
void warn_of_large_angles(const Settings& s, RunRecord& run) {
  constexpr double large = 135, clearly_more = 30;  // degrees
  const double before = run.before.max_angle.p95, after = run.after->max_angle.p95;
  if (s.remesh.connectivity == ConnectivityMode::adapt || after < std::max(large, before + clearly_more))
    return;
  const char* better = s.remesh.connectivity == ConnectivityMode::fixed ? "flip or adapt" : "adapt";
  run.warnings.push_back(
      {"large_angles",
       fmt::format(
           "{}: a twentieth of its faces has an angle of {:.0f} degrees or more, before it was {:.0f}: "
           "with these faces narrow ones became flat; --connectivity {} makes others",
           run.output->path, after, before, better)});
}

/// Tells that edges are not even, if any have moved.
void warn_of_lengths_of_input(RunRecord& run) {
  const auto is_put_back = [](unsigned char limits) { return limits & VertexLimit::put_back; };
  const bool none_moved =
      run.result->rescue == Rescue::put_back && std::ranges::all_of(run.result->vertex_limits, is_put_back);
  if (!run.result->has_lengths_of_input || none_moved) return;
  run.warnings.push_back(
      {"lengths_of_input",
       fmt::format(
           "{}: its edges are about as long as those of {} are there, as even ones would make worse "
           "triangles, or more with small angles, with these vertices; --sizing input asks for such lengths",
           run.output->path, run.input.path)});
}

/// A length of edges for the narrow regions of the worst faces: the least width of those that need no more
/// than `most_edges` edges for one of the target length. None if there is none that is shorter than
/// --min-length.
template <typename IsNarrow>
std::optional<double> length_that_fits(const Settings& s, const RunRecord& run, const IsNarrow& is_narrow) {
  constexpr double most_edges = 30, clearly_shorter = .8;
  std::optional<double> least;
  for (const WorstFace& f : run.after->worst_faces) {
    const bool is_new = !s.min_length || f.height < clearly_shorter * s.remesh.min_length;
    if (is_narrow(f) && is_new && most_edges * f.height > run.target.max && (!least || f.height < *least))
      least = f.height;
  }
  return least;
}

/// Tells what would help against small angles at edges that stay, of facets or of the boundary.
void warn_of_held_faces(const Settings& s, RunRecord& run) {
  constexpr double small_angle = 20;
  const auto& limits = run.result->vertex_limits;
  if (limits.empty() || run.result->rescue == Rescue::put_back) return;
  const std::vector<WorstFace>& faces = run.after->worst_faces;
  const auto is_between_creases = [&](const WorstFace& f) {
    return f.min_angle < small_angle && std::ranges::all_of(f.vertices, [&](int v) {
             return limits[v] & (limited_by_crease | limited_at_corner);
           });
  };
  const auto is_narrow = [&](const WorstFace& f) {
    constexpr double well_below = .5;  // also at a sharp corner, but that is no narrow region
    const auto is_kept = [&](int v) { return limits[v] & VertexLimit::put_back; };
    const auto is_on_line = [&](int v) {
      return limits[v] & (limited_by_boundary | limited_by_crease | limited_at_corner);
    };
    const auto is_squeezed = [&](int v) { return is_on_line(v) || limits[v] == 0; };  // by springs alone
    return f.min_angle < std::min(small_angle, well_below * f.bound.degrees) &&
           (!s.min_length || f.height < s.remesh.min_length) && !std::ranges::all_of(f.vertices, is_kept) &&
           std::ranges::all_of(f.vertices, is_squeezed) && std::ranges::count_if(f.vertices, is_on_line) >= 2;
  };
  const auto is_at_fixed_edge = [&](const WorstFace& f) {
    return f.min_angle < small_angle &&
           std::ranges::count_if(f.vertices, [&](int v) { return limits[v] & limited_by_request; }) >= 2;
  };
  const auto warn = [&](const char* code, const WorstFace& f, const std::string& text) {
    run.warnings.push_back({code, fmt::format("{}: face {} is left with an angle of {:.2g} degrees: {}",
                                              run.output->path, f.face, f.min_angle, text)});
  };
  const auto warn_of_first = [&](const auto& is_meant, const char* code, const std::string& text) {
    const auto f = std::ranges::find_if(faces, is_meant);
    if (f != faces.end()) warn(code, *f, text);
  };
  const bool has_seams = !s.remesh.constraints.seams.empty();
  const char* fewer_seams = has_seams ? ", or fewer words of --keep, for fewer seams" : "";
  if (s.remesh.connectivity != ConnectivityMode::adapt)
    return warn_of_first(
        is_between_creases, "facets_without_inner_vertices",
        fmt::format("it lies between creases{}, and facets with no inner vertices cannot be mended without "
                    "new ones; use --connectivity adapt{}",
                    has_seams ? " or seams" : "", fewer_seams));
  if (s.remesh.constraints.boundary == BoundaryRule::fixed)
    warn_of_first(is_at_fixed_edge, "boundary_holds_angles",
                  "the edges of a fixed boundary stay; use --boundary slide");
  const std::optional<double> length = length_that_fits(s, run, is_narrow);
  const std::string value = length ? fmt::format(" {:.2g}", *length) : "";
  const std::string remedy =
      s.min_length
          ? (length ? "try" + value : "use a shorter one")
          : fmt::format("use --min-length{}, with which edges there may be {}, or a smaller --length", value,
                        length ? "as short" : "shorter, --weld if a step so narrow is not meant");
  warn_of_first(
      is_narrow, "narrow_regions",
      fmt::format("it lies between creases{} or boundaries closer than {}; {}{}", has_seams ? ", seams" : "",
                  s.min_length ? "--min-length" : "the target length", remedy, fewer_seams));
}

/// Tells what would help against edges as short as a rounding in a mesh with small angles.
void warn_of_edges_without_length(const Settings& s, const TriMesh& mesh, RunRecord& run) {
  constexpr double small_angle = 20;
  if (s.remesh.connectivity == ConnectivityMode::adapt || run.after->min_angle.min >= small_angle ||
      !(run.after->edge_length.min <= rounding_share * run.after->extent.diagonal))
    return;
  const Repaired collapsed = repair(vertex_points(mesh), triangles_of(mesh), {.collapse = true}, {});
  const auto edges = std::ranges::find(collapsed.changes, "edges_collapsed", &Note::code);
  if (edges == collapsed.changes.end()) return;
  run.warnings.push_back(
      {"edges_without_length",
       fmt::format("{}: {} of its edges are no longer than a rounding of its size, which makes slivers; use "
                   "--connectivity adapt, which collapses them",
                   run.output->path, edges->count)});
}

void warn_of_dropped_creases(RunRecord& run) {
  const CreaseCounts& c = run.result->creases;
  if (run.result->steps == MaskSteps::resolved)
    run.warnings.push_back(
        {"steps_resolved",
         fmt::format("{}: the surface of a binary mask, whose steps the length resolves and keeps as edges; "
                     "--feature-angle off smooths them, and so does a longer --length",
                     run.input.path)});
  if (run.result->steps == MaskSteps::smoothed)
    run.warnings.push_back(
        {"steps_smoothed",
         fmt::format(
             "{}: the surface of a binary mask, whose steps were smoothed: {}--feature-noise off keeps them",
             run.input.path, c.sharp > 0 ? fmt::format("{} sharp edges; ", c.sharp) : std::string())});
  else if (c.dropped > 0)
    run.warnings.push_back(
        {"sharp_edges_dropped",
         fmt::format("{}: {} of {} sharp edges were taken for noise; --feature-noise off keeps them",
                     run.input.path, c.dropped, c.sharp)});
}

/// Are results rounded to 32-bit floats, and is the mesh so far from the origin that these are coarser than a
/// millionth of its size?
bool is_rounded_coarsely(const Settings& s, const RunRecord& run) {
  constexpr double share = 1e-6;
  const Extent& e = run.before.extent;
  const double largest = e.lower.cwiseAbs().cwiseMax(e.upper.cwiseAbs()).maxCoeff();
  return s.preservation.has_float_points &&
         largest * static_cast<double>(std::numeric_limits<float>::epsilon()) > share * e.diagonal;
}

constexpr const char* for_finer_numbers =
    "PLY with --preserve off, whose numbers have 64 bits, not 32, or the mesh moved to the origin";

void warn_of_rounding(const Settings& s, RunRecord& run) {
  if (is_rounded_coarsely(s, run))
    run.warnings.push_back({"rounded_coarsely",
                            fmt::format("{}: so far from the origin its numbers are coarser than a millionth "
                                        "of its size, which may cost angles; try {}",
                                        run.output->path, for_finer_numbers)});
}

}  // namespace

std::string broken_promises(const Settings& s, const RunRecord& run, BrokenBy cause) {
  const std::string broken = what_is_broken(run);
  if (broken.empty()) return "";
  const char* const remedy = cause == BrokenBy::rounding || is_rounded_coarsely(s, run) ? for_finer_numbers
                             : s.remesh.connectivity != ConnectivityMode::adapt ? "--feature-noise off"
                             : s.min_length
                                 ? "a smaller --length, a shorter --min-length, --connectivity flip"
                                 : "a smaller --length, --min-length for narrow parts, --connectivity flip";
  return fmt::format("{}; try {}, or --accept-invalid to write it nevertheless", broken, remedy);
}

void warn_of_length(const Settings& s, double length, double natural, RunRecord& run) {
  const double ratio = length / natural;
  if (ratio >= .9 && ratio <= 1.1) return;
  const std::string asked =
      s.sizing.kind == SizingSource::Kind::none
          ? fmt::format("the target length {:.6g} is {:.2f} times the natural length {:.6g}", length, ratio,
                        natural)
          : fmt::format("the lengths of the sizing ask for {:.2f} times the faces there are",
                        1 / (ratio * ratio));
  run.warnings.push_back(
      {"length_out_of_reach",
       fmt::format("{}: {}; the faces are as many as they are, so the edges cannot get there and only pull "
                   "or push; use -L auto, or a value within 0.9x and 1.1x",
                   run.input.path, asked)});
}

void warn_of_coincident_boundary(const Settings& s, std::size_t count, RunRecord& run) {
  if (count == 0) return;
  run.warnings.push_back(
      {"coincident_boundary",
       fmt::format("{}: {} boundary vertices share their place with another and stand still, so that no gap "
                   "opens between them{}",
                   run.input.path, count,
                   s.repair.repair ? "" : "; --repair welds them and lets them move")});
}

void warn_of_near_boundary(const Mat3X& points, const Adjacency& adjacency, RunRecord& run) {
  std::vector<Edge> boundary;
  for (size_t e = 0; e < adjacency.edges.size(); ++e)
    if (adjacency.is_boundary_edge(static_cast<int>(e))) boundary.push_back(adjacency.edges[e]);
  if (boundary.empty()) return;
  const std::vector<int> merged = weld_vertices(points, reach_of_edges(points, boundary));
  size_t count = 0;
  for (size_t v = 0; v < merged.size(); ++v)
    count += points.col(static_cast<Eigen::Index>(v)) != points.col(merged[v]) ? 1 : 0;
  if (count == 0) return;
  run.warnings.push_back(
      {"near_boundary",
       fmt::format(
           "{}: {} boundary vertices nearly lie on another, within {:.0e} of the edges there: a seam whose "
           "sides will part; --repair welds them",
           run.input.path, count, welding_share)});
}

void warn_of_cracks(const Settings& s, const Mat3X& points, const Adjacency& adjacency, RunRecord& run) {
  if (s.remesh.constraints.boundary == BoundaryRule::fixed) return;
  const std::vector<int> vertices = vertices_at_cracks(points, adjacency);
  if (vertices.empty()) return;
  run.warnings.push_back(
      {"cracks",
       fmt::format(
           "{}: {} boundary vertices lie within a hundredth of another boundary edge, as at T-junctions: "
           "the sides of such a crack slide and may part; --boundary fixed keeps both",
           run.input.path, vertices.size())});
}

void warn_of_junctions(const Settings& s, bool has_copies, RunRecord& run) {
  const int edges = run.before.topology.junction_edges;
  if (!has_copies || s.check || (edges > 0 && !s.paper)) return;
  run.warnings.push_back(
      {"junctions_held",
       fmt::format("{}: {} stay where they are", run.input.path,
                   edges > 0
                       ? fmt::format("{} edges with three faces or more, their vertices and those where "
                                     "sheets only touch",
                                     edges)
                       : "vertices where sheets only touch")});
}

void warn_of_inside_out(RunRecord& run) {
  const std::optional<double>& volume = run.before.extent.volume;
  if (volume && *volume < 0)
    run.warnings.push_back(
        {"inside_out", fmt::format("{}: the mesh is inside out: its volume is {:.4g}; --repair turns "
                                   "it over",
                                   run.input.path, *volume)});
}

void add_result_warnings(const Settings& s, const TriMesh& mesh, RunRecord& run) {
  const std::vector<Warning> earlier = std::exchange(run.warnings, {});
  warn_of_promises(run);
  warn_of_time(s, run);
  warn_of_distance(s, run);
  warn_of_bends(run);
  warn_of_walls(s, run);
  warn_of_crossings(run);
  warn_of_folds(run);
  warn_of_overhangs(s, run);
  run.warnings.insert(run.warnings.end(), earlier.begin(), earlier.end());
  warn_of_rescue(run);
  warn_of_shortening(run);
  warn_of_lengths_of_input(run);
  warn_of_large_angles(s, run);
  warn_of_held_faces(s, run);
  warn_of_edges_without_length(s, mesh, run);
  warn_of_rounding(s, run);
  warn_of_dropped_creases(run);
  warn_of_count(run);
  warn_of_sizing(s, run);
  if (s.paper && run.result->reason != StopReason::converged)
    run.warnings.push_back({"paper_jams", fmt::format("{}: {}", run.input.path, paper_message(*run.result))});
}

}  // namespace hooke::app
