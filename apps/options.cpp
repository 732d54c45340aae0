#include "options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdlib>
#include <limits>

#include "exit_codes.h"
#include "hooke/error.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/printable.h"
#include "messages.h"

namespace hooke::app {
namespace {

/// "0.1%" or ".001": parts of the target length.
double parse_tolerance(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  const std::string_view unit(rest, end);
  if (error != std::errc() || !(unit.empty() || unit == "%") || !(value >= 0) || !std::isfinite(value))
    throw Error("--tolerance '" + printable(text) +
                "'; expected a number that is not negative, or X% of the target length");
  return unit == "%" ? value / 100 : value;
}

/// "off" or a positive number.
double parse_gradation(const std::string& text) {
  if (text == "off") return std::numeric_limits<double>::infinity();
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !(value > 0) || !std::isfinite(value))
    throw Error("--gradation '" + printable(text) + "'; expected a positive number, or off");
  return value;
}

/// "40" or "off": degrees, 180 for none.
double parse_feature_angle(const std::string& text) {
  if (text == "off") return 180;
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || !(value > 0) || !(value < 180))
    throw Error("--feature-angle '" + printable(text) + "'; expected degrees between 0 and 180, or off");
  return value;
}

/// Threads that a batch system or OpenMP grants; 0 when they say nothing.
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

/// What the user said in words, before it is given its meaning.
struct Words {
  std::string tolerance = "0.1%";
  std::string gradation;
  std::optional<std::string> feature_angle;
  std::optional<double> rho;
  std::optional<int> max_outer, max_steps;
  std::optional<BoundaryRule> boundary;
};

void add_options(CLI::App& app, Settings& s, Words& words) {
  const std::map<std::string, IntegratorKind> integrators{{"lbfgs", IntegratorKind::lbfgs},
                                                          {"damped", IntegratorKind::damped}};
  const std::map<std::string, ConnectivityMode> modes{{"fixed", ConnectivityMode::fixed},
                                                      {"flip", ConnectivityMode::flip},
                                                      {"adapt", ConnectivityMode::adapt}};
  const std::map<std::string, Effort> efforts{
      {"fast", Effort::fast}, {"default", Effort::standard}, {"thorough", Effort::thorough}};
  const std::map<std::string, FilterKind> filters{{"local", FilterKind::local},
                                                  {"global", FilterKind::global},
                                                  {"closest", FilterKind::closest},
                                                  {"none", FilterKind::none}};
  const std::map<std::string, Kernel> kernels{{"r2logr", Kernel::r2logr}, {"r3", Kernel::r3}};
  const std::map<std::string, Refit> refits{{"each", Refit::each}, {"once", Refit::once}};
  const std::map<std::string, BoundaryRule> boundaries{
      {"slide", BoundaryRule::slide}, {"fixed", BoundaryRule::fixed}, {"free", BoundaryRule::free}};
  const std::map<std::string, bool> switches{{"on", true}, {"off", false}};
  const std::map<std::string, ProgressStyle> styles{
      {"auto", ProgressStyle::automatic}, {"bar", ProgressStyle::bar}, {"none", ProgressStyle::none}};
  const auto one_of = [](const auto& map) { return CLI::CheckedTransformer(map).description(""); };
  DampedOptions& damped = s.remesh.damped;
  TimeStepOptions& step = s.paper_options.evolution.time_step;

  app.add_option("INPUT", s.input, "Mesh to read: .obj, .ply or .off")->required()->type_name("");
  app.add_option("-o,--output", s.output, "Mesh to write; required unless --check")->type_name("FILE");
  app.add_option("--format", s.format, "Format of the output: obj, ply or off (default: by extension)")
      ->check(CLI::IsMember({"obj", "ply", "off"}).description(""))
      ->type_name("NAME");

  const char* target = "Target";
  app.add_option(
         "-L,--length", s.length_text,
         "Target edge length: auto = sqrt(4 A / (sqrt 3 F)), mean = mean edge length, X in file units, "
         "X% of the box's diagonal, Xx times auto; with --sizing it scales the lengths: auto and Xx to cover "
         "the area, others to that mean, sizing = as they are")
      ->type_name("LENGTH")
      ->capture_default_str()
      ->group(target);
  app.add_option(
         "--sizing", s.sizing_text,
         "Target length per vertex: a file with one a line, a float property of a PLY input's "
         "vertices, or by curvature, for chord errors in file units or % of the box's diagonal (0.1%)")
      ->type_name("FILE|ply:PROPERTY|curvature[:ERROR]")
      ->default_str("off")
      ->group(target);
  app.add_option("--gradation", words.gradation,
                 "Greatest change of a sizing's lengths along an edge, over the edge's length")
      ->type_name("X|off")
      ->default_str("0.3")
      ->group(target);

  app.add_option("--connectivity", s.remesh.connectivity,
                 "fixed: the faces stay; flip: edges are flipped too: same vertex ids, but vertices travel; "
                 "adapt: new vertices and faces, as many as --length asks for")
      ->transform(one_of(modes))
      ->type_name("fixed|flip|adapt")
      ->default_str("fixed")
      ->group(target);

  app.add_option("--map", s.map,
                 "Where the output's vertices lie on the input: per line its vertex id there or -1, a face "
                 "of the input and three weights of that face's corners")
      ->type_name("FILE")
      ->group(target);

  const char* method = "Method";
  app.add_option("--effort", s.effort, "How long to go on for better triangles")
      ->transform(one_of(efforts))
      ->type_name("fast|default|thorough")
      ->default_str("default")
      ->group(method);
  app.add_option("--integrator", s.remesh.integrator,
                 "lbfgs: minimise the springs' energy; damped: follow the paper's equation of motion")
      ->transform(one_of(integrators))
      ->type_name("lbfgs|damped")
      ->default_str("lbfgs")
      ->group(method);
  app.add_option("--polish", s.remesh.polish_angles, "Angle springs on the worst faces after the equilibrium")
      ->transform(one_of(switches))
      ->type_name("on|off")
      ->default_str("on")
      ->group(method);
  app.add_flag(
         "--paper", s.paper,
         "Algorithms 1 to 3 of the paper to the letter, for comparison: global time step, torque, global "
         "spline, the paper's constants; mostly jams, may fold faces")
      ->group(method);
  app.add_option(
         "--filter", s.remesh.filter.kind,
         "Where vertices are put back: local = splines blended over patches, global = one dense spline, "
         "closest = the input's faces, none")
      ->transform(one_of(filters))
      ->type_name("local|global|closest|none")
      ->default_str("local")
      ->group(method);
  app.add_option("--kernel", s.remesh.filter.kernel, "Kernel of the splines")
      ->transform(one_of(kernels))
      ->type_name("r2logr|r3")
      ->default_str("r3; r2logr with --paper")
      ->group(method);
  app.add_option("--refit", s.remesh.refit, "Fit the field anew before each outer iteration, or once")
      ->transform(one_of(refits))
      ->type_name("each|once")
      ->default_str("each")
      ->group(method);
  app.add_option("--altitude", s.remesh.altitude, "Weight of the altitude springs against the strings")
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--string", damped.string, "String tension lambda (damped and paper)")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--torque", damped.torque, "Torque coefficient mu (damped and paper)")
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--friction", damped.friction, "Friction tau (damped and paper)")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--rho", words.rho, "Offset of the field's second points, over the edge length")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X")
      ->default_str("0.3; 0.02 with --paper")
      ->group(method);
  app.add_option("--step-angle", step.angle, "Least cosine a face may turn by in a time step (paper)")
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--step-expansion", step.expansion,
                 "Greatest relative change of a face's area in a time step (paper)")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--step-displacement", step.displacement,
                 "Greatest move of a vertex in a time step, over the shortest edge (paper)")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--step-area", step.area_bound,
                 "Least area of a face after a time step, over the squared target length (paper)")
      ->check(CLI::NonNegativeNumber.description(""))
      ->type_name("X")
      ->capture_default_str()
      ->group(method);
  app.add_option("--tolerance", words.tolerance,
                 "Converged when every edge is this near to the target length")
      ->type_name("X%")
      ->capture_default_str()
      ->group(method);
  app.add_option("--max-outer", words.max_outer, "Outer iterations: relaxation and filtering")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("N")
      ->default_str("6; 10 with --paper")
      ->group(method);
  app.add_option("--max-steps", words.max_steps, "Steps per outer iteration")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("N")
      ->default_str("2000; 400 with --paper")
      ->group(method);

  const char* constraints = "Constraints";
  app.add_option("--boundary", words.boundary,
                 "Boundary vertices slide along the input's boundary, stay fixed, or are free on the surface")
      ->transform(one_of(boundaries))
      ->type_name("slide|fixed|free")
      ->default_str("slide; free with --paper")
      ->group(constraints);
  app.add_option(
         "--feature-angle", words.feature_angle,
         "Faces that meet at more degrees make a crease: its vertices slide along it, and the surface is "
         "smooth on either side only")
      ->type_name("DEG|off")
      ->default_str("40; off with --paper")
      ->group(constraints);
  app.add_option("--fix", s.fix, "File of vertex ids (0-based, one a line) that stay where they are")
      ->type_name("FILE")
      ->group(constraints);

  const char* reports = "Measuring and reports";
  app.add_flag("--check", s.check, "Measure the input only; nothing is written but the report")
      ->group(reports);
  app.add_option("--report", s.report, "JSON report; - for standard output")
      ->type_name("FILE")
      ->group(reports);
  app.add_option("--trace", s.trace, "Seconds and memory of every stage, as CSV")
      ->type_name("FILE")
      ->group(reports);

  const char* run = "Running";
  app.add_option(
         "-j,--threads", s.threads,
         "Threads (default: SLURM_CPUS_PER_TASK, OMP_NUM_THREADS, or all); results do not depend on it")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("N")
      ->group(run);
  app.add_flag("-q,--quiet", s.quiet, "Print warnings and errors only")->group(run);
  app.add_flag("-v,--verbose", s.verbose, "Print every outer iteration")->group(run);
  app.add_option("--progress", s.progress, "Progress line: auto = on a terminal")
      ->transform(one_of(styles))
      ->type_name("auto|bar|none")
      ->default_str("auto")
      ->group(run);
  app.set_version_flag("-V,--version", "hooke-remesh " HOOKE_VERSION);
}

void settle_sizing(Settings& s, const Words& words) {
  const bool sized = s.sizing_text != "off";
  if (sized) s.sizing = parse_sizing(s.sizing_text);
  if (!words.gradation.empty()) s.gradation = parse_gradation(words.gradation);
  if (sized) return;
  if (!words.gradation.empty()) throw Error("--gradation is of --sizing; leave it out, or name a sizing");
  if (s.length.kind == LengthSpec::Kind::as_given)
    throw Error("--length sizing without --sizing; name a sizing, or another length");
}

/// Gives the words their meaning and checks what belongs together. Throws Error.
void settle(Settings& s, const Words& words, bool kernel_given, bool effort_given) {
  s.length = parse_length(s.length_text);
  settle_sizing(s, words);
  s.remesh.tolerance = s.paper_options.evolution.tolerance = parse_tolerance(words.tolerance);
  set_effort(s.remesh, s.effort);
  s.remesh.map = !s.map.empty();
  s.paper_options.evolution.damped = s.remesh.damped;
  if (kernel_given) s.paper_options.filter.kernel = s.remesh.filter.kernel;
  if (words.feature_angle) s.remesh.constraints.features.angle = parse_feature_angle(*words.feature_angle);
  if (words.rho) s.remesh.filter.offset = s.paper_options.filter.offset = *words.rho;
  if (words.max_outer) s.remesh.max_outer = s.paper_options.max_outer = *words.max_outer;
  if (words.max_steps)
    s.remesh.integration.max_steps = s.paper_options.evolution.max_steps = *words.max_steps;
  if (words.boundary) s.remesh.constraints.boundary = s.paper_options.constraints.boundary = *words.boundary;
  if (s.threads == 0) s.threads = threads_of_environment();
  if (s.paper && s.remesh.connectivity != ConnectivityMode::fixed)
    throw Error("--paper keeps the faces; leave out --connectivity");
  if (s.paper && effort_given) throw Error("--paper takes the time it takes; leave out --effort");
  if (s.paper && words.feature_angle) throw Error("--paper knows no creases; leave out --feature-angle");
  if (s.paper && !s.map.empty()) throw Error("--paper makes no map; leave out --map");
  if (s.check && !s.map.empty()) throw Error("--check makes no map; leave out --map");
  if (s.check && !s.output.empty()) throw Error("--check writes no mesh; leave out --output");
  if (s.check) return;
  if (s.output.empty()) throw Error("no output named; expected -o FILE, or --check to measure only");
  if (s.format.empty()) s.format = format_of(s.output);
}

}  // namespace

Parsed parse_command_line(int argc, char** argv) {
  CLI::App app(
      "Moves the vertices of a triangle mesh on its own surface until the triangles are well shaped: same "
      "vertices, same faces, same surface.",
      "hooke-remesh");
  app.get_formatter()->column_width(34);
  Settings settings;
  Words words;
  add_options(app, settings, words);
  try {
    app.parse(argc, argv);
    settle(settings, words, app.count("--kernel") > 0, app.count("--effort") > 0);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return {std::nullopt, app.exit(e)};  // help and version
    print_error(e.what() + std::string("; see hooke-remesh --help"));
    return {std::nullopt, usage};
  } catch (const Error& e) {
    print_error(e.what());
    return {std::nullopt, usage};
  }
  return {std::move(settings), done};
}

}  // namespace hooke::app
