// Completion of command lines in shells, from the table of options.
#pragma once

#include <string>
#include <vector>

#include "option_table.h"

namespace hooke::app {

/// A script for the shell that completes the names of options, their values where those are words, and files.
std::string completion(Shell shell, const std::vector<OptionEntry>& entries);

}  // namespace hooke::app
