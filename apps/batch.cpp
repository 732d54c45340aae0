#include "batch.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "batch_plan.h"
#include "batch_table.h"
#include "child_process.h"
#include "exit_codes.h"
#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "memory_limit.h"
#include "mesh_memory.h"
#include "messages.h"
#include "progress_bar.h"
#include "signals.h"

namespace hooke::app {
namespace {

/// Whether a run with this exit code has written its result and a report.
bool leaves_a_report(int exit_code) {
  return exit_code == done || exit_code == gate_failed || exit_code == interrupted || exit_code == terminated;
}

/// The last error in the messages of a run, without the name of the command; empty if there is none.
std::string last_error(const std::string& messages) {
  constexpr std::string_view mark = "hooke-remesh: error: ";
  const size_t begin = messages.rfind(mark);
  if (begin == std::string::npos) return "";
  const size_t text = begin + mark.size();
  return messages.substr(text, messages.find('\n', text) - text);
}

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

/// A mesh whose process runs.
struct RunningMesh {
  size_t task = 0;
  std::unique_ptr<ChildProcess> process;
  int threads = 1;
  size_t bytes = 0;   // of memory, estimated
  bool alone = true;  // no other mesh has run meanwhile
  size_t shown = 0;   // of its messages
  Clock::time_point start;
};

class Batch {
 public:
  explicit Batch(const Settings& s)
      : s_(s),
        tasks_(plan_batch(s)),
        rows_(tasks_.size()),
        codes_(tasks_.size(), done),
        hashes_(tasks_.size()),
        threads_(s.threads > 0 ? s.threads : thread_count()),
        jobs_(s.batch.jobs > 0 ? s.batch.jobs : threads_),
        memory_(memory_allowed(s)),
        shows_progress_(shows_progress(s)),
        bar_(shows_progress_ && tasks_.size() > 1) {
    if (!s.batch.table.empty()) require_writable(s.batch.table);
    create_folders(tasks_);
    if (shows_progress_ && tasks_.size() == 1) hand_on_columns();
    for (size_t t = 0; t < tasks_.size(); ++t) waiting_.push_back(t);
  }

  int run() {
    while (!waiting_.empty() || !running_.empty()) {
      while (starts_next()) continue;
      if (!running_.empty()) watch();
      if (caught_signal() != 0) stop();
    }
    bar_.clear();
    if (!s_.batch.table.empty()) PendingFile(s_.batch.table, table_text(rows_, s_.batch.table)).commit();
    if (!s_.quiet && tasks_.size() > 1) print_text_as_it_is(closing_line());
    if (caught_signal() != 0) return 128 + caught_signal();
    const auto failed = std::ranges::find_if(codes_, [](int code) { return code != done; });
    return failed == codes_.end() ? done : *failed;
  }

 private:
  /// Takes the next mesh that is waiting if it may run now. Returns false if it has to wait.
  bool starts_next() {
    if (waiting_.empty() || std::ssize(running_) >= jobs_) return false;
    const size_t t = waiting_.front();
    const bool by_itself = again_.contains(t);
    if (!running_.empty() && (by_itself || again_.contains(running_.front().task))) return false;
    const size_t bytes = memory_for(tasks_[t].input, s_);
    size_t used = bytes;
    int busy = 0;
    for (const RunningMesh& other : running_) {
      used += other.bytes;
      busy += other.threads;
    }
    if (!running_.empty() && used > memory_) return false;
    waiting_.pop_front();
    if (is_done_already(t)) return true;
    const int places = by_itself ? 1
                                 : std::min(jobs_ - static_cast<int>(running_.size()),
                                            1 + static_cast<int>(waiting_.size()));
    start(t, std::max(1, (threads_ - busy) / places), bytes);
    return true;
  }

  bool is_done_already(size_t t) {
    if (!s_.batch.skip_existing) return false;
    hashes_[t] = work_hash(s_, tasks_[t]);
    std::optional<Json> row = row_if_done(tasks_[t], hashes_[t]);
    if (!row) return false;
    (*row)["file"] = tasks_[t].input.string();
    (*row)["output"] = tasks_[t].output.string();
    (*row)["status"] = "skipped";
    rows_[t] = *std::move(row);
    ++skipped_;
    if (!s_.quiet)
      tell(fmt::format("{}: skipped: {} is there already\n", printable(tasks_[t].input.string()),
                       printable(tasks_[t].output.string())));
    return true;
  }

  void start(size_t t, int threads, size_t bytes) {
    std::vector<std::string> arguments = {fmt::format("--threads={}", threads)};
    const bool single = tasks_.size() == 1;
    arguments.push_back(single && shows_progress_ ? "--progress=bar" : "--progress=none");
    if (s_.verbose) arguments.emplace_back("--verbose");
    if (s_.quiet || (!single && !s_.verbose)) arguments.emplace_back("--quiet");
    arguments.insert(arguments.end(), tasks_[t].arguments.begin(), tasks_[t].arguments.end());
    std::unique_ptr<ChildProcess> process;
    try {
      process = std::make_unique<ChildProcess>(arguments);
    } catch (const LimitError& e) {
      if (running_.empty())
        fail(t, limit_reached, printable(tasks_[t].input.string()) + ": " + e.what());
      else
        run_again_by_itself(t);
      return;
    }
    for (RunningMesh& other : running_) other.alone = false;
    running_.push_back({.task = t,
                        .process = std::move(process),
                        .threads = threads,
                        .bytes = bytes,
                        .alone = running_.empty(),
                        .start = Clock::now()});
  }

  void run_again_by_itself(size_t t) {
    again_.insert(t);
    waiting_.push_back(t);
  }

  /// A mesh that came to nothing, or not to all that it should.
  void fail(size_t t, int code, const std::string& message) {
    bar_.clear();
    print_error(message);
    close(t,
          {.exit_code = code, .status = failure_word(code), .message = message, .seconds = 0, .report = {}});
  }

  void close(size_t t, const MeshOutcome& outcome) {
    rows_[t] = mesh_row(tasks_[t], outcome);
    codes_[t] = outcome.exit_code;
    ++finished_;
  }

  /// Waits for news of the meshes that run, and ends those that are done.
  void watch() {
    constexpr int pause_ms = 200;
    std::vector<pollfd> streams;
    for (const RunningMesh& mesh : running_) mesh.process->wait_for(streams);
    ::poll(streams.data(), streams.size(), pause_ms);
    for (size_t k = 0; k < running_.size();) {
      const bool goes_on = running_[k].process->read();
      if (tasks_.size() == 1) pass_on(running_[k]);
      if (goes_on) {
        ++k;
        continue;
      }
      RunningMesh mesh = std::move(running_[k]);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(k));
      finish(mesh);
    }
    if (bar_.is_due())
      bar_.show(
          fmt::format("{} of {} meshes, {} running", finished_ + skipped_, tasks_.size(), running_.size()),
          static_cast<double>(finished_ + skipped_) / static_cast<double>(tasks_.size()));
  }

  /// Shows the messages of a single mesh as they come.
  void pass_on(RunningMesh& mesh) {
    print_text_as_it_is(std::string_view(mesh.process->errors()).substr(mesh.shown));
    mesh.shown = mesh.process->errors().size();
  }

  void finish(RunningMesh& mesh) {
    constexpr int not_started = 127;
    const size_t t = mesh.task;
    const int code = mesh.process->finish();
    const std::string name = printable(tasks_[t].input.string());
    const bool lacked_memory = code == limit_reached || code == -SIGKILL;
    if (lacked_memory && !mesh.alone && caught_signal() == 0) return run_again_by_itself(t);
    if (tasks_.size() > 1) tell(mesh.process->errors());
    if (code == not_started)
      return fail(t, internal_error, name + ": no process of its own: /proc/self/exe cannot be started");
    if (code < 0 && -code != caught_signal())
      return fail(t, lacked_memory ? limit_reached : internal_error,
                  fmt::format("{}: ended by signal {}{}", name, -code,
                              lacked_memory ? ", probably for lack of memory" : ""));
    MeshOutcome outcome{.exit_code = code < 0 ? 128 - code : code,
                        .status = "interrupted",
                        .message = last_error(mesh.process->errors()),
                        .seconds = std::chrono::duration<double>(Clock::now() - mesh.start).count(),
                        .report = {}};
    if (leaves_a_report(code)) outcome.report = report_of(mesh);
    if (code == done && !outcome.report.is_object())
      return fail(t, output_failed,
                  name + ": its report cannot be read again: " +
                      (tasks_[t].report.empty() ? "standard output" : printable(tasks_[t].report.string())) +
                      "; expected it as it was written; choose a place that nothing else writes to");
    if (code >= 0)
      outcome.status = outcome.report.is_object() ? outcome.report.value("status", "") : failure_word(code);
    close(t, outcome);
    if (tasks_.size() > 1 && !s_.quiet && leaves_a_report(code)) tell(row_in_words(rows_[t]));
    if (code == done && s_.batch.skip_existing) record(t, outcome);
  }

  /// Writes down that the mesh is done, unless its files have changed meanwhile.
  void record(size_t t, MeshOutcome outcome) {
    if (work_hash(s_, tasks_[t]) != hashes_[t]) return;
    try {
      record_done(tasks_[t], hashes_[t], rows_[t]);
    } catch (const OutputError& e) {
      bar_.clear();
      print_error(e.what());
      outcome.exit_code = codes_[t] = output_failed;
      outcome.status = failure_word(output_failed);
      outcome.message = e.what();
      rows_[t] = mesh_row(tasks_[t], outcome);
    }
  }

  Json report_of(const RunningMesh& mesh) const {
    const std::filesystem::path& file = tasks_[mesh.task].report;
    if (file.empty()) return Json::parse(mesh.process->out(), nullptr, false);
    std::ifstream stream(file);
    return Json::parse(stream, nullptr, false);
  }

  /// Hands the signal on, once; what has not begun does not begin.
  void stop() {
    if (!std::exchange(stopped_, true))
      for (const RunningMesh& mesh : running_) mesh.process->send(caught_signal());
    for (size_t t : waiting_) {
      codes_[t] = 128 + caught_signal();
      rows_[t] =
          mesh_row(tasks_[t],
                   {.exit_code = codes_[t], .status = "not_run", .message = {}, .seconds = 0, .report = {}});
    }
    waiting_.clear();
  }

  std::string closing_line() const {
    const std::string table =
        s_.batch.table.empty() ? "" : "; table in " + printable(s_.batch.table.string());
    return batch_in_words(codes_, skipped_, std::chrono::duration<double>(Clock::now() - start_).count()) +
           table + "\n";
  }

  void tell(const std::string& text) {
    if (text.empty()) return;
    bar_.clear();
    print_text_as_it_is(text);
  }

  const Settings& s_;
  std::vector<MeshTask> tasks_;
  std::vector<Json> rows_;
  std::vector<int> codes_;
  std::vector<std::string> hashes_;
  int threads_, jobs_;
  size_t memory_;
  bool shows_progress_;
  ProgressBar bar_;
  std::deque<size_t> waiting_;
  std::set<size_t> again_;  // to be run by themselves
  std::vector<RunningMesh> running_;
  int finished_ = 0, skipped_ = 0;
  bool stopped_ = false;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

int run_batch(const Settings& settings) {
  const ThreadLimit one(1);  // the work is done by other processes
  return Batch(settings).run();
}

}  // namespace hooke::app
