// The manual page, from the table of options.
#pragma once

#include <string>
#include <vector>

#include "option_table.h"

namespace hooke::app {

/// The page hooke-remesh(1) for man.
std::string man_page(const std::vector<OptionEntry>& entries);

}  // namespace hooke::app
