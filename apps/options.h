// The command line: the only file pair that knows CLI11.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hooke/remesh/options.h"
#include "hooke/remesh/paper_mode.h"
#include "hooke/remesh/restarts.h"
#include "hooke/springs/sizing.h"

namespace hooke::app {

enum class ProgressStyle { automatic, bar, none };

struct Settings {
  std::filesystem::path input;
  std::filesystem::path output;  // empty with check
  std::string format;            // of the output
  LengthSpec length;
  std::string length_text = "auto";
  SizingSource sizing;
  std::string sizing_text = "off";
  double gradation = Sizing{}.gradation;  // of a sizing
  bool check = false;                     // measure the input only
  bool paper = false;
  Effort effort = Effort::standard;
  std::filesystem::path map;  // empty without
  RemeshOptions remesh;
  RestartOptions restarts;
  PaperOptions paper_options;
  std::filesystem::path fix;    // file of vertex ids that stay; empty without
  std::string report;           // path, "-" for standard output, empty without
  std::filesystem::path trace;  // seconds per stage; empty without
  int threads = 0;              // 0: all that the process may use
  bool quiet = false;
  bool verbose = false;
  ProgressStyle progress = ProgressStyle::automatic;
};

/// The settings, or the exit code when the command line asks for help or is not understood (then the message
/// has been printed).
struct Parsed {
  std::optional<Settings> settings;
  int exit_code = 0;
};
Parsed parse_command_line(int argc, char** argv);

}  // namespace hooke::app
