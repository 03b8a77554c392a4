// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of sentences.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ridgecraft {

/// "1 part", "3 parts"
[[nodiscard]] std::string counted(std::size_t count, const std::string& word);

/// "a", "a and b", "a, b and c"; `conjunction` is "and" or "or".
[[nodiscard]] std::string listed(const std::vector<std::string>& words, const std::string& conjunction);

}  // namespace ridgecraft
