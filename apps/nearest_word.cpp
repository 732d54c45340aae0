#include "nearest_word.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

namespace hooke::app {
namespace {

/// How many letters must be put in, left out or replaced to make one word of the other.
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string nearest;
  size_t least = std::max<size_t>(2, word.size() / 3) + 1;
  for (const std::string& other : known)
    if (const size_t distance = edit_distance(word, other); distance < least) {
      least = distance;
      nearest = other;
    }
  return nearest;
}

}  // namespace hooke::app
