// File input and output: reads whole files, and replaces files atomically (written to a temporary file,
// checked, synced, renamed), so that a target is either complete or unchanged.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "hooke/core/lists.h"

namespace hooke {

/// A complete, synced temporary file that commit() renames to its target. Without commit() it is removed and
/// nothing changes, so a set of files can be written all or none.
class PendingFile {
 public:
  /// Writes the bytes to a temporary file in the folder of `path`. Symbolic links are followed: the file they
  /// point to will be replaced. The mode is that of the file to be replaced, or given by the umask for a new
  /// file. Throws OutputError with the file name and the system's reason; then no temporary file is left.
  PendingFile(const std::filesystem::path& path, std::string_view bytes);

  /// The bytes instead, which commit() writes to standard output.
  static PendingFile to_standard_output(std::string bytes);

  PendingFile(PendingFile&&) noexcept;
  PendingFile& operator=(PendingFile&&) noexcept;
  ~PendingFile();

  /// Renames the temporary file to its target. An older file is kept under the temporary name until the end
  /// of this object, for take_back(). To be called at most once. Throws OutputError; an existing file is then
  /// unchanged, unless only the sync of the folder failed, as the message says.
  void commit();

  /// Undoes commit(): the older file is there again, or none if there was none. To be called at most once,
  /// after a commit() that succeeded, when another file of the set could not be committed. Returns false if
  /// the file system cannot do that, and for standard output.
  bool take_back() noexcept;

  bool is_standard_output() const { return !written_; }

 private:
  PendingFile() = default;

  class Written;
  std::unique_ptr<Written> written_;  // null for standard output
  std::string bytes_;                 // for standard output
};

/// Throws OutputError if a PendingFile could not be created: the folder is missing or read-only, or the
/// target is a folder, a device, a dangling link or write-protected. Creates and removes a temporary file.
void require_writable(const std::filesystem::path& path);

/// Whether both paths name the same file, directly or through links. The files need not exist.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The bytes of a file.

struct FileBytes {
  UninitializedVector<char> bytes;

  std::string_view text() const& { return {bytes.data(), bytes.size()}; }
  std::string_view text() const&& = delete;  // the view would outlive the bytes
};

/// Reads a whole regular file, which should hold `content`, as messages say. Throws InputError if it is
/// missing, not a regular file (such as a folder or a pipe), empty or unreadable, and LimitError if it does
/// not fit in memory. Does not block on a pipe.
FileBytes read_regular_file(const std::filesystem::path& path, std::string_view content = "a mesh");

/// Whether the path stands for a standard stream of the process: "-", also "/dev/stdin" for the input.
bool is_standard_input(const std::filesystem::path& path);
bool is_standard_output(const std::filesystem::path& path);

/// Reads standard input to its end. Throws like read_regular_file().
FileBytes read_standard_input();

/// Writes the bytes to standard output. Throws OutputError.
void write_to_standard_output(std::string_view bytes);

}  // namespace hooke
