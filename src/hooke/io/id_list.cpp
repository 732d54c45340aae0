#include "hooke/io/id_list.h"

#include <fmt/format.h>

#include "hooke/io/file_bytes.h"
#include "hooke/io/printable.h"
#include "hooke/io/scanner.h"

namespace hooke {

std::vector<int> read_id_list(const std::filesystem::path& path, int count) {
  const FileBytes file = read_regular_file(path);
  Scanner scanner(file.text(), printable(path.string()), {.comments = true});
  std::vector<int> ids;
  while (scanner.next_line()) {
    const long long id = scanner.integer("vertex id");
    if (id < 0 || id >= count)
      scanner.fail(fmt::format("vertex id {}; expected 0 to {}; ids count from 0", id, count - 1));
    if (!scanner.token().empty()) scanner.fail("more than one value; expected one vertex id a line");
    ids.push_back(static_cast<int>(id));
  }
  return ids;
}

}  // namespace hooke
