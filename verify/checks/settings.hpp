// SPDX-License-Identifier: GPL-3.0-or-later
// The settings under "ridgecraft:settings": which there are, what their values have to be, and what the nets
// say against them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "verify/file/file.hpp"
#include "verify/file/relations.hpp"

namespace ridgecraft::verify {

/// A hash of bytes as hexadecimal digits.
[[nodiscard]] bool is_hash(std::string_view text);

/// Whether there is such a setting, and it says yes.
[[nodiscard]] bool is_true(const Settings& settings, std::string_view name);

/// What the nets were searched with where the settings have another value now; null where they haven't.
[[nodiscard]] const Setting* searched_with(const Settings& settings, std::string_view name);

/// What is wrong with them, a sentence each: unknown or missing ones, values that no option takes, values
/// that contradict each other.
[[nodiscard]] std::vector<std::string> faults_of_settings(const Settings& settings);

/// What contradicts the nets: sizes of model and paper, heights of tabs, numbers of faces. Only settings
/// without faults are looked at. O(n log n).
[[nodiscard]] std::vector<std::string> contradictions(const Case& given);

}  // namespace ridgecraft::verify
