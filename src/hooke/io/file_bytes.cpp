#include "hooke/io/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>

#include "hooke/error.h"
#include "hooke/io/file_descriptor.h"
#include "hooke/io/printable.h"

namespace hooke {
namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

std::string read_to_end(int descriptor, size_t expected_size, const std::string& name) {
  std::string bytes;
  size_t used = 0;
  while (true) {
    if (used == bytes.size()) bytes.resize(used == 0 ? expected_size + 1 : 2 * used);
    const ssize_t count = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (count == 0) break;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw InputError(fmt::format("{}: cannot be read: {}; expected a readable file; check the disk", name,
                                   reason(errno)));
    used += static_cast<size_t>(count);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace

std::string read_regular_file(const std::filesystem::path& path) {
  if (path.empty()) throw InputError("'': the input has no name; expected a mesh file; name one");
  const std::string name = printable(path.native());
  // O_NONBLOCK: opening a pipe without a writer would wait for ever.
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!file.is_open())
    throw InputError(
        fmt::format("{}: cannot be opened: {}; expected a readable file; check name and permissions", name,
                    reason(errno)));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0)
    throw InputError(
        fmt::format("{}: cannot be examined: {}; expected a regular file; check it", name, reason(errno)));
  if (!S_ISREG(status.st_mode))
    throw InputError(
        fmt::format("{}: is {}; expected a regular file; name a mesh file", name, kind_of(status.st_mode)));
  try {
    std::string bytes = read_to_end(file.get(), static_cast<size_t>(status.st_size), name);
    if (bytes.empty()) throw InputError(name + ": the file is empty; expected a mesh; check how it was made");
    return bytes;
  } catch (const std::bad_alloc&) {
    throw LimitError(
        fmt::format("{}: {} bytes do not fit in memory; use a machine with more", name, status.st_size));
  } catch (const std::length_error&) {
    throw LimitError(
        fmt::format("{}: {} bytes do not fit in memory; use a machine with more", name, status.st_size));
  }
}

}  // namespace hooke
