// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths as people type them: "150mm", "6 in", "8.5".
#pragma once

#include <optional>
#include <string_view>

namespace ridgecraft {

struct LengthText {
  double number = 0.0;                ///< as typed; finite or not, of either sign
  std::optional<double> mm_per_unit;  ///< none where no unit stands behind the number
};

/// Millimetres in one mm, cm, m, in (inch, inches, "), ft; nothing for another word.
[[nodiscard]] std::optional<double> unit_mm(std::string_view word);

/// Takes a number and the unit behind it off the front of `text`, and blanks around them. Nothing where no
/// number that a double holds stands there.
[[nodiscard]] std::optional<LengthText> take_length(std::string_view& text);

/// Without blanks and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace ridgecraft
