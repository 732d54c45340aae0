#include "words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <system_error>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_format.h"
#include "hooke/remesh/options.h"
#include "hooke/springs/sizing.h"

namespace hooke::app {
namespace {

/// A number and the text after it; NaN if the text does not start with a number.
struct NumberAndUnit {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string_view unit;
};

NumberAndUnit split(std::string_view text) {
  NumberAndUnit result;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, result.value);
  if (error != std::errc()) return {};
  result.unit = std::string_view(rest, end);
  return result;
}

/// Parses "0.1%" or ".001", relative to the target length.
double parse_tolerance(const std::string& text) {
  const auto [value, unit] = split(text);
  if (!(unit.empty() || unit == "%") || !(value >= 0) || !std::isfinite(value))
    throw Error(
        fmt::format("--tolerance {}; expected a number that is not negative, or X% of the target length",
                    in_quotes(text)));
  return unit == "%" ? value / 100 : value;
}

/// Parses "off" (infinity) or a positive number.
double parse_gradation(const std::string& text) {
  if (text == "off") return std::numeric_limits<double>::infinity();
  const auto [value, unit] = split(text);
  if (!unit.empty() || !(value > 0) || !std::isfinite(value))
    throw Error(fmt::format("--gradation {}; expected a positive number, or off", in_quotes(text)));
  return value;
}

/// Sets the maximum distance: "off" (infinity), a positive length, or X% of the diagonal.
void set_max_distance(const std::string& text, Settings& s) {
  const auto [value, unit] =
      text == "off" ? NumberAndUnit{std::numeric_limits<double>::infinity(), ""} : split(text);
  if (!(unit.empty() || unit == "%") || !(value > 0) || (std::isinf(value) && text != "off"))
    throw Error(fmt::format("--max-distance {}; expected a positive number, X% of the diagonal, or off",
                            in_quotes(text)));
  if (unit == "%")
    s.max_distance_share = value / 100;
  else
    s.preservation.max_distance = value;
}

/// Sets the distance of --weld: a length that is not negative, or X% of the diagonal.
void set_weld(const std::string& text, RepairOptions& repair) {
  const auto [value, unit] = split(text);
  if (!(unit.empty() || unit == "%") || !(value >= 0) || !std::isfinite(value))
    throw Error(fmt::format("--weld {}; expected a number that is not negative, or X% of the diagonal",
                            in_quotes(text)));
  if (unit == "%")
    repair.weld_share = value / 100;
  else
    repair.weld = value;
}

/// Parses a share of the area such as "1%", or "off" (0).
double parse_share(const std::string& text) {
  if (text == "off") return 0;
  const auto [value, unit] = split(text);
  if (unit != "%" || !(value > 0) || !(value <= 100))
    throw Error(
        fmt::format("--drop-components {}; expected X% of the area, from 0 to 100, or off", in_quotes(text)));
  return value / 100;
}

/// Parses the greatest number of edges of a hole to fill, or "off" (0).
int parse_hole_edges(const std::string& text) {
  if (text == "off") return 0;
  int edges = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, edges);
  if (error != std::errc() || rest != end || edges < 3 || edges > 1000)
    throw Error(
        fmt::format("--fill-holes {}; expected a whole number from 3 to 1000, or off", in_quotes(text)));
  return edges;
}

/// Parses an angle in degrees such as "40", or "off" (180).
double parse_feature_angle(const std::string& text) {
  if (text == "off") return 180;
  const auto [value, unit] = split(text);
  if (!unit.empty() || !(value > 0) || !(value < 180))
    throw Error(
        fmt::format("--feature-angle {}; expected degrees between 0 and 180, or off", in_quotes(text)));
  return value;
}

/// Parses "none" or words with commas between them. `non-manifold` alone leaves the default as it is.
void parse_keep(const std::string& text, SeamKinds& keep, bool& junctions) {
  if (text == "non-manifold") {
    junctions = true;
    return;
  }
  keep = {false, false, false, false};
  if (text == "none") return;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (word == "seams")
      keep.texture = true;
    else if (word == "hard-edges")
      keep.hard_edges = true;
    else if (word == "materials")
      keep.materials = true;
    else if (word == "groups")
      keep.groups = true;
    else if (word == "non-manifold")
      junctions = true;
    else
      throw Error(
          fmt::format("--keep {}; expected seams, hard-edges, materials, groups, non-manifold with commas "
                      "between them, or none",
                      in_quotes(text)));
    begin = end + 1;
  }
}

/// Returns parse(text). Puts the name of the option in front of the message of an Error.
template <typename Parse>
auto parsed(const char* option, const Parse& parse, const std::string& text) {
  try {
    return parse(text);
  } catch (const Error& e) {
    throw Error(fmt::format("{} {}", option, e.what()));
  }
}

/// The number of threads granted by a batch system or OpenMP; 0 if not specified.
int threads_of_environment() {
  for (const char* name : {"SLURM_CPUS_PER_TASK", "OMP_NUM_THREADS"}) {
    const char* text = std::getenv(name);
    if (!text) continue;
    int threads = 0;
    std::from_chars(text, text + std::string_view(text).size(), threads);
    if (threads > 0) return threads;
  }
  return 0;
}

LengthSpec parse_min_length(const std::string& text) {
  using Kind = LengthSpec::Kind;
  const auto fits = [](Kind kind) {
    return kind == Kind::absolute || kind == Kind::percent_of_diagonal || kind == Kind::times_natural;
  };
  try {
    if (const LengthSpec spec = parse_length(text); fits(spec.kind)) return spec;
  } catch (const Error&) {
  }
  throw Error(fmt::format("--min-length {}; expected off, or a positive number, alone or with % or x",
                          in_quotes(text)));
}

void resolve_sizing(Settings& s, const RawOptions& raw) {
  const bool sized = s.sizing_text != "off";
  if (sized) s.sizing = parsed("--sizing", parse_sizing, s.sizing_text);
  if (s.min_length_text != "off") s.min_length = parse_min_length(s.min_length_text);
  if (!raw.gradation.empty())
    s.remesh.gradation = parse_gradation(raw.gradation);
  else if (s.sizing.kind == SizingSource::Kind::input && s.remesh.connectivity != ConnectivityMode::adapt)
    s.remesh.gradation = std::numeric_limits<double>::infinity();
  if (!raw.gradation.empty() && !sized && !s.min_length)
    throw Error("--gradation is of --sizing and --min-length; leave it out, or give one of them");
  if (s.min_length && s.remesh.gradation > 1)
    throw Error(
        fmt::format("--gradation {} with --min-length; expected at most 1, as edges cannot get longer "
                    "any faster",
                    in_quotes(raw.gradation)));
  if (sized) return;
  if (s.length.kind == LengthSpec::Kind::as_given)
    throw Error("--length sizing without --sizing; name a sizing, or another length");
}

/// Throws Error for options that would have no effect with the others.
void reject_unused_options(const Settings& s, const RawOptions& raw) {
  const auto refuse = [&](bool idle, std::initializer_list<const char*> options, const char* why) {
    for (const char* option : options)
      if (idle && raw.given(option)) throw Error(fmt::format("{} {}; leave it out", option, why));
  };
  refuse(s.paper,
         {"--effort", "--feature-angle", "--feature-noise", "--map", "--integrator", "--polish",
          "--max-distance", "--accept-invalid"},
         "has no part in --paper");
  refuse(s.paper && s.remesh.connectivity != ConnectivityMode::fixed, {"--connectivity"},
         "changes faces, which --paper keeps");
  refuse(s.paper && s.remesh.filter.kind != FilterKind::global, {"--filter"},
         "names another filter than the global one of --paper");
  refuse(!s.paper,
         {"--step-angle", "--step-expansion", "--step-displacement", "--step-area", "--filter-every",
          "--trace-steps"},
         "is of --paper only");
  refuse(!s.paper && raw.rho_unit == OffsetUnit::file, {"--rho-unit"}, "file is of --paper only");
  refuse(!s.paper && s.remesh.integrator == IntegratorKind::lbfgs, {"--string", "--torque", "--friction"},
         "is of --integrator damped and --paper only");
  const bool splines =
      s.paper || s.remesh.filter.kind == FilterKind::local || s.remesh.filter.kind == FilterKind::global;
  refuse(!splines, {"--kernel", "--rho", "--rho-unit"}, "is of splines, which this --filter has none of");
  refuse(!s.paper && s.remesh.connectivity != ConnectivityMode::fixed, {"--edge-lengths"},
         "is of --connectivity fixed, where edges stay");
  refuse(s.min_length && (s.paper || s.remesh.connectivity != ConnectivityMode::adapt), {"--min-length"},
         "is of --connectivity adapt, where edges get shorter by new vertices");
  refuse(s.repair.repair || s.weld_text != "off", {"--edge-lengths"},
         "names edges that --repair and --weld may change");
  refuse(s.repair.keep_junctions, {"--edge-lengths"}, "is not of meshes with --keep non-manifold");
  refuse(raw.keep == "none" && s.remesh.connectivity == ConnectivityMode::fixed, {"--keep"},
         "none is of --connectivity flip and adapt; with fixed no borders are held by themselves");
  refuse(!s.repair.keep_junctions && s.paper, {"--keep"}, "is not of --paper, where no borders are held");
  if (s.repair.keep_junctions && *raw.keep != "non-manifold" && s.paper)
    throw Error(
        fmt::format("--keep {}: all words but non-manifold are not of --paper, where no borders are "
                    "held; write --keep non-manifold",
                    in_quotes(*raw.keep)));
  refuse(!s.paper && s.remesh.connectivity == ConnectivityMode::adapt, {"--refit"},
         "is of --connectivity fixed and flip; adapt keeps the field of the input");
  refuse(s.compare.empty(), {"--rtol"}, "is of --compare only");
  refuse(!s.repair.repair && s.repair.drop_components > 0, {"--drop-components"}, "is of --repair only");
  refuse(!s.repair.repair && s.repair.fill_holes > 0, {"--fill-holes"}, "is of --repair only");
  refuse(s.check, {"--map", "--output", "--fields", "--trace-steps"}, "is not written by --check");
  refuse(s.check, {"--preserve", "--reproject-uv", "--format"},
         "is of the output, which --check has none of");
  refuse(s.paper || s.remesh.connectivity != ConnectivityMode::fixed || !s.preserve, {"--reproject-uv"},
         "is of --connectivity fixed with --preserve on, and not of --paper");
}

/// Throws Error for options of a batch without one.
void reject_unused_batch_options(const Settings& s, const RawOptions& raw) {
  const bool to_folder = s.inputs.size() > 1 || !s.output.has_filename();
  if (!s.batch.suffix.empty() && !to_folder)
    throw Error("--suffix is of outputs in a folder; leave it out, or write --output FOLDER/");
  if (raw.given("--jobs") && s.inputs.size() == 1) throw Error("--jobs is of several inputs; leave it out");
  if (s.check && !s.batch.suffix.empty())
    throw Error("--suffix is of the output, which --check has none of; leave it out");
  if (s.check && s.batch.skip_existing)
    throw Error("--skip-existing is of the output, which --check has none of; leave it out");
}

/// Throws Error if a standard stream is used twice, or without its format.
void require_streams(const Settings& s) {
  if (is_standard_input(s.input) && !s.input_format)
    throw Error(
        "INPUT is standard input, which has no extension; give --input-format obj|ply|off|stl|msh|vtp");
  if (is_standard_input(s.input) && s.sizing.kind == SizingSource::Kind::ply_property)
    throw Error(
        "--sizing ply:PROPERTY reads the input a second time; expected a file, not standard input; name one");
  if (is_standard_output(s.output) && s.report == "-")
    throw Error("--output - and --report - both write to standard output; name a file for one of them");
}

MeshFormat format_of_output(const Settings& s) {
  if (!is_standard_output(s.output)) return format_of(s.output);
  throw Error("--output is standard output, which has no extension; give --format obj|ply|off|stl|msh|msh2");
}

}  // namespace

bool names_folder(const std::filesystem::path& path) {
  std::error_code error;
  return !path.empty() && (!path.has_filename() || std::filesystem::is_directory(path, error));
}

bool is_batch(const Settings& s) {
  return s.inputs.size() > 1 || (!s.output.empty() && !s.output.has_filename()) || !s.batch.table.empty() ||
         s.batch.skip_existing;
}

void resolve(Settings& s, const RawOptions& raw) {
  if (s.inputs.empty())
    throw Error("INPUT is required; expected the name of a mesh; see hooke-remesh --help");
  s.input = s.inputs.front();
  reject_unused_batch_options(s, raw);
  s.length = parsed("--length", parse_length, s.length_text);
  if (s.remesh.connectivity == ConnectivityMode::adapt) s.length.whose = LengthSpec::Natural::shorter;
  resolve_sizing(s, raw);
  if (s.remesh.connectivity == ConnectivityMode::fixed) s.keep = {false, false, false, false};
  if (raw.keep) parse_keep(*raw.keep, s.keep, s.repair.keep_junctions);
  if (raw.drop_components) s.repair.drop_components = parse_share(*raw.drop_components);
  if (raw.fill_holes) s.repair.fill_holes = parse_hole_edges(*raw.fill_holes);
  reject_unused_options(s, raw);
  require_streams(s);
  s.remesh.tolerance = s.paper_options.evolution.tolerance = parse_tolerance(raw.tolerance);
  s.remesh.map = !s.map.empty();
  s.paper_options.evolution.damped = s.remesh.damped;
  if (raw.given("--kernel")) s.paper_options.filter.kernel = s.remesh.filter.kernel;
  if (raw.feature_angle) s.remesh.constraints.features.angle = parse_feature_angle(*raw.feature_angle);
  s.preservation.feature_angle = s.remesh.constraints.features.angle;
  if (s.weld_text != "off") set_weld(s.weld_text, s.repair);
  s.repair.collapse = !s.paper && !s.check && s.remesh.connectivity == ConnectivityMode::adapt;
  if (raw.max_distance) set_max_distance(*raw.max_distance, s);
  if (raw.rho) s.remesh.filter.offset = s.paper_options.filter.offset = *raw.rho;
  if (raw.rho_unit) s.paper_options.filter.offset_unit = *raw.rho_unit;
  if (raw.altitude) s.remesh.altitude = s.paper_options.evolution.altitude = *raw.altitude;
  if (!s.edge_lengths.empty() && !raw.altitude) s.remesh.altitude = s.paper_options.evolution.altitude = 0;
  if (!s.edge_lengths.empty() && !raw.given("--polish")) s.remesh.polish_angles = false;
  if (raw.refit) s.remesh.refit = s.paper_options.refit = *raw.refit;
  s.remesh.max_outer = raw.max_outer;
  if (raw.max_outer) s.paper_options.max_outer = *raw.max_outer;
  s.remesh.max_steps = raw.max_steps;
  if (raw.max_steps) s.paper_options.evolution.max_steps = *raw.max_steps;
  if (raw.boundary) s.remesh.constraints.boundary = s.paper_options.constraints.boundary = *raw.boundary;
  if (s.threads == 0) s.threads = threads_of_environment();
  s.preserve_given = raw.given("--preserve");
  require_metrics(s.gates, s.check);
  if (s.check) return;
  if (s.output.empty()) throw Error("no output named; expected -o FILE, or --check to measure only");
  s.format_given = s.format.has_value();
  if (!s.format_given && !is_batch(s)) s.format = format_of_output(s);
}

}  // namespace hooke::app
