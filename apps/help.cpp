#include "help.h"

#include <fmt/format.h>

#include "text_columns.h"

namespace hooke::app {

namespace {

constexpr TextPair needed_most[] = {
    {"-o, --output FILE", "mesh to write: .obj .ply .off .stl .msh"},
    {"-L, --length LENGTH",
     "edge length wanted: 0.5 in file units, 1% of the box's diagonal, 2x the natural length; "
     "default auto, for as many triangles as there are"},
    {"--connectivity MODE", "fixed, flip or adapt: see above"},
    {"--sizing curvature",
     "shorter edges where the surface bends; input: as the mesh has them there; or a file of lengths"},
    {"--min-length LENGTH", "with adapt: shorter edges where creases are close, as along slots and fillets"},
    {"--feature-angle DEG", "edges sharper than this stay (40); off for scans of round bodies"},
    {"--boundary fixed", "boundary vertices stand still; default: they slide along it"},
    {"--fix FILE", "vertices that stay where they are: an id (from 0) a line"},
    {"--repair", "mend a mesh that is refused: mixed orientation, double faces, ..."},
    {"--effort thorough", "work longer for better angles; or fast"},
    {"--check", "only measure the input"},
    {"--report FILE", "all figures as JSON; - for standard output"},
    {"--require CONDITION", "exit code 6 unless 'after.min_angle.min >= 20', or the like, holds"},
};
constexpr std::size_t option_columns = 24, mode_columns = 9;

/// A row whose second column is wrapped.
std::string table_row(const std::string& first, const char* second, std::size_t columns) {
  return fmt::format("  {:<{}}{}\n", first, columns - 2, wrapped(second, columns, columns));
}

std::string heading_of(const OptionEntry& e) {
  std::string names = e.short_name.empty() ? "" : e.short_name + ", ";
  names += e.long_name;
  if (!e.value.empty()) names += " " + e.value;
  return names;
}

}  // namespace

std::string short_help() {
  std::string text = wrapped(std::string("hooke-remesh: ") + purpose) + "\n\nExamples:\n";
  for (const TextPair& e : examples) text += fmt::format("  {}  # {}\n", e.subject, e.text);
  text += "\nWhich --connectivity:\n";
  for (const TextPair& m : mode_advice) text += table_row(m.subject, m.text, mode_columns);
  text += "\nThe options needed most:\n";
  for (const TextPair& o : needed_most) text += table_row(o.subject, o.text, option_columns);
  text += '\n';
  text += wrapped(
      "All options: hooke-remesh --help-all, or man hooke-remesh. Several meshes at once: hooke-remesh a.obj "
      "b.ply -o FOLDER/ (see --table, --skip-existing). Messages go to standard error; the exit code is 0 "
      "only if the result is good.");
  text += '\n';
  return text;
}

std::string full_help(const std::vector<OptionEntry>& entries) {
  constexpr std::size_t indent = 6;
  std::string text = wrapped(std::string("hooke-remesh: ") + purpose) +
                     "\n\nUsage: hooke-remesh INPUT -o OUTPUT [OPTIONS]\n"
                     "       hooke-remesh INPUT... -o FOLDER/ [OPTIONS]\n"
                     "       hooke-remesh INPUT... --check [OPTIONS]\n";
  std::string group;
  for (const OptionEntry& e : entries) {
    if (e.group != group) text += "\n" + e.group + ":\n";
    group = e.group;
    text += "  " + wrapped(heading_of(e), indent, 2) + "\n";
    const std::string by_default = e.by_default.empty() ? "" : " (default: " + e.by_default + ")";
    text += std::string(indent, ' ') + wrapped(e.help + by_default, indent, indent) + "\n";
  }
  text += "\nExit codes:\n";
  for (const ExitMeaning& e : exit_meanings) text += table_row(std::to_string(e.code), e.text, mode_columns);
  return text + table_row("", "With several inputs: the code of the first that failed, in their order.",
                          mode_columns);
}

}  // namespace hooke::app
