// Suggestions for words that were mistyped.
#pragma once

#include <string>
#include <vector>

namespace hooke::app {

/// The known word that is nearest to this one: by the letters to put in, leave out or replace. Empty if even
/// that differs in more than a third of them, or in more than two.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace hooke::app
