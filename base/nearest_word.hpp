// SPDX-License-Identifier: GPL-3.0-or-later
// "Did you mean ...?": the known word that is nearest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace ridgecraft {

/// The word of `known` with the smallest edit distance (insertions, deletions, replacements; letters compared
/// without regard to case), the first of equals; empty when even that is further off than a third of the
/// word's length, plus 1.
[[nodiscard]] std::string nearest_word(std::string_view word, std::span<const std::string> known);

}  // namespace ridgecraft
