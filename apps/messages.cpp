#include "messages.h"

#include <fmt/format.h>
#include <cstdio>

#include "hooke/core/printable.h"
#include "hooke/remesh/result.h"
#include "hooke/report/outcome.h"
#include "text_columns.h"

namespace hooke::app {
namespace {

/// Prints to standard error and ignores write errors, for which fmt::print would throw.
template <typename... Arguments>
void say(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  std::fputs(fmt::format(text, std::forward<Arguments>(arguments)...).c_str(), stderr);
}

std::string reason_in_words(const RunRecord& run) {
  const RemeshResult& r = *run.result;
  if (r.rescue == Rescue::put_back && (r.reason == StopReason::converged || r.reason == StopReason::stalled))
    return run.deviation->displacement && is_rounding(run.deviation->displacement->max, *run.deviation)
               ? "nothing moved: vertices were put back to where they were, to keep the surface"
               : "at rest, but for the vertices that were put back to where they were, to keep the surface";
  if (r.rescue == Rescue::kept_faces && r.reason == StopReason::stalled)
    return "at rest, but for the faces of the input that stay, to keep the surface";
  switch (r.reason) {
    case StopReason::converged:
      return "converged: every edge is within the tolerance of the target length";
    case StopReason::stalled:
      return "at rest: the springs are in equilibrium, as near to the target as the connectivity allows";
    case StopReason::step_limit:
      return "stopped at the iteration limit; more --effort, --max-outer or --max-steps would go on";
    case StopReason::jammed:
      return "jammed: steps are accepted no more, or so short that the forces left get nowhere";
    case StopReason::interrupted:
      return run.status == "time_limit" ? "the time is up: the best mesh so far"
                                        : "interrupted: the best mesh so far";
  }
  return "";
}

void print_iterations(const RemeshResult& r) {
  say("{:<10}{:>7}{:>8}{:>14}{:>12}{:>12}{:>12}\n", "stage", "steps", "evals", "energy", "rms error",
      "max error", "min angle");
  for (const IterationRecord& i : r.iterations)
    say("{:<10}{:>7}{:>8}{:>14.6g}{:>12.4f}{:>12.4f}{:>12.3f}\n", i.stage, i.steps, i.evaluations, i.energy,
        i.rms_length_error, i.max_length_error, i.min_angle);
}

}  // namespace

void print_error(const std::string& message) {
  say("hooke-remesh: error: {}\n", printable(message));
}

void print_warning(const Warning& warning) {
  say("hooke-remesh: warning: {}\n", printable(warning.message));
}

void print_warning(const Note& repair) {
  say("hooke-remesh: warning: {}\n", printable(repair.message));
}

void print_note(const Note& note) {
  say("hooke-remesh: note: {}\n", printable(note.message));
}

std::string paper_message(const RemeshResult& r) {
  const BoundCounts& b = r.bound;
  long long steps = 0;
  for (const IterationRecord& i : r.iterations) steps += i.steps;
  const auto share = [&](int count) { return steps ? 100. * count / static_cast<double>(steps) : 0.; };
  const bool one_face_binds = r.reason == StopReason::jammed && b.expansion > b.displacement;
  return fmt::format(
      "the paper's global time step: cut by the area test in {:.0f} % of {} steps, by the angle test in "
      "{:.0f} %, by the "
      "displacement test in {:.0f} %, free in {:.0f} %{}",
      share(b.expansion), steps, share(b.angle), share(b.displacement), share(b.none),
      one_face_binds ? "; one collapsing face holds back the whole mesh" : "");
}

void print_summary(const Settings& s, const RunRecord& run) {
  const TargetRecord& target = run.target;
  std::string range;
  if (target.min < target.max) range = fmt::format(" on average, {:.6g} to {:.6g}", target.min, target.max);
  say("{}: {} vertices, {} faces; target length {:.6g}{} (natural {:.6g})\n", run.input.path,
      run.before.topology.vertices, run.before.topology.faces, target.mean, range, target.natural);
  if (!run.result) {
    say("{}", quality_table(run.before));
    return;
  }
  if (s.verbose) print_iterations(*run.result);
  say("{}\n\n", wrapped(outcome_in_words(run)));
  say("{}", quality_table(run.before, *run.after, *run.deviation));
  say("\n{}\n", wrapped(reason_in_words(run)));
  if (!s.paper)
    if (const std::string advice = advice_in_words(run, s.remesh.connectivity); !advice.empty())
      say("{}\n", wrapped(advice));
  if (run.result->near_regular)
    say("{}\n",
        wrapped("the input is near-regular: its angles are kept, and no vertex moves by a fifth of its "
                "length"));
  const FlipResult& f = run.result->flips;
  const AdaptResult& a = run.result->adaptation;
  if (a.rounds > 0)
    say("{}\n",
        wrapped(fmt::format("{} edges split, {} collapsed, {} flipped: {} vertices, {} faces ({:.0f} wanted)",
                            a.splits, a.collapses, a.flips + f.flips, run.after->topology.vertices,
                            run.after->topology.faces, a.target_faces)));
  else if (f.flow_rounds > 0)
    say("{}\n",
        wrapped(fmt::format("{} edges flipped; vertices travelled {:.3g} target lengths at most, {:.3g} rms",
                            f.flips, f.max_travel, f.rms_travel)));
  std::string files = run.output->path;
  for (const std::filesystem::path& further :
       {std::filesystem::path(s.report), s.fields, s.map, s.trace, s.trace_steps})
    if (!further.empty() && further != "-") files += ", " + printable(further.string());
  say("{} written in {:.2f} s\n", files, run.resources.wall_s);
}

void print_text_as_it_is(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace hooke::app
