// Any bytes as a file of settings: it is taken or refused with a message, and what it says means the same on
// the command line.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "hooke/core/error.h"
#include "options.h"

namespace {

using hooke::app::GivenOption;
using hooke::app::Settings;

/// A file in memory that can be opened by its name.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : descriptor_(::memfd_create("config", 0)) {
    if (::write(descriptor_, data, size) != static_cast<ssize_t>(size)) std::abort();
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

std::vector<std::string> as_arguments(const std::vector<GivenOption>& options) {
  std::vector<std::string> arguments, inputs;
  for (const GivenOption& option : options) {
    if (option.name == "INPUT") inputs = option.values;
    if (option.name == "INPUT") continue;
    if (option.values.empty()) arguments.push_back("--" + option.name);
    for (const std::string& value : option.values) arguments.push_back("--" + option.name + "=" + value);
  }
  arguments.emplace_back("--");
  arguments.insert(arguments.end(), inputs.begin(), inputs.end());
  return arguments;
}

bool same(const std::vector<GivenOption>& a, const std::vector<GivenOption>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (a[k].name != b[k].name || a[k].values != b[k].values) return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hooke;
  const MemoryFile file(data, size);
  Settings settings;
  try {
    settings = app::parse_arguments({"in.obj", "--output=out.obj", "--config=" + file.name()});
  } catch (const Error&) {
    return 0;
  }
  if (!same(app::parse_arguments(as_arguments(settings.given)).given, settings.given)) std::abort();
  return 0;
}
