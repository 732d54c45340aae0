#include "generated_help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hooke::app {
namespace {

/// The names of the option, with `between` between them.
std::string names_of(const OptionEntry& e, const char* between) {
  return e.short_name.empty() ? e.long_name : e.short_name + between + e.long_name;
}

/// What the option is for, in a few words: its help up to the first semicolon, colon or bracket.
std::string brief(const OptionEntry& e) {
  const size_t end = std::min({e.help.find(';'), e.help.find(": "), e.help.find(" ("), e.help.size()});
  return e.help.substr(0, end);
}

/// The text with a backslash before each of these characters.
std::string escaped(const std::string& text, std::string_view special) {
  std::string result;
  for (char c : text) {
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// In single quotes, for the POSIX shells.
std::string shell_quoted(const std::string& text) {
  std::string result = "'";
  for (char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string for_bash(const std::vector<OptionEntry>& entries) {
  std::vector<std::string> names;
  std::string cases;
  for (const OptionEntry& e : entries) {
    if (e.positional()) continue;
    if (!e.short_name.empty()) names.push_back(e.short_name);
    names.push_back(e.long_name);
    if (e.is_flag()) continue;
    std::string action;
    if (!e.words.empty())
      action = fmt::format("COMPREPLY=($(compgen -W '{}' -- \"$cur\"))", fmt::join(e.words, " "));
    if (!e.takes_file())
      action += (action.empty() ? "" : "; ") + std::string("compopt +o default 2>/dev/null");
    cases += fmt::format("    {}) {}{}return ;;\n", names_of(e, "|"), action, action.empty() ? "" : "; ");
  }
  return fmt::format(R"(# Completion of hooke-remesh in bash, made by hooke-remesh --completion bash.
_hooke_remesh() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}}
  COMPREPLY=()
  if [[ $cur == '=' ]]; then
    cur=
  elif [[ $prev == '=' && $COMP_CWORD -gt 1 ]]; then
    prev=${{COMP_WORDS[COMP_CWORD-2]}}
  fi
  case $prev in
{}  esac
  if [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W '{}' -- "$cur"))
  fi
}}
complete -o default -o bashdefault -F _hooke_remesh hooke-remesh
)",
                     cases, fmt::join(names, " "));
}

std::string for_zsh(const std::vector<OptionEntry>& entries) {
  std::string text =
      "#compdef hooke-remesh\n# Completion of hooke-remesh in zsh, made by hooke-remesh --completion zsh.\n"
      "_arguments -s -S";
  for (const OptionEntry& e : entries) {
    if (e.positional()) {
      text += " \\\n  '*:mesh:_files'";
      continue;
    }
    std::string action;
    if (!e.is_flag()) {
      action = ":" + escaped(e.value, ":\\") + ":";
      if (!e.words.empty() && e.takes_file())
        action += fmt::format("_alternative 'words:word:({})' 'files:file:_files'", fmt::join(e.words, " "));
      else if (!e.words.empty())
        action += fmt::format("({})", fmt::join(e.words, " "));
      else if (e.takes_file())
        action += "_files";
      else
        action += " ";
    }
    const std::string rest = "[" + escaped(brief(e), "[]:\\") + "]" + action;
    const std::string exclusive = e.repeatable ? "*" : "(" + names_of(e, " ") + ")";
    const std::string value = e.is_flag() ? "" : "=";
    text += " \\\n  ";
    if (e.short_name.empty())
      text += shell_quoted(fmt::format("{}{}{}{}", exclusive, e.long_name, value, rest));
    else
      text += fmt::format("{}{{{},{}{}}}{}", shell_quoted(exclusive), e.short_name + (e.is_flag() ? "" : "+"),
                          e.long_name, value, shell_quoted(rest));
  }
  return text + "\n";
}

std::string for_fish(const std::vector<OptionEntry>& entries) {
  std::string text = "# Completion of hooke-remesh in fish, made by hooke-remesh --completion fish.\n";
  for (const OptionEntry& e : entries) {
    if (e.positional()) continue;
    text += "complete -c hooke-remesh";
    if (!e.short_name.empty()) text += " -s " + e.short_name.substr(1);
    text += " -l " + e.long_name.substr(2);
    if (!e.is_flag()) text += e.takes_file() ? " -r -F" : " -x";
    if (!e.words.empty()) text += fmt::format(" -a '{}'", fmt::join(e.words, " "));
    text += " -d '" + escaped(brief(e), "'\\") + "'\n";
  }
  return text;
}

}  // namespace

std::string completion(Shell shell, const std::vector<OptionEntry>& entries) {
  switch (shell) {
    case Shell::bash:
      return for_bash(entries);
    case Shell::zsh:
      return for_zsh(entries);
    case Shell::fish:
      return for_fish(entries);
  }
  return "";
}

}  // namespace hooke::app
