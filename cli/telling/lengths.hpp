// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths as people read them.
#pragma once

#include <string>

#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::cli {

/// "640 mm", "2.07 m"
[[nodiscard]] std::string metres(double mm);

/// "; the file counts in metres, y up: this is 1:13.3 of its size"; empty where the file tells no unit.
[[nodiscard]] std::string scale_text(const prepare::Prepared& prepared);

}  // namespace ridgecraft::cli
