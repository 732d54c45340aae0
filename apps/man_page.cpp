#include "generated_help.h"

#include <fmt/format.h>

#include "help.h"

namespace hooke::app {
namespace {

/// The text so that troff shows every character as it is.
std::string roff(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '\'' || c == '.' || c == '`')
      result += std::string("\\&") + c;
    else
      result += c;
  }
  return result;
}

std::string option_section(const OptionEntry& e) {
  std::string heading;
  if (!e.short_name.empty()) heading = "\\fB" + roff(e.short_name) + "\\fR, ";
  heading += "\\fB" + roff(e.long_name) + "\\fR";
  if (!e.value.empty()) heading += " \\fI" + roff(e.value) + "\\fR";
  const std::string by_default = e.by_default.empty() ? "" : " (default: " + e.by_default + ")";
  return fmt::format(".TP\n{}\n{}\n", heading, roff(e.help + by_default + "."));
}

std::string pair(std::string_view subject, std::string_view text) {
  return fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(subject), roff(text));
}

}  // namespace

std::string man_page(const std::vector<OptionEntry>& entries) {
  std::string text = fmt::format(
      ".TH HOOKE\\-REMESH 1 2026-11-25 \"hooke\\-remesh {}\" \"User Commands\"\n"
      ".SH NAME\nhooke\\-remesh \\- well shaped triangles on the same surface\n"
      ".SH SYNOPSIS\n.B hooke\\-remesh\n\\fIINPUT\\fR \\fB\\-o\\fR \\fIOUTPUT\\fR [\\fIOPTIONS\\fR]\n.br\n"
      ".B hooke\\-remesh\n\\fIINPUT\\fR... \\fB\\-o\\fR \\fIFOLDER/\\fR [\\fIOPTIONS\\fR]\n.br\n"
      ".B hooke\\-remesh\n\\fIINPUT\\fR... \\fB\\-\\-check\\fR [\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n{}\n.PP\nWhich \\fB\\-\\-connectivity\\fR:\n",
      roff(HOOKE_VERSION), roff(purpose));
  for (const TextPair& m : mode_advice) text += pair(m.subject, m.text);
  text += ".SH OPTIONS\n";
  std::string group;
  for (const OptionEntry& e : entries) {
    if (e.group != group) text += ".SS " + roff(group = e.group) + "\n";
    text += option_section(e);
  }
  text += ".SH EXAMPLES\n";
  for (const TextPair& e : examples) text += pair(e.subject, e.text);
  text += pair("hooke-remesh parts/*.stl -o better/ --table parts.csv --skip-existing",
               "many meshes; the same command again goes on where it was interrupted");
  text += ".SH EXIT STATUS\n";
  for (const ExitMeaning& e : exit_meanings) text += pair(std::to_string(e.code), e.text);
  return text + ".PP\n" + roff("With several inputs: the code of the first that failed, in their order.") +
         "\n.SH FILES\n" +
         pair(".NAME.hooke.json", "beside an output NAME of a run with --skip-existing: what made it");
}

}  // namespace hooke::app
