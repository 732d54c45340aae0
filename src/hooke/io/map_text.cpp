#include "hooke/io/map_text.h"

#include "hooke/io/append_number.h"

namespace hooke {

std::string map_text(const std::vector<MapEntry>& map) {
  std::string text;
  for (const MapEntry& entry : map) {
    append_number(text, entry.vertex);
    text += ' ';
    append_number(text, entry.place.face);
    for (double weight : entry.place.weights) {
      text += ' ';
      append_number(text, weight + 0.);  // no -0
    }
    text += '\n';
  }
  return text;
}

}  // namespace hooke
