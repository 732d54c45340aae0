#include "judging.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "messages.h"

namespace hooke::app {

std::optional<ReportFigures> read_base(const Settings& s) {
  if (s.compare.empty()) return std::nullopt;
  const FileBytes file = read_regular_file(s.compare, "a report that --report wrote");
  const std::string name = printable(s.compare.native());
  try {
    return figures_of(nlohmann::ordered_json::parse(file.text()));
  } catch (const nlohmann::json::exception&) {
    throw InputError(name + ": is no JSON; expected a file that --report wrote; name another");
  } catch (const Error& e) {
    throw InputError(fmt::format("{}: {}; name another", name, e.what()));
  }
}

void judge(const Settings& s, const std::optional<ReportFigures>& base, RunRecord& record) {
  if (s.gates.empty() && !base) return;
  const nlohmann::ordered_json report = report_json(record);
  record.gates = judge_gates(s.gates, report);
  if (!base) return;
  record.comparison = compare(*base, figures_of(report), s.rtol);
  record.comparison->base = printable(s.compare.native());
}

bool passes(const RunRecord& record) {
  return std::ranges::all_of(record.gates, &GateOutcome::passed) &&
         (!record.comparison || (record.comparison->worse.empty() && record.comparison->compared > 0));
}

void print_judgement(const Settings& s, const RunRecord& record) {
  for (const GateOutcome& gate : record.gates)
    if (!gate.passed)
      print_error(fmt::format("{}: required {}; it is {}", record.input.path, printable(gate.condition),
                              gate.value ? fmt::format("{:.6g}", *gate.value) : "not there"));
  if (!record.comparison) return;
  const Comparison& c = *record.comparison;
  for (const std::string& reason : c.not_comparable)
    print_warning(Warning{"not_comparable", fmt::format("{}: {}", c.base, reason)});
  if (c.compared == 0)
    print_error(fmt::format("{}: has no figure in common with {}; expected the report of such a run", c.base,
                            record.input.path));
  for (const Worsening& w : c.worse)
    print_error(fmt::format("{}: worse than in {}: {}", record.input.path, c.base, in_words(w)));
  if (!s.quiet && c.worse.empty() && c.compared > 0)
    print_note({"compared", c.compared,
                fmt::format("{}: none of {} figures got worse by more than {:.4g} %", c.base, c.compared,
                            100 * c.rtol)});
}

}  // namespace hooke::app
