// SPDX-License-Identifier: GPL-3.0-or-later
// From words to values.
#pragma once

#include <string>
#include <vector>

#include "cli/arguments/options.hpp"

namespace ridgecraft::cli {

/// Parses the arguments after the program's name. Throws Error(usage) with one sentence.
[[nodiscard]] Job parse_arguments(const std::vector<std::string>& arguments);

}  // namespace ridgecraft::cli
