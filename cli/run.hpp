// SPDX-License-Identifier: GPL-3.0-or-later
// The program without its main(): arguments in, exit code out.
#pragma once

#include <string>
#include <vector>

#include "cli/report/messages.hpp"

namespace ridgecraft::cli {

/// Does what the arguments (without the program's name) ask for. Results go to standard output, everything
/// else to standard error. Never throws.
[[nodiscard]] ExitCode run(const std::vector<std::string>& arguments) noexcept;

}  // namespace ridgecraft::cli
