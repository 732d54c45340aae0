#include "input_files.h"

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

}  // namespace hooke::app
