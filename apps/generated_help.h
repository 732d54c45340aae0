// Help from the table of options for other programs: the manual page, and completion in shells.
#pragma once

#include <string>
#include <vector>

#include "option_table.h"

namespace hooke::app {

/// The page hooke-remesh(1) for man.
std::string man_page(const std::vector<OptionEntry>& entries);

/// A script for the shell that completes the names of options, their values where those are words, and files.
std::string completion(Shell shell, const std::vector<OptionEntry>& entries);

}  // namespace hooke::app
