#include "run_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/springs/sizing.h"

namespace hooke::app {

std::vector<NamedFile> data_files(const Settings& s) {
  std::vector<NamedFile> files = {
      {"--fix", s.fix}, {"--edge-lengths", s.edge_lengths}, {"--compare", s.compare}};
  if (s.sizing.kind == SizingSource::Kind::file) files.push_back({"--sizing", s.sizing.name});
  std::erase_if(files, [](const NamedFile& file) { return file.path.empty(); });
  return files;
}

std::vector<NamedFile> option_files(const Settings& s) {
  std::vector<NamedFile> files = data_files(s);
  if (!s.config.empty()) files.push_back({"--config", s.config});
  return files;
}

namespace {

std::vector<NamedFile> inputs_of(const Settings& s) {
  std::vector<NamedFile> files = option_files(s);
  if (!is_standard_input(s.input)) files.push_back({"INPUT", s.input});
  return files;
}

std::vector<NamedFile> outputs_of(const Settings& s) {
  std::vector<NamedFile> files;
  for (const NamedFile& file : {NamedFile{"--output", is_standard_output(s.output) ? "" : s.output},
                                {"--report", s.report == "-" ? "" : s.report},
                                {"--fields", s.fields},
                                {"--trace", s.trace},
                                {"--trace-steps", s.trace_steps},
                                {"--map", s.map}})
    if (!file.path.empty()) files.push_back(file);
  return files;
}

}  // namespace

void require_outputs(const Settings& s) {
  std::vector<NamedFile> taken = inputs_of(s);
  for (const NamedFile& file : outputs_of(s)) {
    for (const NamedFile& other : taken)
      if (same_file(other.path, file.path))
        throw Error(fmt::format("{} {}: is the file {} of {}; expected a file of its own; choose another",
                                file.role, printable(file.path.native()), printable(other.path.native()),
                                other.role));
    require_writable(file.path);
    taken.push_back(file);
  }
}

void OutputFiles::commit() {
  std::stable_partition(files_.begin(), files_.end(),
                        [](const PendingFile& file) { return !file.is_standard_output(); });
  std::size_t done = 0;
  try {
    for (; done < files_.size(); ++done) files_[done].commit();
  } catch (const OutputError& e) {
    std::size_t left = 0;
    while (done > 0) left += files_[--done].take_back() ? 0 : 1;
    if (left == 0) throw;
    throw OutputError(fmt::format("{}; {} of the other output files were already replaced", e.what(), left));
  }
}

}  // namespace hooke::app
