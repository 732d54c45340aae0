#include "nearest_word.h"

#include <algorithm>

#include "hooke/core/edit_distance.h"

namespace hooke::app {
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
