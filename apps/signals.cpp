#include "signals.h"

#include <csignal>

namespace hooke::app {
namespace {

volatile std::sig_atomic_t caught = 0;

extern "C" void on_signal(int signal) {
  caught = signal;
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

int caught_signal() {
  return caught;
}

}  // namespace hooke::app
