// The rows from which the table of the report's keys is made.
#include "hooke/report/report_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace hooke {
namespace report_table {
namespace {

struct ValueType {
  KeyKind kind;
  bool may_be_null = false;
};
constexpr ValueType text{KeyKind::text}, number{KeyKind::number}, integer{KeyKind::integer},
    boolean{KeyKind::boolean}, object{KeyKind::object}, list{KeyKind::list};
constexpr ValueType or_null(ValueType type) {
  return {type.kind, true};
}

/// Keys of the table; `a|b` in place of a key stands for two keys with the same contents.
struct Row {
  const char* path;
  ValueType type;
  const char* unit;
  Better better;
  const char* meaning;
};

constexpr auto neither = Better::neither, higher = Better::higher, lower = Better::lower,
               nearer_zero = Better::nearer_zero;
constexpr const char *none = "", *degrees = "degrees", *length = "file units", *seconds = "s",
                     *bytes = "bytes", *targets = "target lengths", *ratio = "ratio";

// Statistics of a quantity, once for each.

struct Quantity {
  const char* name;
  const char* unit;
  Better better;
  const char* meaning;
};
constexpr Quantity quantities[] = {
    {"min_angle", degrees, higher, "least angle of a face; 60 at best"},
    {"max_angle", degrees, lower, "greatest angle of a face; 60 at best"},
    {"shape", ratio, higher, "4 sqrt(3) area / sum of squared edges of a face; 1 at best"},
    {"radius_ratio", ratio, lower, "circumradius / (2 inradius) of a face; 1 at best"},
    {"aspect_ratio", ratio, lower, "longest edge / (2 sqrt(3) inradius) of a face; 1 at best"},
    {"edge_ratio", ratio, lower, "longest / shortest edge of a face; 1 at best"},
    {"edge_length", length, neither, "length of an edge"},
    {"length_error", ratio, nearer_zero,
     "(length - target length) / target length of an edge; of quadrilaterals to the rest length"},
};

/// `better`: of the quantities for which more, for which less, and for which 0 is better.
struct Figure {
  const char* name;
  const char* meaning;
  Better of_higher, of_lower, of_zero;
};
constexpr Figure figures[] = {
    {"min", "least", higher, neither, nearer_zero},
    {"p01", "1 % are below", higher, neither, nearer_zero},
    {"p05", "5 % are below", higher, neither, nearer_zero},
    {"median", "half are below", higher, lower, neither},
    {"mean", "mean", higher, lower, neither},
    {"p95", "95 % are below", neither, lower, nearer_zero},
    {"max", "greatest", neither, lower, nearer_zero},
    {"std", "standard deviation", neither, neither, lower},
};

Better better_of(const Figure& figure, Better of_quantity) {
  switch (of_quantity) {
    case Better::higher:
      return figure.of_higher;
    case Better::lower:
      return figure.of_lower;
    case Better::nearer_zero:
      return figure.of_zero;
    case Better::neither:
      break;
  }
  return neither;
}

void add_statistics(std::vector<ReportKey>& keys, const std::string& block) {
  for (const Quantity& q : quantities) {
    const std::string path = block + "." + q.name;
    const auto add = [&](const char* name, ValueType type, const char* unit, Better better,
                         const std::string& meaning) {
      keys.push_back({path + name, type.kind, type.may_be_null, unit, better, meaning, false, path + name});
    };
    add("", object, q.unit, q.better, q.meaning);
    for (const Figure& f : figures)
      add(fmt::format(".{}", f.name).c_str(), or_null(number), q.unit, better_of(f, q.better),
          fmt::format("{}: {}", f.meaning, q.meaning));
    add(".histogram", or_null(object), none, neither, fmt::format("histogram: {}", q.meaning));
    add(".histogram.edges", list, q.unit, neither, "ends of the bins, one more than bins");
    add(".histogram.edges.<n>", number, q.unit, neither, "end of a bin");
    add(".histogram.counts", list, none, neither, "numbers in the bins");
    add(".histogram.counts.<n>", integer, none, neither, "how many are in the bin");
    add(".non_finite", integer, none, lower, "how many have no finite value, and are left out");
  }
}

constexpr Row files[] = {
    {"input|output.path", or_null(text), none, neither, "name of the file; - is told as its stream"},
    {"input|output.sha256", or_null(text), none, neither, "SHA-256 of the bytes of the file"},
    {"input|output.format", or_null(text), none, neither, "obj, ply, off, stl, msh, msh2 or vtp"},
    {"input|output.vertices", integer, none, neither, "vertices"},
    {"input|output.faces", integer, none, neither, "triangles; polygons count as what they are cut into"},
    {"input|output.edges", integer, none, neither, "edges"},
    {"input|output.components", integer, none, neither, "parts that do not hang together"},
    {"input|output.boundary_loops", integer, none, neither, "closed lines of boundary edges"},
    {"input|output.euler", integer, none, neither, "Euler number: vertices in faces - edges + faces"},
    {"input|output.isolated_vertices", integer, none, neither, "vertices in no face"},
    {"input|output.junction_edges", integer, none, neither,
     "edges with three faces or more, kept by --keep non-manifold; all figures are those of the joined mesh"},
    {"input|output.bbox", object, length, neither, "bounding box"},
    {"input|output.bbox.min|max", list, length, neither, "its corner: x, y and z"},
    {"input|output.bbox.min|max.<n>", or_null(number), length, neither, "coordinate of the corner"},
    {"input|output.bbox_diagonal", or_null(number), length, neither, "diagonal of the bounding box"},
    {"input|output.area", or_null(number), "file units^2", neither, "area of the surface"},
    {"input|output.volume", or_null(number), "file units^3", neither,
     "volume inside; null if there is a boundary"},
    {"input|output.connectivity_sha256", or_null(text), none, neither,
     "SHA-256 of the triangles' vertex ids: equal where the faces are"},
};

constexpr Row head[] = {
    {"schema", text, none, neither, "hooke-remesh/report/1"},
    {"tool", object, none, neither, "what made the report"},
    {"tool.name", text, none, neither, "hooke-remesh"},
    {"tool.version", text, none, neither, "its version"},
    {"status", text, none, neither,
     "how the run ended: converged; stalled = at rest, as near to the target as the connectivity allows; "
     "jammed = no step gets anywhere; iteration_limit; interrupted; time_limit; checked"},
};

constexpr Row parameters[] = {
    {"parameters", object, none, neither, "every value used; null for what has no part in the run"},
    {"parameters.paper", boolean, none, neither, "--paper"},
    {"parameters.connectivity", or_null(text), none, neither, "--connectivity: fixed, flip or adapt"},
    {"parameters.effort", or_null(text), none, neither, "--effort: fast, default or thorough"},
    {"parameters.flow_rounds", or_null(integer), none, neither, "rounds of Lloyd's steps between flips"},
    {"parameters.adapt_rounds", or_null(integer), none, neither, "rounds of splits and collapses"},
    {"parameters.coarse_levels", or_null(integer), none, neither,
     "how many times target lengths may be doubled for a first mesh"},
    {"parameters.last_outer", or_null(integer), none, neither, "outer iterations after the adaptation"},
    {"parameters.last_steps", or_null(integer), none, neither, "steps in each of these"},
    {"parameters.coarse_flow_rounds", or_null(integer), none, neither,
     "rounds of Lloyd's steps for each coarser mesh"},
    {"parameters.last_flow_rounds", or_null(integer), none, neither,
     "rounds of Lloyd's steps after the adaptation"},
    {"parameters.integrator", or_null(text), none, neither, "--integrator: lbfgs or damped"},
    {"parameters.polish", or_null(boolean), none, neither, "--polish"},
    {"parameters.polish_from", or_null(number), degrees, neither, "angle springs: first threshold"},
    {"parameters.polish_margin", or_null(number), degrees, neither,
     "how far above the least angle that threshold is at least"},
    {"parameters.polish_step", or_null(number), degrees, neither, "from one threshold to the next"},
    {"parameters.polish_up_to", or_null(number), degrees, neither, "last threshold"},
    {"parameters.polish_sweeps", or_null(integer), none, neither, "sweeps over the vertices per threshold"},
    {"parameters.polish_edge_limit", or_null(number), ratio, neither,
     "limit of the edges' deviation over that before"},
    {"parameters.near_regular_angle", or_null(number), degrees, neither,
     "least angle of an input that counts as near-regular"},
    {"parameters.near_regular_deviation", or_null(number), ratio, neither,
     "its edges' standard deviation over their mean, at most"},
    {"parameters.near_regular_reach", or_null(number), targets, neither, "how far its vertices may travel"},
    {"parameters.filter", text, none, neither, "--filter: local, global, closest or none"},
    {"parameters.kernel", or_null(text), none, neither, "--kernel: r2logr or r3"},
    {"parameters.rho", or_null(number), "parameters.rho_unit", neither,
     "--rho: offset of the field's second points"},
    {"parameters.rho_unit", or_null(text), none, neither, "--rho-unit: edge (mean edge length) or file"},
    {"parameters.reach", or_null(number), targets, neither,
     "how far from the faces the spline may swing out"},
    {"parameters.refit", or_null(text), none, neither, "--refit: each or once"},
    {"parameters.altitude", number, none, neither, "--altitude: weight of altitude springs"},
    {"parameters.string", or_null(number), none, neither, "--string: tension"},
    {"parameters.torque", or_null(number), none, neither, "--torque: coefficient"},
    {"parameters.friction", or_null(number), none, neither, "--friction"},
    {"parameters.tolerance", number, ratio, neither, "--tolerance: length error of a converged mesh"},
    {"parameters.max_outer", integer, none, neither, "--max-outer: outer iterations"},
    {"parameters.outer_drop", or_null(number), ratio, neither,
     "stalled when an iteration lowers the energy by less than this share"},
    {"parameters.energy_drop", or_null(number), ratio, neither,
     "an iteration ends when steps lower the energy by less than this share"},
    {"parameters.hindered", or_null(number), ratio, neither,
     "stalled at rest with no more than this share of steps shortened by guards"},
    {"parameters.max_steps", integer, none, neither, "--max-steps: steps in an outer iteration"},
    {"parameters.boundary", text, none, neither, "--boundary: slide, fixed or free"},
    {"parameters.corner_angle", or_null(number), degrees, neither,
     "turn of the boundary from which on a vertex is a corner"},
    {"parameters.feature_angle", or_null(number), degrees, neither, "--feature-angle; null if off"},
    {"parameters.feature_noise", or_null(text), none, neither, "--feature-noise: auto or off"},
    {"parameters.fixed_vertices", integer, none, neither, "vertices held by --fix"},
    {"parameters.guard_area_ratio", or_null(number), ratio, neither,
     "guards: area of a face after a step over that before, at least"},
    {"parameters.guard_alignment", or_null(number), "cosine", neither,
     "between normals of face and surface, at least"},
    {"parameters.guard_fold", or_null(number), "cosine", neither,
     "between the normals of adjacent faces, at least"},
    {"parameters.guard_sagitta", or_null(number), targets, neither,
     "how far the surface may rise over an edge"},
    {"parameters.search_sagitta", or_null(number), targets, neither,
     "the same for the last search on the worst faces"},
    {"parameters.sliver_angles", or_null(list), degrees, neither,
     "slivers: faces with a smaller angle, by stage"},
    {"parameters.sliver_angles.<n>", number, degrees, neither, "angle of a stage"},
    {"parameters.sliver_passes", or_null(integer), none, neither, "passes over the slivers"},
    {"parameters.sliver_sagitta", or_null(number), targets, neither,
     "how far the surface may rise over an edge that they change"},
    {"parameters.filter_every", or_null(text), none, neither, "--filter-every: step or outer; with --paper"},
    {"parameters.step_angle", or_null(number), "cosine", neither, "--step-angle; with --paper"},
    {"parameters.step_expansion", or_null(number), ratio, neither, "--step-expansion; with --paper"},
    {"parameters.step_displacement", or_null(number), ratio, neither, "--step-displacement; with --paper"},
    {"parameters.step_area", or_null(number), "L^2", neither, "--step-area; with --paper"},
    {"parameters.repair", boolean, none, neither, "--repair"},
    {"parameters.weld", text, none, neither, "--weld, as given"},
    {"parameters.drop_components", number, ratio, neither, "--drop-components: share of the area"},
    {"parameters.fill_holes", integer, none, neither, "--fill-holes: edges; 0 for none"},
    {"parameters.keep", or_null(text), none, neither, "--keep; null where faces stay"},
    {"parameters.max_distance", or_null(number), length, neither, "--max-distance; null unless it is given"},
    {"parameters.distance_limit", or_null(text), none, neither,
     "how far the surfaces may be apart: given (--max-distance), curvature (by that of the input), or off"},
    {"parameters.accept_invalid", or_null(boolean), none, neither, "--accept-invalid"},
    {"parameters.time_limit", or_null(number), seconds, neither, "--time-limit; null for none"},
    {"parameters.preserve", or_null(text), none, neither, "whether --preserve could act: on or off"},
    {"parameters.reproject_uv", or_null(text), none, neither, "--reproject-uv: on or off"},
    {"parameters.L", number, length, neither,
     "target length, mean over the edges, before --min-length; without the ratios of quadrilaterals"},
    {"parameters.L_min", number, length, neither, "least target length, likewise"},
    {"parameters.L_max", number, length, neither, "greatest target length"},
    {"parameters.L_spec", text, none, neither, "--length, as given"},
    {"parameters.L_natural", number, length, neither,
     "natural length sqrt(4 A / (sqrt 3 F)) of area A and F faces"},
    {"parameters.sizing", text, none, neither, "--sizing, as given"},
    {"parameters.edge_lengths", or_null(text), none, neither, "--edge-lengths: the file"},
    {"parameters.min_length", or_null(number), length, neither, "--min-length; null without"},
    {"parameters.gradation", or_null(number), ratio, neither,
     "--gradation; null without limit, --sizing and --min-length"},
};

constexpr Row promises[] = {
    {"promises", or_null(object), none, neither,
     "what the result keeps of the input; null if not checked: with --paper and --check"},
    {"promises.kept", boolean, none, higher, "all of the following"},
    {"promises.flipped_faces", integer, none, lower, "faces turned over"},
    {"promises.new_folds", integer, none, lower, "folded edges more than in the input"},
    {"promises.new_self_intersections", integer, none, lower,
     "intersecting pairs of faces more than in the input, and where it has none"},
    {"promises.new_degenerate_faces", integer, none, lower,
     "faces without area more than in the input, and where it has none"},
    {"promises.topology_kept", boolean, none, higher,
     "components, boundary loops and Euler number; with --keep non-manifold also the junctions"},
    {"promises.creases_kept", boolean, none, higher, "creases within half an edge"},
    {"promises.crease_loss", or_null(number), length, lower,
     "greatest distance of the input's creases from the result's"},
    {"promises.far_vertices", integer, none, lower, "vertices too far from the input's surface"},
    {"promises.lost_vertices", integer, none, lower,
     "vertices of the input too far from the result's surface"},
    {"promises.distance_over_limit", or_null(number), ratio, lower,
     "the greatest distance of these over what is allowed there; 0 if none"},
    {"promises.place", list, length, neither,
     "where that is, or else a face that is turned over, crosses another or has no area, or a lost crease: "
     "x, y and z"},
    {"promises.place.<n>", or_null(number), length, neither, "coordinate of the place"},
    {"promises.rescue", text, none, neither,
     "how the result came to keep it: none; tips = made again with lost vertices held; junctions = with "
     "those of edges of three faces or more held; closest = on the input's faces; put_back = vertices went "
     "back or were held where they were; kept_faces = faces of the input stay"},
    {"promises.rescued_parts", integer, none, neither,
     "connected parts, remeshed by themselves, of which that tells; 0: of the whole"},
    {"promises.shortened_vertices", integer, none, neither,
     "vertices at which mode adapt took less than .8 of the target length, to keep the surface"},
    {"promises.lengths_of_input", boolean, none, neither,
     "edges got the lengths that the input has, as even ones would have made worse faces; of modes fixed and "
     "flip"},
};

constexpr Row after_statistics[] = {
    {"before|after.faces_below_20", integer, none, lower, "faces with an angle below 20 degrees"},
    {"before|after.faces_below_30", integer, none, lower, "faces with an angle below 30 degrees"},
    {"before|after.folded_edges", integer, none, lower,
     "edges whose faces lie against each other, but for creases"},
    {"before|after.self_intersections", or_null(integer), none, lower, "pairs of faces that intersect"},
    {"before|after.degenerate_faces", integer, none, lower,
     "faces of less than 1e-14 of the box's squared diagonal"},
    {"before|after.valence", object, none, neither, "how many vertices have how many edges"},
    {"before|after.valence.interior|boundary", object, none, neither,
     "of vertices there, by number of edges"},
    {"before|after.valence.interior|boundary.<name>", integer, none, neither,
     "vertices with <name> edges; only where there are some"},
    {"before|after.mean_curvature", object, "1 / file units", neither, "at interior vertices"},
    {"before|after.mean_curvature.min|mean|max", or_null(number), "1 / file units", neither,
     "least, mean and greatest mean curvature"},
    {"before|after.gaussian_curvature", object, "1 / file units^2", neither, "at interior vertices"},
    {"before|after.gaussian_curvature.min|mean|max", or_null(number), "1 / file units^2", neither,
     "least, mean and greatest Gaussian curvature"},
    {"before|after.polygon_angles", or_null(object), none, neither,
     "angles at the corners of the file's polygons with more than three, if faces stay; else null"},
    {"before|after.polygon_angles.min", number, degrees, higher, "least angle"},
    {"before|after.polygon_angles.max", number, degrees, lower, "greatest angle; above 180 if concave"},
    {"before|after.polygon_angles.rms_deviation", number, degrees, lower,
     "root mean square of the difference from a regular polygon's, 90 of a quadrilateral"},
    {"before|after.worst_faces", list, none, neither,
     "the worst face of each of the ten worst regions, least angle first"},
    {"before|after.worst_faces.<n>", object, none, neither, "one of them"},
    {"before|after.worst_faces.<n>.face", integer, none, neither, "its id"},
    {"before|after.worst_faces.<n>.min_angle", or_null(number), degrees, neither, "its least angle"},
    {"before|after.worst_faces.<n>.vertices", list, none, neither, "ids of its vertices"},
    {"before|after.worst_faces.<n>.vertices.<n>", integer, none, neither, "id of a vertex"},
    {"before|after.worst_faces.<n>.centre", list, length, neither, "its centre: x, y and z"},
    {"before|after.worst_faces.<n>.centre.<n>", or_null(number), length, neither, "coordinate of the centre"},
    {"before|after.worst_faces.<n>.bound", or_null(number), degrees, neither,
     "no least angle here can be greater with this connectivity"},
    {"before|after.worst_faces.<n>.bound_vertices", list, none, neither, "ids of the vertices that bound it"},
    {"before|after.worst_faces.<n>.bound_vertices.<n>", integer, none, neither, "id of a vertex"},
    {"before|after.worst_faces.<n>.reasons", list, none, neither,
     "what holds the angle down; empty where unknown"},
    {"before|after.worst_faces.<n>.reasons.<n>", text, none, neither,
     "corner, boundary, crease, fixed, valence, guard, put_back (a vertex went back to keep the surface), or "
     "lengths (only equal edges are in its way)"},
};

constexpr Row geometry[] = {
    {"geometry", or_null(object), none, neither, "the result against the input"},
    {"geometry.displacement", or_null(object), length, neither,
     "how far vertices moved; null with --connectivity adapt, where they do not correspond"},
    {"geometry.displacement.max", or_null(number), length, neither, "farthest move"},
    {"geometry.displacement.rms", or_null(number), length, neither, "root mean square"},
    {"geometry.distance_to_input", object, length, neither, "from the result's surface to the input's"},
    {"geometry.distance_from_input", object, length, neither, "from the input's surface to the result's"},
    {"geometry.distance_to_input|distance_from_input.max", or_null(number), length, lower,
     "greatest distance, at ten samples per face"},
    {"geometry.distance_to_input|distance_from_input.rms", or_null(number), length, lower,
     "root mean square over the area"},
    {"geometry.distance_to_input|distance_from_input.max_over_diagonal", or_null(number), ratio, lower,
     "greatest distance over the input's box diagonal"},
    {"geometry.distance_to_input|distance_from_input.rms_over_diagonal", or_null(number), ratio, lower,
     "root mean square over that diagonal"},
    {"geometry.normal_deviation", object, degrees, neither,
     "between normals of a face and of the input's face closest to its centre"},
    {"geometry.normal_deviation.max", or_null(number), degrees, lower, "greatest"},
    {"geometry.normal_deviation.rms", or_null(number), degrees, lower, "root mean square over the area"},
    {"geometry.area_change", or_null(number), ratio, nearer_zero, "area over that of the input, - 1"},
    {"geometry.volume_change", or_null(number), ratio, nearer_zero,
     "volume over that of the input, - 1; null unless both are closed"},
    {"geometry.flipped_faces", integer, none, lower, "faces turned over"},
    {"geometry.overhangs", integer, none, lower,
     "faces that look down where all of the input look up, or so along another axis, as in a terrain"},
    {"geometry.boundary_distance", object, length, neither, "between the boundaries"},
    {"geometry.boundary_distance.to_input", or_null(number), length, lower,
     "from the result's boundary to the input's; null unless both have one"},
    {"geometry.boundary_distance.from_input", or_null(number), length, lower,
     "from the input's boundary to the result's"},
    {"geometry.folded_faces", list, none, neither,
     "ids of faces that lie against the surface or at folds of the input"},
    {"geometry.folded_faces.<n>", integer, none, neither, "id of a face"},
};

constexpr Row course[] = {
    {"iterations", list, none, neither, "what was done, in order"},
    {"iterations.<n>", object, none, neither, "an outer iteration or another stage"},
    {"iterations.<n>.stage", text, none, neither, "name of the stage, such as relax"},
    {"iterations.<n>.outer", or_null(integer), none, neither,
     "number of the outer iteration, from 1; null for other stages"},
    {"iterations.<n>.steps", integer, none, neither, "steps"},
    {"iterations.<n>.evaluations", integer, none, neither, "evaluations of the energy"},
    {"iterations.<n>.energy", or_null(number), "L^2", neither, "energy of the springs at its end"},
    {"iterations.<n>.max_length_error", or_null(number), ratio, neither,
     "greatest deviation of a length from its target, over that"},
    {"iterations.<n>.rms_length_error", or_null(number), ratio, neither, "its root mean square"},
    {"iterations.<n>.min_angle", or_null(number), degrees, neither, "least angle"},
    {"iterations.<n>.field_evaluations", integer, none, neither, "evaluations of the field"},
    {"iterations.<n>.t_s", number, seconds, neither, "time since the start of the run"},
    {"projection", or_null(object), none, neither, "projections of vertices to the surface"},
    {"projection.calls", integer, none, neither, "projections"},
    {"projection.field_evaluations", integer, none, neither, "evaluations of the field"},
    {"projection.no_cover", integer, none, neither, "ended on the faces: no spline there"},
    {"projection.flat_gradient", integer, none, neither, "ended on the faces: the field is flat there"},
    {"projection.too_far", integer, none, neither, "ended on the faces: Newton's method went astray"},
    {"projection.step_limit", integer, none, neither, "ended on the faces: Newton's method did not converge"},
    {"projection.not_landed", integer, none, neither,
     "vertices left off the field of the input, as a face would fold"},
    {"held_back", or_null(integer), none, neither, "steps of vertices that guards shortened"},
    {"near_regular", or_null(boolean), none, neither,
     "the input was well shaped already: its angles are kept, and no vertex moves by a fifth of L"},
    {"steps_smoothed", or_null(boolean), none, neither,
     "the input is the surface of a binary mask, whose steps were taken for noise and smoothed"},
    {"features", or_null(object), none, neither, "creases; null if there are none"},
    {"features.chains", integer, none, neither, "creases, from corner to corner or closed"},
    {"features.crease_edges", integer, none, neither, "edges on them"},
    {"features.seam_edges", integer, none, neither,
     "edges of the input across which texture coordinates, normals, materials, groups or labels change"},
    {"features.sharp_edges", integer, none, neither, "edges of the input sharper than the feature angle"},
    {"features.sharp_edges_dropped", integer, none, neither, "of these, taken for noise"},
    {"features.corners", integer, none, neither, "vertices where creases end or meet, which stay"},
    {"features.curve_vertices", integer, none, neither, "other vertices on creases"},
    {"features.charts", integer, none, neither, "smooth pieces between creases"},
    {"flips", or_null(object), none, neither, "what flip and adapt did; null with fixed"},
    {"flips.flips", integer, none, neither, "edges flipped"},
    {"flips.flow_rounds", integer, none, neither, "rounds of Lloyd's steps"},
    {"flips.spring_rounds", integer, none, neither, "rounds of springs between flips"},
    {"flips.passes", integer, none, neither, "passes of flips on trial"},
    {"flips.max_travel", or_null(number), targets, neither, "farthest travel of a vertex; null with adapt"},
    {"flips.rms_travel", or_null(number), targets, neither, "its root mean square; null with adapt"},
    {"adaptation", or_null(object), none, neither, "what adapt did; null in other modes"},
    {"adaptation.coarse_levels", integer, none, neither,
     "how many times the faces of a coarser mesh became four"},
    {"adaptation.rounds", integer, none, neither, "rounds of splits and collapses"},
    {"adaptation.count_rounds", integer, none, neither, "rounds to get the number of faces"},
    {"adaptation.splits", integer, none, neither, "edges split"},
    {"adaptation.collapses", integer, none, neither, "edges collapsed"},
    {"adaptation.flips", integer, none, neither, "edges flipped"},
    {"adaptation.wanted_faces", or_null(number), none, neither,
     "faces that the target lengths ask for, before those of parts by themselves are shortened"},
};

constexpr Row messages[] = {
    {"gates", list, none, neither, "conditions of --require, in order"},
    {"gates.<n>", object, none, neither, "one of them"},
    {"gates.<n>.condition", text, none, neither, "as it was given"},
    {"gates.<n>.value", or_null(number), none, neither, "the number found; null if the report has none"},
    {"gates.<n>.passed", boolean, none, neither, "whether it holds"},
    {"comparison", or_null(object), none, neither, "with --compare: against an older report"},
    {"comparison.base", text, none, neither, "the file of that report"},
    {"comparison.rtol", number, ratio, neither, "--rtol: what counts as worse"},
    {"comparison.compared", integer, none, neither, "numbers compared"},
    {"comparison.worse", list, none, neither, "numbers that got worse"},
    {"comparison.worse.<n>", object, none, neither, "one of them"},
    {"comparison.worse.<n>.key", text, none, neither, "its path"},
    {"comparison.worse.<n>.base", number, none, neither, "what it was"},
    {"comparison.worse.<n>.value", number, none, neither, "what it is"},
    {"comparison.not_comparable", list, none, neither,
     "why the two are hard to compare, or what is in one only"},
    {"comparison.not_comparable.<n>", text, none, neither, "a reason, in words"},
    {"warnings", list, none, neither, "warnings"},
    {"warnings.<n>", object, none, neither, "one of them"},
    {"warnings.<n>.code", text, none, neither, "name of its kind, which stays the same"},
    {"warnings.<n>.message", text, none, neither, "for people"},
    {"repairs", list, none, neither, "what was done to the input before anything else"},
    {"repairs.<n>", object, none, neither, "a kind of change"},
    {"repairs.<n>.code", text, none, neither, "name of the kind, such as corners_welded or edges_cut"},
    {"repairs.<n>.count", integer, none, neither, "how many there were"},
    {"repairs.<n>.message", text, none, neither, "for people, with the first five places"},
};

constexpr Row paper[] = {
    {"paper", object, none, neither, "the columns of the paper's tables 1 to 3"},
    {"paper.before", object, none, neither, "of the input"},
    {"paper.after", or_null(object), none, neither, "of the result"},
    {"paper.before|after.vertices", integer, none, neither, "vertices"},
    {"paper.before|after.least_angle_rad", or_null(number), "rad", neither, "least angle"},
    {"paper.before|after.edge_length_sd", or_null(number), length, neither,
     "standard deviation of the edge lengths"},
    {"paper.before|after.mean_curvature", object, "1 / file units", neither, "at interior vertices"},
    {"paper.before|after.gaussian_curvature", object, "1 / file units^2", neither, "at interior vertices"},
    {"paper.before|after.fitted_mean_curvature", or_null(object), "1 / file units", neither,
     "by quadrics over two rings; only with --paper"},
    {"paper.before|after.fitted_gaussian_curvature", or_null(object), "1 / file units^2", neither,
     "by quadrics over two rings; only with --paper"},
    {"paper.before|after.mean_curvature|fitted_mean_curvature.min|mean|max", or_null(number),
     "1 / file units", neither, "least, mean and greatest"},
    {"paper.before|after.gaussian_curvature|fitted_gaussian_curvature.min|mean|max", or_null(number),
     "1 / file units^2", neither, "least, mean and greatest"},
    {"paper.before|after.string_energy", or_null(number), "L^2", neither, "energy of the strings"},
    {"paper.before|after.altitude_energy", or_null(number), "L^2", neither, "energy of the altitude springs"},
    {"paper.greatest_displacement", or_null(number), length, neither, "farthest move of a vertex"},
    {"paper.evolution", list, none, neither,
     "outer iterations of --paper; lengths there are mean target lengths"},
    {"paper.evolution.<n>", object, none, neither, "an outer iteration"},
    {"paper.evolution.<n>.outer", integer, none, neither, "its number, from 1"},
    {"paper.evolution.<n>.steps", integer, none, neither, "its time steps"},
    {"paper.evolution.<n>.time", number, "time of the evolution", neither, "time at its end"},
    {"paper.evolution.<n>.dt", number, "time of the evolution", neither, "its last time step"},
    {"paper.evolution.<n>.string_energy", number, "L^2", neither, "energy of the strings at its end"},
    {"paper.evolution.<n>.altitude_energy", number, "L^2", neither, "energy of the altitude springs"},
    {"paper.evolution.<n>.kinetic_energy", number, "of the evolution", neither, "kinetic energy"},
    {"paper.evolution.<n>.greatest_force", number, "of the evolution", neither, "greatest force on a vertex"},
    {"paper.evolution.<n>.greatest_length_error", number, "L", neither,
     "greatest deviation of a length from its target"},
    {"paper.evolution.<n>.bound", object, none, neither, "what bound the time steps"},
    {"paper.evolution.<n>.bound.angle|expansion|displacement|area|none", integer, none, neither,
     "steps bound by the test of that name"},
};

constexpr Row resources[] = {
    {"resources", object, none, neither, "what varies from run to run"},
    {"resources.threads", integer, none, neither, "threads"},
    {"resources.wall_s", number, seconds, neither, "time by the clock"},
    {"resources.cpu_s", number, seconds, neither, "time of all processors"},
    {"resources.peak_rss_bytes", integer, bytes, neither, "greatest memory in use"},
    {"resources.stages", object, none, neither, "by stage; the parts of a stage have a / in their names"},
    {"resources.stages.<name>", object, none, neither, "a stage, such as read or remesh/fit"},
    {"resources.stages.<name>.calls", integer, none, neither, "how many times it ran"},
    {"resources.stages.<name>.wall_s", number, seconds, neither, "time by the clock"},
    {"resources.stages.<name>.cpu_s", number, seconds, neither, "time of all processors"},
    {"resources.stages.<name>.peak_rss_bytes", integer, bytes, neither, "greatest memory in use at its end"},
};

/// The parts of a text between the separators.
std::vector<std::string> split(const std::string& joined, char separator) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= joined.size();) {
    const size_t end = std::min(joined.find(separator, begin), joined.size());
    parts.push_back(joined.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// The paths that a path with alternatives stands for.
std::vector<std::string> alternatives(const std::string& path) {
  std::vector<std::string> paths = {""};
  for (const std::string& part : split(path, '.')) {
    std::vector<std::string> longer;
    for (const std::string& begun : paths)
      for (const std::string& key : split(part, '|'))
        longer.push_back(begun.empty() ? key : fmt::format("{}.{}", begun, key));
    paths = std::move(longer);
  }
  return paths;
}

/// Adds the keys of the rows, those of each block together.
template <size_t count>
void add_rows(std::vector<ReportKey>& keys, const Row (&rows)[count], const std::string& block = "") {
  for (const Row& row : rows)
    for (const std::string& path : alternatives(row.path))
      if (block.empty() || path.starts_with(block + "."))
        keys.push_back(
            {path, row.type.kind, row.type.may_be_null, row.unit, row.better, row.meaning, false, row.path});
}

void add_object(std::vector<ReportKey>& keys, const char* path, ValueType type, const char* meaning) {
  keys.push_back({path, type.kind, type.may_be_null, none, neither, meaning, false, path});
}

void add_quality(std::vector<ReportKey>& keys, const std::string& block) {
  add_statistics(keys, block);
  add_rows(keys, after_statistics, block);
}

/// Keys of a run's result, which --check has none of, and all that is in them.
bool is_of_result(const std::string& path) {
  constexpr std::string_view blocks[] = {"output",         "promises",
                                         "after",          "geometry",
                                         "iterations",     "projection",
                                         "held_back",      "near_regular",
                                         "steps_smoothed", "features",
                                         "flips",          "adaptation",
                                         "paper.after",    "paper.greatest_displacement",
                                         "paper.evolution"};
  return std::ranges::any_of(blocks, [&](std::string_view block) {
    return path == block || (path.starts_with(block) && path[block.size()] == '.');
  });
}

std::vector<ReportKey> all_keys() {
  std::vector<ReportKey> keys;
  add_rows(keys, head);
  add_object(keys, "input", object, "the input file and its mesh, after repair");
  add_rows(keys, files, "input");
  add_object(keys, "output", or_null(object), "the output file and its mesh");
  add_rows(keys, files, "output");
  keys.push_back({"output.preserved", KeyKind::boolean, true, none, neither,
                  "the file is the input with other coordinates", false, "output.preserved"});
  add_rows(keys, parameters);
  add_rows(keys, promises);
  add_object(keys, "before", object, "quality of the input; some figures are null where no face has one");
  add_quality(keys, "before");
  add_object(keys, "after", or_null(object), "quality of the mesh in the output file");
  add_quality(keys, "after");
  add_rows(keys, geometry);
  add_rows(keys, course);
  add_rows(keys, messages);
  add_rows(keys, paper);
  add_rows(keys, resources);
  for (ReportKey& key : keys) key.of_result = is_of_result(key.path);
  return keys;
}

}  // namespace
}  // namespace report_table

const std::vector<ReportKey>& report_keys() {
  static const std::vector<ReportKey> keys = report_table::all_keys();
  return keys;
}

}  // namespace hooke
