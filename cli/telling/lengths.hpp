// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths as people read them.
#pragma once

#include <string>

namespace ridgecraft::cli {

/// "640 mm", "2.07 m"
[[nodiscard]] std::string metres(double mm);

}  // namespace ridgecraft::cli
