#include "signals.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string_view>

namespace hooke::app {
namespace {

volatile std::sig_atomic_t caught = 0;
volatile std::sig_atomic_t answers = 0;

constexpr std::string_view answer = "\nhooke-remesh: stopping; once more ends at once, without a result\n";

extern "C" void on_signal(int signal) {
  caught = signal;
  if (answers == 0) return;
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, answer.data(), answer.size());
  errno = error;
}

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is reported as a failed write instead
  std::signal(SIGXFSZ, SIG_IGN);  // so is the file size limit
}

void answer_signals() {
  answers = 1;
}

int caught_signal() {
  return caught;
}

}  // namespace hooke::app
