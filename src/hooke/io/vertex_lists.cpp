#include "hooke/io/vertex_lists.h"

#include <fmt/format.h>

#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/scanner.h"
#include "hooke/io/text.h"

namespace hooke {

namespace {

double positive_length(Scanner& scanner) {
  const double length = scanner.number("length");
  if (!(length > 0)) scanner.fail(fmt::format("length {}; expected a positive number; correct it", length));
  return length;
}

int vertex_id(Scanner& scanner, int count) {
  const long long id = scanner.integer("vertex id");
  if (id < 0 || id >= count)
    scanner.fail(fmt::format("vertex id {}; expected 0 to {}; ids count from 0", id, count - 1));
  return static_cast<int>(id);
}

}  // namespace

std::vector<double> read_length_list(const std::filesystem::path& path, int count) {
  const FileBytes file = read_regular_file(path, "one length a line, for each vertex");
  const std::string name = printable(path.string());
  Scanner scanner(file.text(), name, {.comments = true});
  std::vector<double> lengths;
  while (scanner.next_line()) {
    const double length = positive_length(scanner);
    if (!scanner.token().empty())
      scanner.fail("more than one value; expected one length a line; split the line");
    if (std::cmp_equal(lengths.size(), count))
      scanner.fail(fmt::format("more than {} lengths; expected one for each vertex; remove some", count));
    lengths.push_back(length);
  }
  if (std::cmp_less(lengths.size(), count))
    throw InputError(
        fmt::format("{}: {} lengths for {} vertices; expected one for each; is it another mesh's?", name,
                    lengths.size(), count));
  return lengths;
}

std::vector<int> read_id_list(const std::filesystem::path& path, int count) {
  const FileBytes file = read_regular_file(path, "one vertex id a line");
  Scanner scanner(file.text(), printable(path.string()), {.comments = true});
  std::vector<int> ids;
  while (scanner.next_line()) {
    const int id = vertex_id(scanner, count);
    if (!scanner.token().empty()) scanner.fail("more than one value; expected one vertex id a line");
    ids.push_back(id);
  }
  return ids;
}

std::vector<EdgeLength> read_edge_lengths(const std::filesystem::path& path, int vertex_count) {
  const FileBytes file = read_regular_file(path, "two vertex ids and a length a line");
  Scanner scanner(file.text(), printable(path.string()), {.comments = true});
  std::vector<EdgeLength> lengths;
  while (scanner.next_line()) {
    EdgeLength edge;
    edge.line = scanner.line();
    for (int& end : edge.ends) end = vertex_id(scanner, vertex_count);
    if (edge.ends[0] == edge.ends[1])
      scanner.fail(
          fmt::format("vertex id {} twice; expected the two ends of an edge; correct one", edge.ends[0]));
    edge.length = positive_length(scanner);
    if (!scanner.token().empty())
      scanner.fail("more than three values; expected two vertex ids and a length; split the line");
    lengths.push_back(edge);
  }
  return lengths;
}

std::string map_text(const std::vector<MapEntry>& map) {
  std::string text;
  for (const MapEntry& entry : map) {
    append_number(text, entry.vertex);
    text += ' ';
    append_number(text, entry.position.face);
    for (double weight : entry.position.weights) {
      text += ' ';
      append_number(text, weight + 0.);  // no -0
    }
    text += '\n';
  }
  return text;
}

}  // namespace hooke
