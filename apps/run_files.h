// The files of a run: those that options name for reading, beside the mesh, and its outputs, which are
// written all or none.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "hooke/io/files.h"
#include "options.h"

namespace hooke::app {

/// A file and the option that names it, such as "--fix".
struct NamedFile {
  const char* role;
  std::filesystem::path path;
};

/// The files whose content decides on the result or on the exit code, in a fixed order.
std::vector<NamedFile> data_files(const Settings& settings);

/// data_files() and the file of --config, whose settings stand among those given.
std::vector<NamedFile> option_files(const Settings& settings);

/// Checks all outputs before the computation. Throws Error if an output is the same file as another input or
/// output, and OutputError if it cannot be written.
void require_outputs(const Settings& settings);

/// Files that are written to temporary files until they are committed together.
class OutputFiles {
 public:
  void add(PendingFile file) { files_.push_back(std::move(file)); }

  /// Renames all files to their targets, then writes what goes to standard output: who reads it there finds
  /// the files. If one of them fails the others are taken back. Throws OutputError, which names files that
  /// could not be taken back.
  void commit();

 private:
  std::vector<PendingFile> files_;
};

}  // namespace hooke::app
