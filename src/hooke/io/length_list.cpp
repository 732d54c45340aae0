#include "hooke/io/length_list.h"

#include <fmt/format.h>

#include "hooke/core/error.h"
#include "hooke/io/file_bytes.h"
#include "hooke/io/printable.h"
#include "hooke/io/scanner.h"

namespace hooke {

std::vector<double> read_length_list(const std::filesystem::path& path, int count) {
  const FileBytes file = read_regular_file(path);
  const std::string name = printable(path.string());
  Scanner scanner(file.text(), name, {.comments = true});
  std::vector<double> lengths;
  while (scanner.next_line()) {
    const double length = scanner.number("length");
    if (!(length > 0)) scanner.fail(fmt::format("length {}; expected a positive number; correct it", length));
    if (!scanner.token().empty())
      scanner.fail("more than one value; expected one length a line; split the line");
    if (lengths.size() == static_cast<size_t>(count))
      scanner.fail(fmt::format("more than {} lengths; expected one for each vertex; remove some", count));
    lengths.push_back(length);
  }
  if (lengths.size() < static_cast<size_t>(count))
    throw InputError(
        fmt::format("{}: {} lengths for {} vertices; expected one for each; is it another mesh's?", name,
                    lengths.size(), count));
  return lengths;
}

}  // namespace hooke
