#include "progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

#include "messages.h"
#include "text_columns.h"

namespace hooke::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char columns_variable[] = "COLUMNS";

/// Columns of the terminal, at most 80; one is left free, as some break the line after the last.
std::size_t usable_columns() {
  struct winsize size {};
  std::size_t columns = terminal_columns;
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    columns = size.ws_col;
  else if (const char* const given = std::getenv(columns_variable))
    columns = std::strtoul(given, nullptr, 10);
  return std::clamp<std::size_t>(columns, 2, terminal_columns) - 1;
}

std::string time_left(double seconds) {
  if (seconds < 90) return fmt::format("about {:.0f} s left", std::max(1., seconds));
  if (seconds < 5400) return fmt::format("about {:.0f} min left", seconds / 60);
  return fmt::format("about {:.1f} h left", seconds / 3600);
}

}  // namespace

bool shows_progress(const Settings& s) {
  if (s.quiet || s.progress == ProgressStyle::none) return false;
  if (s.progress == ProgressStyle::bar) return true;
  const char* const terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

void hand_on_columns() {
  ::setenv(columns_variable, std::to_string(usable_columns() + 1).c_str(), 1);
}

bool ProgressBar::is_due() const {
  constexpr std::chrono::milliseconds pause{100};
  return enabled_ && Clock::now() - last_ >= pause;
}

void ProgressBar::show(const std::string& what, double share) {
  if (!enabled_) return;
  constexpr std::size_t bar_columns = 20;
  constexpr double first_share = .02, first_seconds = 1;  // before that nobody can tell
  last_ = Clock::now();
  const double seconds = std::chrono::duration<double>(last_ - start_).count();
  const std::size_t full = std::lround(share * bar_columns);
  std::string line =
      fmt::format("[{:.<{}}] {:3.0f} %  {}", std::string(full, '#'), bar_columns, 100 * share, what);
  if (share >= first_share && seconds >= first_seconds)
    line += ", " + time_left(seconds * (1 - share) / share);
  line.resize(std::min(line.size(), usable_columns()));
  const std::size_t columns = line.size();
  print_text_as_it_is(fmt::format("\r{:<{}}", line, std::max(columns, shown_)));
  shown_ = columns;
}

void ProgressBar::clear() {
  if (shown_ > 0) print_text_as_it_is(fmt::format("\r{:{}}\r", "", shown_));
  shown_ = 0;
}

namespace {

/// A part of a run: the stages in it, and the share of the time that is over at its end.
struct Part {
  std::initializer_list<std::string_view> stages;
  double end;
};

/// By the times of a torus of 20000 vertices, in the order of ConnectivityMode.
const std::array<std::array<Part, 5>, 3> parts_of_modes = {{
    {{{{"read", "measure"}, .2},
      {{"untangle"}, .3},
      {{"relax"}, .7},
      {{"polish", "mend"}, .9},
      {{"write"}, 1}}},
    {{{{"read", "measure", "untangle"}, .1},
      {{"flow"}, .3},
      {{"springs", "flips"}, .8},
      {{"relax", "polish", "mend"}, .95},
      {{"write"}, 1}}},
    {{{{"read", "measure", "untangle"}, .1},
      {{"adapt"}, .4},
      {{"flow", "springs", "flips"}, .85},
      {{"relax", "polish", "mend"}, .95},
      {{"write"}, 1}}},
}};

std::size_t part_of(std::string_view stage, const std::array<Part, 5>& parts) {
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (std::ranges::find(parts[k].stages, stage) != parts[k].stages.end()) return k;
  return parts.size();
}

}  // namespace

RunProgress::RunProgress(const Settings& s)
    : bar_(shows_progress(s)),
      mode_(s.remesh.connectivity),
      paper_(s.paper),
      last_outer_(s.paper_options.max_outer),
      last_step_(s.paper_options.evolution.max_steps) {}

double RunProgress::share_of(const Progress& p) {
  if (paper_ && p.stage == std::string_view("paper"))  // which mostly goes on to its limits
    return (p.outer - 1 + static_cast<double>(p.step) / last_step_) / last_outer_;
  const auto& parts = parts_of_modes.at(static_cast<std::size_t>(mode_));
  const std::size_t part = part_of(p.stage, parts);
  if (part == parts.size()) return share_;
  if (part != part_) rounds_ = 0;
  if (part == part_ && (stage_ != p.stage || outer_ != p.outer)) ++rounds_;
  part_ = part;
  stage_ = p.stage;
  outer_ = p.outer;
  // Each round takes half of what is left of the part, as do its first steps of the round's.
  constexpr double steps = 16;
  const double begin = part == 0 ? 0 : parts[part - 1].end;
  return begin + (parts[part].end - begin) * (1 - std::exp2(-(rounds_ + 1 - std::exp2(-p.step / steps))));
}

void RunProgress::enter(const char* part) {
  share_ = std::max(share_, share_of({.stage = part}));
  if (bar_.is_due()) bar_.show(part, share_);
}

void RunProgress::show(const Progress& p) {
  share_ = std::clamp(share_of(p), share_, 1.);
  if (!bar_.is_due()) return;
  std::string what = p.stage;
  if (p.outer > 0) what += fmt::format(" {}", p.outer);
  bar_.show(fmt::format("{}, step {}", what, p.step), share_);
}

}  // namespace hooke::app
