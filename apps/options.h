// Parses the command line into settings. Beside the table of options only the parser depends on CLI11.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hooke/constraints/seams.h"
#include "hooke/io/mesh_format.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/measure/preservation.h"
#include "hooke/mesh/repair.h"
#include "hooke/remesh/options.h"
#include "hooke/remesh/paper_mode.h"
#include "hooke/report/gates.h"
#include "hooke/springs/sizing.h"

namespace hooke::app {

/// When to show the progress line; automatic: on a terminal.
enum class ProgressStyle { automatic, bar, none };

/// What is only of several inputs, or of one that may be done already.
struct BatchSettings {
  std::string suffix;           // put between name and extension of the outputs
  std::filesystem::path table;  // .csv or .jsonl; empty for none
  bool skip_existing = false;   // leave out what is done already
  int jobs = 0;                 // meshes at the same time; 0: as many as fit
};

/// An option as it was given on the command line or in a file of settings.
struct GivenOption {
  std::string name;                 // long, without dashes; "INPUT"
  std::vector<std::string> values;  // one for each time it was given; none for a flag
};

/// All settings of a run.
struct Settings {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path input;   // the first of them; "-" for standard input
  std::filesystem::path output;  // empty with --check; "-" for standard output
  std::filesystem::path config;  // file of settings; empty for none
  BatchSettings batch;
  std::vector<GivenOption> given;          // in the order of the table of options
  std::optional<MeshFormat> input_format;  // none: by the extension
  std::optional<MeshFormat> format;        // of the output; set by its extension if not given
  bool format_given = false;               // by --format
  bool preserve = true;  // --preserve on: write the input file again with moved vertices, if that can be
  bool preserve_given = false;  // whether the command line says so
  bool reproject_uv = false;    // texture coordinates of a preserved OBJ follow the vertices
  LengthSpec length;
  std::string length_text = "auto";
  SizingSource sizing;
  std::string sizing_text = "off";
  std::string min_length_text = "off";
  std::optional<LengthSpec> min_length;                     // of edges in narrow regions
  std::filesystem::path edge_lengths;                       // file of target lengths of edges; empty for none
  std::optional<std::vector<EdgeLength>> edge_length_list;  // in place of the file, for a mesh of arrays
  bool check = false;                                       // only measure the input
  bool paper = false;
  std::filesystem::path map;  // empty for none
  RemeshOptions remesh;
  SeamKinds keep;  // seams that are feature edges where faces are replaced
  PreservationOptions preservation;
  PaperOptions paper_options;
  double max_distance_share = 0;  // --max-distance in diagonals of the input; 0: not given so
  bool accept_invalid = false;    // write a result that does not keep what it must keep
  RepairOptions repair;
  std::string weld_text = "off";
  std::filesystem::path fix;          // file with the ids of fixed vertices; empty for none
  std::vector<Gate> gates;            // conditions that the report must fulfil
  std::filesystem::path compare;      // older report to compare with; empty for none
  double rtol = .01;                  // by how much a figure may be worse than there
  std::string report;                 // path; "-" for standard output; empty for none
  std::filesystem::path fields;       // PLY file for values at vertices and faces; empty for none
  std::filesystem::path trace;        // file for the time of each stage; empty for none
  std::filesystem::path trace_steps;  // file for the time steps of --paper; empty for none
  double time_limit = 0;              // of the whole run, s; 0: none
  double memory_limit = 0;            // MB; 0: not given, see memory_allowed()
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  int threads = 0;  // 0: as many as the process may use
  bool quiet = false;
  bool verbose = false;
  ProgressStyle progress = ProgressStyle::automatic;
};

/// Whether the path is that of a folder: it ends with a slash, or there is such a folder.
bool names_folder(const std::filesystem::path& path);

/// Whether the settings are for a run that starts one process for each mesh, see run_batch().
bool is_batch(const Settings& settings);

/// The settings, or an exit code if the command line asks for help or is invalid; the help or the message has
/// then been printed.
struct Parsed {
  std::optional<Settings> settings;
  int exit_code = 0;
};
Parsed parse_command_line(int argc, char** argv);

/// The settings that these arguments of the command give, its name left out. Throws Error for what
/// parse_command_line() refuses; does not take requests for help.
Settings parse_arguments(std::vector<std::string> arguments);

}  // namespace hooke::app
