// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of a file that this program made against its nets.
#pragma once

#include <string>
#include <vector>

#include "verify/file/relations.hpp"

namespace ridgecraft::verify {

/// What contradicts the nets: sizes of model and paper, heights of tabs, numbers of faces. Only settings
/// without faults are looked at. O(n log n).
[[nodiscard]] std::vector<std::string> contradictions(const Case& given);

}  // namespace ridgecraft::verify
