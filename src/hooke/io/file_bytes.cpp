#include "hooke/io/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
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

/// Reads `count` bytes from `offset` on to `to`, fewer only where the file ends. Returns how many.
size_t read_range(int descriptor, size_t offset, size_t count, char* to, const std::string& name) {
  size_t used = 0;
  while (used < count) {
    const ssize_t more = ::pread(descriptor, to + used, count - used, static_cast<off_t>(offset + used));
    if (more == 0) break;
    if (more < 0 && errno == EINTR) continue;
    if (more < 0)
      throw InputError(fmt::format("{}: cannot be read: {}; expected a readable file; check the disk", name,
                                   reason(errno)));
    used += static_cast<size_t>(more);
  }
  return used;
}

/// Reads as many bytes as expected on all cores, then whatever has come to be there since.
FileBytes read_to_end(int descriptor, size_t expected_size, const std::string& name) {
  constexpr size_t block = size_t{1} << 22;
  FileBytes file{UnfilledVector<char>(expected_size + 1)};
  UnfilledVector<char>& bytes = file.bytes;
  std::vector<size_t> counts((expected_size + block - 1) / block);
  parallel_for(counts.size(), 1, [&](size_t first, size_t last) {
    for (size_t b = first; b < last; ++b)
      counts[b] = read_range(descriptor, b * block, std::min(block, expected_size - b * block),
                             bytes.data() + b * block, name);
  });
  size_t used = 0;  // up to the first block that was not there
  for (size_t b = 0; b < counts.size() && used == b * block; ++b) used += counts[b];
  while (true) {
    const size_t room = bytes.size() - used;
    const size_t count = read_range(descriptor, used, room, bytes.data() + used, name);
    used += count;
    if (count < room) break;
    bytes.resize(2 * used);
  }
  bytes.resize(used);
  return file;
}

}  // namespace

FileBytes read_regular_file(const std::filesystem::path& path) {
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
    FileBytes content = read_to_end(file.get(), static_cast<size_t>(status.st_size), name);
    if (content.bytes.empty())
      throw InputError(name + ": the file is empty; expected a mesh; check how it was made");
    return content;
  } catch (const std::bad_alloc&) {
    throw LimitError(
        fmt::format("{}: {} bytes do not fit in memory; use a machine with more", name, status.st_size));
  } catch (const std::length_error&) {
    throw LimitError(
        fmt::format("{}: {} bytes do not fit in memory; use a machine with more", name, status.st_size));
  }
}

}  // namespace hooke
