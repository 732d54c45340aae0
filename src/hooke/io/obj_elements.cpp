#include "hooke/io/obj_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "hooke/core/error.h"
#include "hooke/io/printable.h"

namespace hooke {

void count_one(const Scanner& in, ObjElements& elements) {
  if (elements.count == std::numeric_limits<int>::max())
    in.fail("too many elements; expected at most 2147483647 of a kind; split the mesh");
  ++elements.count;
}

void read_numbers(Scanner& in, ObjElements& elements) {
  count_one(in, elements);
  auto column = elements.values.col(elements.count - 1);
  int numbers = 0;
  bool broken = false;
  for (std::string_view token = in.token(); !token.empty(); token = in.token(), ++numbers)
    broken |= numbers >= 3 || parse_number(token, column[numbers]) != NumberError::none;
  broken |= numbers < elements.least_numbers;
  if (broken && elements.broken_line == 0) elements.broken_line = in.line();
  elements.numbers = std::max(elements.numbers, numbers);
}

int read_index(const Scanner& in, std::string_view text, std::string_view corner, ObjElements& elements) {
  long long index = 0;
  const NumberError error = parse_integer(text, index);
  if (error == NumberError::malformed)
    in.fail(fmt::format("face corner {}; expected v, v/vt, v//vn or v/vt/vn with integers; correct it",
                        in_quotes(corner)));
  if (error == NumberError::too_large || index > std::numeric_limits<int>::max() || index < -elements.count)
    in.fail(fmt::format("{} index {} where {} were read so far; expected an existing one; correct the index",
                        elements.kind, printable(text), elements.count));
  if (index == 0)
    in.fail(
        fmt::format("{} index 0; expected 1 or more, or a negative one; OBJ counts from 1", elements.kind));
  const int id = static_cast<int>(index > 0 ? index - 1 : elements.count + index);
  if (id > elements.greatest) {
    elements.greatest = id;
    elements.greatest_line = in.line();
  }
  return id;
}

void read_corner_index(const Scanner& in, std::string_view text, std::string_view corner, size_t number,
                       ObjElements& elements) {
  const int id = read_index(in, text, corner, elements);
  elements.of_corners.resize(number, -1);
  elements.of_corners.push_back(id);
}

void check_greatest(const std::string& name, const ObjElementPieces& pieces) {
  if (pieces.empty()) return;
  const ObjElements& asked =
      **std::ranges::max_element(pieces, {}, [](const ObjElements* elements) { return elements->greatest; });
  const int count = pieces.back()->count;
  if (asked.greatest >= count)
    throw InputError(
        fmt::format("{}:{}: {} index {}; expected at most {}, the number in the file; correct the index",
                    name, asked.greatest_line, asked.kind, asked.greatest + 1LL, count));
}

void keep_elements(const ObjElementPieces& pieces, const CornerDataKind& kind, MeshFile& file,
                   std::vector<std::string>& not_kept) {
  const ObjElements& all = *pieces.front();
  if (all.values.cols() == 0) return;
  CornerData data{all.values, {}};
  int numbers = 0, broken_line = 0;
  for (const ObjElements* piece : pieces) {
    data.elements.insert(data.elements.end(), piece->of_corners.begin(), piece->of_corners.end());
    numbers = std::max(numbers, piece->numbers);
    if (broken_line == 0) broken_line = piece->broken_line;
  }
  const auto without = std::ranges::count(data.elements, -1);
  const auto corners = std::ssize(data.elements);
  if (broken_line > 0)
    not_kept.push_back(fmt::format("{} (line {}; expected {}3 finite numbers)", kind.what, broken_line,
                                   all.least_numbers < 3 ? "1 to " : ""));
  else if (without == corners)
    not_kept.emplace_back(kind.what);
  else if (without > 0)
    not_kept.push_back(fmt::format("{} ({} of {} face corners have none)", kind.what, without, corners));
  else
    keep_as_vertex_data(file, data, static_cast<size_t>(numbers), kind);
}

}  // namespace hooke
