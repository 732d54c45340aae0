// The files that a run writes: all of them or none.
#pragma once

#include <string>
#include <vector>

#include "hooke/io/files.h"
#include "options.h"

namespace hooke::app {

/// Everything that can be known to fail before the work is done. Throws Error for an output that is another
/// file of the command line as well, OutputError for one that could not be written.
void require_outputs(const Settings& settings);

/// Writes the text to standard output. Throws OutputError.
void write_to_standard_output(const std::string& text);

/// Files that are written, but not in their places yet.
class OutputFiles {
 public:
  void add(PendingFile file) { files_.push_back(std::move(file)); }

  /// Puts them there.
  void commit() {
    for (PendingFile& file : files_) file.commit();
  }

 private:
  std::vector<PendingFile> files_;
};

}  // namespace hooke::app
