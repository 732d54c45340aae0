// A command of its own in another process, whose streams are read while it runs.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

struct pollfd;

namespace hooke::app {

/// This program with other arguments, in a process group of its own, so that keys of the terminal do not
/// reach it. It gets SIGTERM if this process ends first.
class ChildProcess {
 public:
  /// Throws LimitError if the system gives no process.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Appends what is there to read to out() and errors(). Returns false once both streams have ended.
  bool read();

  /// Adds its open streams to those to wait for.
  void wait_for(std::vector<pollfd>& streams) const;

  void send(int signal) const;

  /// Waits for its end; to be called once, after read() has returned false. Returns the exit code, or minus
  /// the number of the signal that ended it.
  int finish();

  const std::string& out() const { return out_.text; }
  const std::string& errors() const { return errors_.text; }

 private:
  struct Stream {
    int descriptor = -1;
    std::string text;

    void read();
    void close();
  };

  pid_t process_ = -1;
  Stream out_, errors_;
};

}  // namespace hooke::app
