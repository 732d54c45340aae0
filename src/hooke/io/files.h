// A file is there whole, or as it was before: written beside its place, checked, synced, renamed.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "hooke/core/lists.h"

namespace hooke {

/// A file that is written, checked and synced beside its place, where commit() puts it. Without commit() it
/// is removed, and nothing has changed: so several files can be there all or not at all.
class PendingFile {
 public:
  /// Writes the bytes to a temporary file in the folder of `path`. A symbolic link is followed: the file it
  /// points to is to be replaced. The mode is that of the file to be replaced, or what the umask gives a new
  /// file. Throws OutputError that names the file and the system's reason; then no temporary is left.
  PendingFile(const std::filesystem::path& path, std::string_view bytes);
  PendingFile(PendingFile&&) noexcept;
  ~PendingFile();

  /// Puts the file in its place, once. Throws OutputError; then an old file is as it was (but for a failing
  /// sync of the folder after the rename, which the message says).
  void commit();

 private:
  class Written;
  std::unique_ptr<Written> written_;
};

/// Throws OutputError if a PendingFile could not be made: a missing or read-only folder, a target that
/// is a folder, a device, a dangling link or write-protected. Creates and removes a temporary file to find
/// out.
void require_writable(const std::filesystem::path& path);

/// Do both names lead to the same file, directly or by a link of any kind? A file need not be there yet.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// All bytes of a regular file.

struct FileBytes {
  UnfilledVector<char> bytes;

  std::string_view text() const& { return {bytes.data(), bytes.size()}; }
  std::string_view text() const&& = delete;  // it would outlive them
};

/// Throws InputError if the file is missing, not a regular file (a folder, a pipe, a device ...), empty or
/// unreadable, and LimitError if it does not fit in memory. Never blocks on a pipe.
FileBytes read_regular_file(const std::filesystem::path& path);

}  // namespace hooke
