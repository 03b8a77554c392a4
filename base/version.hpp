// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace ridgecraft {

/// "0.1.0": semantic versioning.
[[nodiscard]] std::string version();

/// "ridgecraft 0.1.0": what every file says of the program that made it.
[[nodiscard]] std::string program_and_version();

}  // namespace ridgecraft
