// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of a file that this program made, by themselves and against the nets.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "verify/relations/case.hpp"

namespace ridgecraft::verify {

/// A hash of bytes as hexadecimal digits.
[[nodiscard]] bool is_hash(std::string_view text);

/// What is wrong with them, a sentence each: unknown or missing ones, values that no option takes, values
/// that contradict each other.
[[nodiscard]] std::vector<std::string> faults_of_settings(const Settings& settings);

/// What contradicts the nets: sizes of model and paper, heights of tabs, numbers of faces. Only settings
/// without faults are looked at. O(n log n).
[[nodiscard]] std::vector<std::string> contradictions(const Case& given);

}  // namespace ridgecraft::verify
