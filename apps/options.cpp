#include "option_table.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "hooke/constraints/constraints.h"
#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/report/report_keys.h"
#include "listing_request.h"
#include "words.h"

namespace hooke::app {
namespace {

template <typename T>
using Choices = std::vector<std::pair<const char*, T>>;

/// Adds an option whose value is one of the given words. `Value` is T or std::optional<T>.
template <typename Value, typename T>
CLI::Option* add_choice(CLI::App& app, const char* name, Value& value, const char* help,
                        const Choices<T>& choices) {
  std::string alternatives;
  for (const auto& choice : choices)
    alternatives += (alternatives.empty() ? "" : "|") + std::string(choice.first);
  const auto choose = [&value, name, alternatives, choices](const std::string& text) {
    for (const auto& [word, meaning] : choices)
      if (text == word) {
        value = meaning;
        return;
      }
    throw CLI::ValidationError(name, in_quotes(text) + "; expected " + alternatives);
  };
  return app.add_option_function<std::string>(name, choose, help)->type_name(alternatives);
}

/// The numbers that an option accepts.
struct Range {
  const char* description;
  bool (*holds)(double);  // called with finite numbers only
};
constexpr Range positive{"a positive number", [](double x) { return x > 0; }};
constexpr Range not_negative{"a number that is not negative", [](double x) { return x >= 0; }};
constexpr Range cosine{"a number from -1 to 1", [](double x) { return std::abs(x) <= 1; }};
constexpr Range whole_number{"a whole number from 1", [](double x) { return x >= 1; }};

/// Adds an option whose value is a number in a range. `Value` is Number or std::optional<Number>.
template <typename Number, typename Value>
CLI::Option* add_number(CLI::App& app, const char* name, Value& value, const char* help, Range range) {
  const auto read = [&value, name, range](const std::string& text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || rest != end || !std::isfinite(static_cast<double>(number)) ||
        !range.holds(static_cast<double>(number)))
      throw CLI::ValidationError(name, fmt::format("{}; expected {}", in_quotes(text), range.description));
    value = number;
  };
  return app.add_option_function<std::string>(name, read, help)
      ->type_name(std::is_integral_v<Number> ? "N" : "X");
}

/// The same for a value with a default.
CLI::Option* add_number(CLI::App& app, const char* name, double& value, const char* help, Range range) {
  return add_number<double, double>(app, name, value, help, range)->default_str(fmt::format("{}", value));
}

/// Whether the text is, or could be, the next option, which stands in the place of a value where a variable
/// of a script is not set: "--repair", "-q".
bool looks_like_option(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return text.starts_with("--") || (text.size() > 1 && text[0] == '-' && is_letter(text[1]));
}

/// Why the text is not the name of a file; empty if it may be.
std::string problem_with_name(const std::string& text, const char* expected) {
  if (text.empty()) return fmt::format("''; expected {}", expected);
  if (!looks_like_option(text)) return "";
  return fmt::format("{}; expected {}, not an option; a file of that name is {}", in_quotes(text), expected,
                     in_quotes("./" + text));
}

/// Accepts the name of a file; not `-`, which does not stand for a stream here.
CLI::Validator file_name() {
  const auto check = [](const std::string& text) -> std::string {
    return text == "-" ? "'-'; expected the name of a file" : problem_with_name(text, "the name of a file");
  };
  return {check, ""};
}

/// Accepts the name of a file, or `-` for a standard stream.
CLI::Validator file_or_stream() {
  return {[](const std::string& text) { return problem_with_name(text, "the name of a file, or -"); }, ""};
}

/// Accepts any text but the empty one and a long option.
CLI::Validator plain_text() {
  const auto check = [](const std::string& text) -> std::string {
    if (text.empty()) return "''; expected text";
    return text.starts_with("--") ? in_quotes(text) + "; expected text, not an option" : "";
  };
  return {check, ""};
}

CLI::Option* add_file(CLI::App& app, const char* name, std::filesystem::path& file, const char* help) {
  return app.add_option(name, file, help)->check(file_name())->type_name("FILE");
}

void add_target(CLI::App& app, Settings& s, RawOptions& raw) {
  app.add_option(
         "-L,--length", s.length_text,
         "Target edge length: auto = sqrt(4 A / (sqrt 3 F)) of each connected part, mean = mean edge length, "
         "X in file units, "
         "X% of the box's diagonal, Xx times auto; with --sizing it scales the lengths: auto and Xx to cover "
         "the area, others to that mean, sizing = as they are")
      ->type_name("auto|mean|sizing|X|X%|Xx")
      ->capture_default_str();
  app.add_option(
         "--sizing", s.sizing_text,
         "Target length per vertex: a file with one a line, a float property of a PLY input's "
         "vertices, by curvature, for chord errors in file units or % of the box's diagonal (0.1%), or as "
         "the faces of the input are there")
      ->check(file_name())
      ->type_name("FILE|ply:PROPERTY|curvature[:ERROR]|input")
      ->default_str("off");
  app.add_option("--gradation", raw.gradation,
                 "Maximum change of the lengths of --sizing along an edge, over its length, and of those of "
                 "--min-length; off for those of the input if faces stay or are flipped only")
      ->type_name("X|off")
      ->default_str("0.3");
  app.add_option("--min-length", s.min_length_text,
                 "How short edges may be where creases or boundaries are closer than the target length, so "
                 "that triangles there are well shaped too; of --connectivity adapt")
      ->type_name("X|X%|Xx|off")
      ->capture_default_str();
  add_file(app, "--edge-lengths", s.edge_lengths,
           "Target lengths of edges, one a line: two vertex ids (0-based) and a length in file units; other "
           "edges have that of --length. Springs of altitudes and angles, which ask for equilateral faces, "
           "are off then");
  add_choice(
      app, "--connectivity", s.remesh.connectivity,
      "What may change: fixed = the faces stay; flip = edges are flipped too, with the same vertex ids, but "
      "vertices travel; adapt = new vertices and faces, as many as --length asks for",
      Choices<ConnectivityMode>{{"fixed", ConnectivityMode::fixed},
                                {"flip", ConnectivityMode::flip},
                                {"adapt", ConnectivityMode::adapt}})
      ->default_str("fixed");
  add_file(app, "--map", s.map,
           "Where the output's vertices lie on the input: per line its vertex id there or -1, a face "
           "of the input and three weights of that face's corners");
}

void add_method(CLI::App& app, Settings& s, RawOptions& raw) {
  add_choice(
      app, "--effort", s.remesh.effort, "How long to go on for better triangles",
      Choices<Effort>{{"fast", Effort::fast}, {"default", Effort::standard}, {"thorough", Effort::thorough}})
      ->default_str("default");
  add_choice(
      app, "--integrator", s.remesh.integrator,
      "How to come to rest: lbfgs = minimise the springs' energy, damped = follow the paper's equation of "
      "motion",
      Choices<IntegratorKind>{{"lbfgs", IntegratorKind::lbfgs}, {"damped", IntegratorKind::damped}})
      ->default_str("lbfgs");
  add_choice(app, "--polish", s.remesh.polish_angles,
             "Angle springs on the worst faces after the equilibrium",
             Choices<bool>{{"on", true}, {"off", false}})
      ->default_str("on");
  app.add_flag(
      "--paper", s.paper,
      "The paper's own algorithms and constants, for comparison: global time step, torque, one dense "
      "spline of the input, and altitude springs, which the paper has not; its letter, which mostly jams "
      "and folds faces, is --paper --altitude 0 --filter-every outer --refit each");
  add_choice(app, "--filter", s.remesh.filter.kind,
             "What vertices are projected to: local = splines blended over patches, global = one dense "
             "spline, closest = the input's faces, none",
             Choices<FilterKind>{{"local", FilterKind::local},
                                 {"global", FilterKind::global},
                                 {"closest", FilterKind::closest},
                                 {"none", FilterKind::none}})
      ->default_str("local");
  add_choice(app, "--kernel", s.remesh.filter.kernel, "Kernel of the splines",
             Choices<Kernel>{{"r2logr", Kernel::r2logr}, {"r3", Kernel::r3}})
      ->default_str("r3; r2logr with --paper");
  add_choice(app, "--filter-every", s.paper_options.filter_every,
             "Project the vertices after each time step, or after each outer iteration (paper)",
             Choices<FilterEvery>{{"step", FilterEvery::step}, {"outer", FilterEvery::outer}})
      ->default_str("step");
  add_choice(app, "--refit", raw.refit, "Fit the field anew before each outer iteration, or once",
             Choices<Refit>{{"each", Refit::each}, {"once", Refit::once}})
      ->default_str("each; once with --paper");
  add_number<double>(app, "--altitude", raw.altitude,
                     "Weight of the altitude springs against the strings; the paper has none", not_negative)
      ->default_str("1");
  add_number<double>(app, "--rho", raw.rho, "Offset of the field's second points, see --rho-unit", positive)
      ->default_str("0.3; 0.001 with --paper");
  add_choice(app, "--rho-unit", raw.rho_unit,
             "Unit of --rho: the mean edge length, or that of the file (paper, whose points are inside)",
             Choices<OffsetUnit>{{"edge", OffsetUnit::edge}, {"file", OffsetUnit::file}})
      ->default_str("edge; file with --paper");
  app.add_option("--tolerance", raw.tolerance, "Converged when every edge is this near to the target length")
      ->type_name("X%")
      ->capture_default_str();
  add_number<int>(app, "--max-outer", raw.max_outer, "Outer iterations: relaxation and filtering",
                  whole_number)
      ->default_str("6; 25 with --paper");
  add_number<int>(app, "--max-steps", raw.max_steps, "Steps per outer iteration", whole_number)
      ->default_str("2000; 400 with --paper");
}

void add_motion(CLI::App& app, Settings& s) {
  DampedOptions& damped = s.remesh.damped;
  TimeStepOptions& step = s.paper_options.evolution.time_step;
  add_number(app, "--string", damped.string, "String tension lambda (damped and paper)", positive);
  add_number(app, "--torque", damped.torque, "Torque coefficient mu (damped and paper)", not_negative);
  add_number(app, "--friction", damped.friction, "Friction tau (damped and paper)", positive);
  add_number(app, "--step-angle", step.angle, "Minimum cosine a face may turn by in a time step (paper)",
             cosine);
  add_number(app, "--step-expansion", step.expansion,
             "Maximum relative change of a face's area in a time step (paper)", positive);
  add_number(app, "--step-displacement", step.displacement,
             "Maximum move of a vertex in a time step, over the shortest edge (paper)", positive);
  add_number(app, "--step-area", step.area_bound,
             "Minimum area of a face after a time step, over the squared target length (paper)",
             not_negative);
}

void add_constraints(CLI::App& app, Settings& s, RawOptions& raw) {
  add_choice(
      app, "--boundary", raw.boundary,
      "Boundary vertices slide along the input's boundary, stay fixed, or are free on the surface",
      Choices<BoundaryRule>{
          {"slide", BoundaryRule::slide}, {"fixed", BoundaryRule::fixed}, {"free", BoundaryRule::free}})
      ->default_str("slide; free with --paper");
  app.add_option(
         "--feature-angle", raw.feature_angle,
         "Faces that meet at more degrees make a crease: its vertices slide along it, and the surface is "
         "smooth on either side only")
      ->type_name("DEG|off")
      ->default_str("40; off with --paper");
  add_choice(app, "--feature-noise", s.remesh.constraints.features.drops_noise,
             "Whether sharp edges may be taken for noise and smoothed: those in short chains, and where the "
             "surface is rough or round",
             Choices<bool>{{"auto", true}, {"off", false}})
      ->default_str("auto");
  app.add_option(
         "--keep", raw.keep,
         "What is kept along its borders with flip and adapt, and with fixed if named, one or more, with "
         "commas: seams = texture "
         "coordinates of an OBJ, hard-edges = edges at which its normals differ (normals go along with "
         "either), materials = its materials and the face labels of other formats "
         "(groups of MSH, integer properties of PLY), groups = groups, objects and smoothing groups of OBJ, "
         "solids of STL. Borders become creases along which vertices slide; none: such data are dropped. In "
         "all modes non-manifold, alone with the default others: edges with three faces and more, as where "
         "bodies share walls; their vertices slide along the lines that these edges form, in all sheets at "
         "once, and adapt splits and joins them")
      ->type_name("seams,hard-edges,materials,groups,non-manifold|none")
      ->default_str("seams,hard-edges,materials,groups");
  add_file(app, "--fix", s.fix, "File of vertex ids (0-based, one a line) that stay where they are");
}

/// Adds the option that lists the keys of the report. Parsing it throws ListingRequest.
void add_listing(CLI::App& app, RawOptions& raw) {
  const auto list = [](const std::string& form) {
    const Choices<std::string (*)()> listings = {
        {"text", keys_as_text}, {"markdown", keys_as_page}, {"schema", report_schema}};
    for (const auto& [name, listing] : listings)
      if (form == name) throw ListingRequest(listing());
    throw CLI::ValidationError(in_quotes(form) + "; expected text, markdown or schema");
  };
  app.add_flag(
         "--list-metrics{text}", raw.listing,
         "List the keys of the report with meaning and unit; =markdown as a page, =schema as JSON Schema")
      ->trigger_on_parse()
      ->configurable(false)
      ->each(list);
}

/// Adds the option whose values are conditions.
void add_gates(CLI::App& app, Settings& s) {
  const auto add = [&s](const std::string& text) {
    try {
      s.gates.push_back(parse_gate(text));
    } catch (const Error& e) {
      throw CLI::ValidationError("--require", e.what());
    }
  };
  app.add_option_function<std::vector<std::string>>(
         "--require", [add](const std::vector<std::string>& texts) { std::ranges::for_each(texts, add); },
         "A number of the report, its keys with dots between them, and what it must be, such as "
         "'after.min_angle.min >= 20'; else the exit code is 6, and the result is written all the same; "
         "repeatable")
      ->type_name("CONDITION")
      ->allow_extra_args(false);
  add_file(
      app, "--compare", s.compare,
      "An older report: tells what got worse since, with exit code 6; the result is written all the same");
  add_number(app, "--rtol", s.rtol, "By what share of its old size a figure may be worse than in --compare",
             not_negative);
}

void add_reports(CLI::App& app, Settings& s, RawOptions& raw) {
  app.add_flag("--check", s.check, "Measure the input only; nothing is written but the report");
  app.add_option("--report", s.report, "JSON report; - for standard output")
      ->check(file_or_stream())
      ->type_name("FILE");
  add_gates(app, s);
  add_listing(app, raw);
  add_file(app, "--fields", s.fields,
           "PLY file of the result with displacement, distance, curvature and length error at the vertices "
           "and the minimum angle of each face");
  add_file(app, "--trace", s.trace, "Seconds and memory of every stage, as CSV");
  add_file(app, "--trace-steps", s.trace_steps,
           "Energies, forces and length of every time step, as CSV (paper)");
}

void add_repair(CLI::App& app, Settings& s, RawOptions& raw) {
  app.add_flag(
      "--repair", s.repair.repair,
      "Make the input an oriented manifold: merge boundary vertices that lie on each other, drop faces "
      "listed twice or with a vertex twice, orient faces alike and outward, cut edges with three or more "
      "faces, split vertices in which parts only touch; each change is counted");
  app.add_option("--weld", s.weld_text,
                 "Merge vertices of the input closer than this, in file units or % of the box's diagonal")
      ->type_name("X|X%|off")
      ->default_str("off");
  app.add_option("--drop-components", raw.drop_components,
                 "With --repair, drop components with less than this share of the area")
      ->type_name("X%|off")
      ->default_str("off");
  app.add_option("--fill-holes", raw.fill_holes, "With --repair, fill holes of at most so many edges")
      ->type_name("N|off")
      ->default_str("off");
}

void add_promises(CLI::App& app, Settings& s, RawOptions& raw) {
  app.add_option("--max-distance", raw.max_distance,
                 "How far the surfaces of input and output may be apart, in file units or % of the box's "
                 "diagonal; the default follows the curvature of the input")
      ->type_name("X|X%|off");
  app.add_flag("--accept-invalid", s.accept_invalid,
               "Write a result even if it does not keep the surface, creases or topology of the input, or "
               "has new folds or self-intersections; without it that ends with exit code 9");
}

void add_run(CLI::App& app, Settings& s) {
  add_number<int>(
      app, "-j,--threads", s.threads,
      "Threads (default: SLURM_CPUS_PER_TASK, OMP_NUM_THREADS, or all); results do not depend on it",
      whole_number);
  add_number(app, "--time-limit", s.time_limit,
             "Seconds after which the work ends with the best valid mesh so far, which is then measured and "
             "written (status time_limit); exit code 8 if there is none",
             positive)
      ->default_str("none")
      ->type_name("S");
  add_number(app, "--memory-limit", s.memory_limit,
             "Megabytes that the run may take; a mesh that would take more, by the size of its file or by "
             "its vertices, is refused before the work, with exit code 8 (default: none is for its own size; "
             "new faces, dense splines and several inputs together take at most 80 % of what is free)",
             positive)
      ->type_name("MB");
  app.add_flag("-q,--quiet", s.quiet, "Print warnings and errors only");
  app.add_flag("-v,--verbose", s.verbose, "Print every outer iteration");
  add_choice(
      app, "--progress", s.progress,
      "A line with the stage, the share done and the time left, both estimated: auto = on a terminal",
      Choices<ProgressStyle>{
          {"auto", ProgressStyle::automatic}, {"bar", ProgressStyle::bar}, {"none", ProgressStyle::none}})
      ->default_str("auto");
}

void add_batch(CLI::App& app, Settings& s) {
  app.add_option("--suffix", s.batch.suffix,
                 "Text between name and extension of the files written to FOLDER/: part.obj becomes "
                 "partTEXT.obj")
      ->check(plain_text())
      ->type_name("TEXT");
  add_file(app, "--table", s.batch.table,
           "A row for each mesh: file, status, exit code, seconds, numbers before and after; FILE.csv, or "
           "FILE.jsonl with one JSON object a line");
  app.add_flag(
      "--skip-existing", s.batch.skip_existing,
      "Do not run again what such a run has finished: the output is there unchanged, and the content "
      "of the input, the options and this program are the same, as a hidden file .NAME.hooke.json "
      "beside the output tells; after an interruption the same command goes on where it was");
  add_number<int>(app, "--jobs", s.batch.jobs,
                  "Meshes at the same time (default: what processors and memory allow); --threads is for all "
                  "of them together",
                  whole_number);
}

void add_settings(CLI::App& app, RawOptions& raw) {
  app.set_config("--config", "",
                 "Options from a TOML file: a line NAME = VALUE each, with the long names above; what the "
                 "command line says goes first")
      ->check(file_name())
      ->type_name("FILE")
      ->configurable(false);
  app.add_flag("--print-config", raw.print_config,
               "Print the options of this command line as such a file, with all others as comments; nothing "
               "is run")
      ->configurable(false);
  app.set_help_flag("-h,--help", "The options that most people need")->configurable(false);
  app.set_help_all_flag("--help-all", "All options")->configurable(false);
  app.set_version_flag("-V,--version", "hooke-remesh " HOOKE_VERSION, "The version")->configurable(false);
  add_choice(app, "--completion", raw.completion, "Print the completion of this command for a shell",
             Choices<Shell>{{"bash", Shell::bash}, {"zsh", Shell::zsh}, {"fish", Shell::fish}})
      ->configurable(false);
  app.add_flag("--man-page", raw.man_page, "Print the manual page")->configurable(false)->group("");
}

}  // namespace

void add_options(CLI::App& app, Settings& s, RawOptions& raw) {
  app.option_defaults()->group("Files");
  app.add_option(
         "INPUT", s.inputs,
         "Mesh to read: .obj, .ply, .off, .stl, .msh (Gmsh) or .vtp; - for standard input; several with "
         "-o FOLDER/")
      ->check([](const std::string& text) {
        return text.empty() ? "''; expected the name of a file, or -" : std::string();
      })
      ->type_name("");
  app.add_option(
         "-o,--output", s.output,
         "Mesh to write; required unless --check; - for standard output; a folder for several inputs, "
         "whose names stay")
      ->check(file_or_stream())
      ->type_name("FILE|FOLDER/");
  add_choice(app, "--input-format", s.input_format, "Format of the input (default: by extension)",
             Choices<MeshFormat>{{"obj", MeshFormat::obj},
                                 {"ply", MeshFormat::ply},
                                 {"off", MeshFormat::off},
                                 {"stl", MeshFormat::stl},
                                 {"msh", MeshFormat::msh},
                                 {"vtp", MeshFormat::vtp}});
  add_choice(app, "--format", s.format,
             "Format of the output (default: by extension); msh is Gmsh 4.1, msh2 Gmsh 2.2",
             Choices<MeshFormat>{{"obj", MeshFormat::obj},
                                 {"ply", MeshFormat::ply},
                                 {"off", MeshFormat::off},
                                 {"stl", MeshFormat::stl},
                                 {"msh", MeshFormat::msh},
                                 {"msh2", MeshFormat::msh2}});
  add_choice(app, "--preserve", s.preserve,
             "With the same format and faces that stay, write the input's bytes and change only the digits "
             "of moved coordinates and their normals",
             Choices<bool>{{"on", true}, {"off", false}})
      ->default_str("on");
  add_choice(app, "--reproject-uv", s.reproject_uv,
             "Texture coordinates of a preserved OBJ follow its vertices, so that textures do not swim",
             Choices<bool>{{"on", true}, {"off", false}})
      ->default_str("off");
  app.option_defaults()->group("Target");
  add_target(app, s, raw);
  app.option_defaults()->group("Method");
  add_method(app, s, raw);
  add_motion(app, s);
  app.option_defaults()->group("Constraints");
  add_constraints(app, s, raw);
  app.option_defaults()->group("Repair of the input");
  add_repair(app, s, raw);
  app.option_defaults()->group("What the output must keep");
  add_promises(app, s, raw);
  app.option_defaults()->group("Measuring and reports");
  add_reports(app, s, raw);
  app.option_defaults()->group("Running");
  add_run(app, s);
  app.option_defaults()->group("Several inputs");
  add_batch(app, s);
  app.option_defaults()->group("Settings and help");
  add_settings(app, raw);
}

}  // namespace hooke::app
