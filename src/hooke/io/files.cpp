#include "hooke/io/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <new>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"

namespace hooke {
namespace {

// A POSIX file descriptor, closed at the end of its scope.

class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

  void reset(int descriptor) {
    close();
    descriptor_ = descriptor;
  }

  /// False if closing fails, which can mean lost writes; errno has the reason.
  bool close() { return !is_open() || ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

namespace fs = std::filesystem;

std::string reason(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
  throw OutputError(fmt::format("{}: {}", printable(path.native()), what));
}

[[noreturn]] void fail_by_system(const fs::path& path, std::string_view action, int error) {
  fail(path, fmt::format("{}: {}; expected a writable place with room; nothing was changed", action,
                         reason(error)));
}

// The file that the output will create or replace.
struct Target {
  fs::path path;               // with links resolved
  std::optional<mode_t> mode;  // of the existing file; none if there is none
};

Target find_target(const fs::path& path) {
  if (path.empty() || !path.has_filename())
    fail(path, "is not the name of a file; expected one; name the output");
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    const int error = errno;
    struct stat link {};
    if (error == ENOENT && ::lstat(path.c_str(), &link) != 0) return {path, std::nullopt};
    if (error == ENOENT)
      fail(path, "is a link to a missing file; expected a file or a free name; remove the link");
    fail_by_system(path, "cannot be examined", error);
  }
  if (S_ISDIR(status.st_mode)) fail(path, "is a folder; expected a file or a free name; name a file in it");
  if (!S_ISREG(status.st_mode))
    fail(path, "is not a regular file; expected a file or a free name; choose another");
  if (::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0)
    fail_by_system(path, "is write-protected", errno);
  std::error_code error;
  const fs::path resolved = fs::canonical(path, error);
  if (error) fail_by_system(path, "cannot be resolved", error.value());
  return {resolved, status.st_mode & 07777};
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// A new file in the folder of the target, removed at the end of its scope unless it was renamed.
class TemporaryFile {
 public:
  // `name`: the path used in messages; `target`: the path that the file will be renamed to.
  TemporaryFile(const fs::path& name, const fs::path& target) : name_(name), file_(-1) {
    constexpr int max_tries = 100;
    std::random_device random;
    for (int k = 0; k < max_tries && !file_.is_open(); ++k) {
      const auto number = static_cast<std::uint64_t>(random()) << 32 | random();
      path_ = folder_of(target) / fmt::format(".hooke-{:016x}.tmp", number);
      file_.reset(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
      if (!file_.is_open() && errno != EEXIST) break;
    }
    if (!file_.is_open()) fail_by_system(name_, "cannot be created in its folder", errno);
  }
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_.get(), bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail_by_system(name_, "cannot be written", errno);
      bytes.remove_prefix(count);
    }
  }

  void set_mode(mode_t mode) {
    if (::fchmod(file_.get(), mode) != 0)
      fail_by_system(name_, "cannot be given the mode of the old file", errno);
  }

  void sync_and_close() {
    if (::fsync(file_.get()) != 0) fail_by_system(name_, "cannot be synced", errno);
    if (!file_.close()) fail_by_system(name_, "cannot be closed", errno);
  }

  void rename_to(const fs::path& target) {
    if (std::rename(path_.c_str(), target.c_str()) != 0)
      fail_by_system(name_, "cannot be put in its place", errno);
    path_.clear();
  }

  // Exchanges the names of the two files in one step: this is then the older one. False where the file system
  // cannot do that, or there is no older one.
  bool exchange_with(const fs::path& target) const noexcept {
#ifdef RENAME_EXCHANGE
    return ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0;
#else
    (void)target;
    return false;
#endif
  }

 private:
  fs::path name_, path_;
  FileDescriptor file_;
};

void sync_folder(const fs::path& name, const fs::path& target) {
  FileDescriptor folder(::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.is_open()) return;  // a folder may be writable without being readable
  const bool synced = ::fsync(folder.get()) == 0;
  if (!synced && errno != EINVAL && errno != ENOTSUP)  // not supported by every file system
    fail(name,
         fmt::format("was written, but its folder cannot be synced: {}; it may be lost in a power failure",
                     reason(errno)));
}

}  // namespace

/// The temporary file and its target.
class PendingFile::Written {
 public:
  Written(const fs::path& path, std::string_view bytes)
      : path_(path), target_(find_target(path)), temporary_(path, target_.path) {
    temporary_.write(bytes);
    if (target_.mode) temporary_.set_mode(*target_.mode);
    temporary_.sync_and_close();
  }

  void commit() {
    exchanged_ = target_.mode && temporary_.exchange_with(target_.path);
    if (!exchanged_) temporary_.rename_to(target_.path);
    sync_folder(path_, target_.path);
  }

  bool take_back() const noexcept {
    if (target_.mode) return exchanged_ && temporary_.exchange_with(target_.path);
    return ::unlink(target_.path.c_str()) == 0;
  }

 private:
  bool exchanged_ = false;  // the temporary file is the older one
  fs::path path_;
  Target target_;
  TemporaryFile temporary_;
};

PendingFile::PendingFile(const fs::path& path, std::string_view bytes)
    : written_(std::make_unique<Written>(path, bytes)) {}

PendingFile PendingFile::to_standard_output(std::string bytes) {
  PendingFile file;
  file.bytes_ = std::move(bytes);
  return file;
}

PendingFile::PendingFile(PendingFile&&) noexcept = default;
PendingFile& PendingFile::operator=(PendingFile&&) noexcept = default;
PendingFile::~PendingFile() = default;

void PendingFile::commit() {
  if (written_)
    written_->commit();
  else
    write_to_standard_output(bytes_);
}

bool PendingFile::take_back() noexcept {
  return written_ && written_->take_back();
}

void require_writable(const fs::path& path) {
  TemporaryFile(path, find_target(path).path);
}

bool same_file(const fs::path& a, const fs::path& b) {
  struct stat first {
  }, second{};
  const bool a_exists = ::stat(a.c_str(), &first) == 0, b_exists = ::stat(b.c_str(), &second) == 0;
  if (a_exists && b_exists) return first.st_dev == second.st_dev && first.st_ino == second.st_ino;
  const auto resolved = [](const fs::path& path) {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(folder_of(path), error);
    return (error ? folder_of(path).lexically_normal() : folder) / path.filename();
  };
  return a_exists == b_exists && resolved(a) == resolved(b);
}

namespace {

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

/// Reads `count` bytes, starting at `offset`, into `to`; fewer only at the end of the file. Returns the
/// number of bytes read.
size_t read_range(int descriptor, size_t offset, size_t count, char* to, const std::string& name) {
  size_t used = 0;
  while (used < count) {
    const ssize_t more = ::pread(descriptor, to + used, count - used, static_cast<off_t>(offset + used));
    if (more == 0) break;
    if (more < 0 && errno == EINTR) continue;
    if (more < 0)
      throw InputError(fmt::format("{}: cannot be read: {}; expected a readable file; check the disk", name,
                                   reason(errno)));
    used += more;
  }
  return used;
}

/// Reads the expected number of bytes in parallel, then any bytes that were appended meanwhile.
FileBytes read_to_end(int descriptor, size_t expected_size, const std::string& name) {
  constexpr size_t block = size_t{1} << 22;
  FileBytes file{UninitializedVector<char>(expected_size + 1)};
  UninitializedVector<char>& bytes = file.bytes;
  std::vector<size_t> counts((expected_size + block - 1) / block);
  parallel_for(counts.size(), 1, [&](size_t first, size_t last) {
    for (size_t b = first; b < last; ++b)
      counts[b] = read_range(descriptor, b * block, std::min(block, expected_size - b * block),
                             bytes.data() + b * block, name);
  });
  size_t used = 0;  // bytes up to the first incomplete block
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

FileBytes read_regular_file(const std::filesystem::path& path, std::string_view content) {
  if (path.empty())
    throw InputError(fmt::format("'': the input has no name; expected a file with {}; name one", content));
  const std::string name = printable(path.native());
  // O_NONBLOCK: otherwise opening a pipe without a writer would block.
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
    throw InputError(fmt::format("{}: is {}; expected a regular file with {}; name one", name,
                                 kind_of(status.st_mode), content));
  try {
    FileBytes read = read_to_end(file.get(), status.st_size, name);
    if (read.bytes.empty())
      throw InputError(
          fmt::format("{}: the file is empty; expected {}; check how it was made", name, content));
    return read;
  } catch (const std::bad_alloc&) {
    throw LimitError(
        fmt::format("{}: {} bytes do not fit in memory; use a machine with more", name, status.st_size));
  } catch (const std::length_error&) {
    throw LimitError(
        fmt::format("{}: {} bytes do not fit in memory; use a machine with more", name, status.st_size));
  }
}

bool is_standard_input(const std::filesystem::path& path) {
  return path == "-" || path == "/dev/stdin";
}

bool is_standard_output(const std::filesystem::path& path) {
  return path == "-";
}

FileBytes read_standard_input() {
  FileBytes content{UninitializedVector<char>(size_t{1} << 16)};
  UninitializedVector<char>& bytes = content.bytes;
  size_t used = 0;
  try {
    while (true) {
      if (used == bytes.size()) bytes.resize(2 * used);
      const ssize_t count = ::read(STDIN_FILENO, bytes.data() + used, bytes.size() - used);
      if (count == 0) break;
      if (count < 0 && errno == EINTR) continue;
      if (count < 0)
        throw InputError(fmt::format(
            "standard input: cannot be read: {}; expected a mesh; check where it comes from", reason(errno)));
      used += count;
    }
  } catch (const std::bad_alloc&) {
    throw LimitError(fmt::format(
        "standard input: more than {} bytes do not fit in memory; use a machine with more", used));
  }
  bytes.resize(used);
  if (bytes.empty()) throw InputError("standard input: is empty; expected a mesh; check where it comes from");
  return content;
}

void write_to_standard_output(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw OutputError(fmt::format("standard output: cannot be written: {}; expected an open reader or room",
                                    reason(errno)));
    bytes.remove_prefix(count);
  }
}

}  // namespace hooke
