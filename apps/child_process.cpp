#include "child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include "hooke/core/error.h"

namespace hooke::app {
namespace {

[[noreturn]] void fail_to_start(int error) {
  throw LimitError(fmt::format("no process for another mesh: {}; expected one; try fewer --jobs",
                               std::generic_category().message(error)));
}

/// Becomes the program, with its own signals and this mask of them. Calls only what is allowed between fork
/// and exec.
[[noreturn]] void become_program(char* const* arguments, pid_t parent, int out, int errors,
                                 const sigset_t& mask) {
  ::setpgid(0, 0);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(128 + SIGTERM);
#else
  (void)parent;
#endif
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  for (int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_DFL);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  ::execv("/proc/self/exe", arguments);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments) {
  std::vector<char*> words;
  words.reserve(arguments.size() + 2);
  static char name[] = "hooke-remesh";
  words.push_back(name);
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  std::array<int, 2> out{}, errors{};
  if (::pipe2(out.data(), O_CLOEXEC) != 0) fail_to_start(errno);
  if (::pipe2(errors.data(), O_CLOEXEC) != 0) {
    const int error = errno;
    for (int end : out) ::close(end);
    fail_to_start(error);
  }
  // A signal in between would go to the handlers of this program, in the child, and be lost.
  sigset_t all, mask;
  ::sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, &mask);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  const int error = errno;
  if (process_ == 0) become_program(words.data(), parent, out[1], errors[1], mask);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  ::close(out[1]);
  ::close(errors[1]);
  out_.descriptor = out[0];
  errors_.descriptor = errors[0];
  for (const Stream* stream : {&out_, &errors_}) ::fcntl(stream->descriptor, F_SETFL, O_NONBLOCK);
  if (process_ < 0) {
    out_.close();
    errors_.close();
    fail_to_start(error);
  }
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    send(SIGTERM);
    finish();
  }
  out_.close();
  errors_.close();
}

void ChildProcess::Stream::close() {
  if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

void ChildProcess::Stream::read() {
  std::array<char, 1 << 16> block;
  while (descriptor >= 0) {
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count > 0)
      text.append(block.data(), count);
    else if (count < 0 && errno == EINTR)
      continue;
    else if (count < 0 && errno == EAGAIN)
      return;
    else
      close();
  }
}

bool ChildProcess::read() {
  out_.read();
  errors_.read();
  return out_.descriptor >= 0 || errors_.descriptor >= 0;
}

void ChildProcess::wait_for(std::vector<pollfd>& streams) const {
  for (const Stream* stream : {&out_, &errors_})
    if (stream->descriptor >= 0) streams.push_back({stream->descriptor, POLLIN, 0});
}

void ChildProcess::send(int signal) const {
  ::kill(process_, signal);
}

int ChildProcess::finish() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
  process_ = -1;
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace hooke::app
