// The texts of --help and --help-all, at most 80 columns wide.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "exit_codes.h"
#include "option_table.h"

namespace hooke::app {

/// What the command does.
inline constexpr char purpose[] =
    "Moves the vertices of a triangle mesh on the mesh's own surface until the triangles are well shaped, "
    "writes the result, and says what changed.";

/// Two texts that belong together.
struct TextPair {
  const char* subject;
  const char* text;
};

/// Command lines that run as they stand, and what they are for.
inline constexpr std::array examples = {
    TextPair{"hooke-remesh in.obj -o out.obj", "better triangles, same faces"},
    TextPair{"hooke-remesh in.obj -o out.ply --connectivity adapt -L 2x", "a coarser mesh"},
    TextPair{"hooke-remesh in.obj --check --report -", "only measure it, as JSON"},
};

/// The values of --connectivity, and for whom they are.
inline constexpr std::array mode_advice = {
    TextPair{"fixed", "faces stay (default): for textures, labels, data per face or vertex"},
    TextPair{"flip", "vertices stay, joined by other faces: better angles, data per vertex"},
    TextPair{"adapt", "a new mesh of the length you ask for: the best, for simulation, scans"},
};

/// The exit codes and what they mean.
struct ExitMeaning {
  ExitCode code;
  const char* text;
};
inline constexpr std::array exit_meanings = {
    ExitMeaning{done, "done"},
    ExitMeaning{internal_error, "internal error"},
    ExitMeaning{usage, "invalid command line or file of settings"},
    ExitMeaning{malformed_input, "input missing, unreadable or malformed"},
    ExitMeaning{unacceptable_mesh, "input read, but not an acceptable mesh; --repair may help"},
    ExitMeaning{output_failed, "an output could not be written; older files are as they were"},
    ExitMeaning{gate_failed, "a condition of --require does not hold; the result is written"},
    ExitMeaning{numerical_failure, "numerical failure"},
    ExitMeaning{limit_reached, "too little memory, or no valid mesh within --time-limit"},
    ExitMeaning{promise_broken, "the result would not keep what it must keep; it is not written"},
    ExitMeaning{interrupted, "interrupted: the best valid mesh so far is written"},
    ExitMeaning{terminated, "terminated: likewise"},
};

/// For most people: purpose, examples, which mode for whom, the options needed most.
std::string short_help();

/// Every option under its heading, and the exit codes.
std::string full_help(const std::vector<OptionEntry>& entries);

}  // namespace hooke::app
