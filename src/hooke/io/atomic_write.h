// A file is there whole, or as it was before: written beside its place, checked, synced, renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace hooke {

/// Writes the bytes to `path` through a temporary file in the same folder. A symbolic link is followed: the
/// file it points to is replaced. The mode is that of the file replaced, or what the umask gives a new file.
/// Throws OutputError that names the file and the system's reason; then no temporary is left, and an old file
/// is as it was (but for a failing sync of the folder after the rename, which the message says).
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws OutputError if write_file_atomically could not start: a missing or read-only folder, a target that
/// is a folder, a device, a dangling link or write-protected. Creates and removes a temporary file to find
/// out.
void require_writable(const std::filesystem::path& path);

/// Throws Error if both names lead to the same file, directly or by a link of any kind.
void require_distinct(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace hooke
