// SPDX-License-Identifier: GPL-3.0-or-later
// The shapes of the stroke font: one line of pen movements for each letter.
#pragma once

#include <string_view>

namespace ridgecraft::export_ {

/// Capitals are 10 units high and begin at x = 0; the baseline is y = 0. A path is a list of
///   M x y               lift the pen and go to
///   L x y               draw a line to
///   A cx cy rx ry a b   draw along an ellipse from angle a to b (degrees, counterclockwise), first a line to
///   its
///                       start if the pen is down
/// Every stroke begins with M or, where the pen is up (at the start and after /), with A.
struct Glyph {
  char32_t code;
  std::string_view path;
};

/// The path of a character, or a null view. Composed letters are looked up by split_accent first.
[[nodiscard]] std::string_view glyph_path(char32_t code);

/// A letter with an accent as its base letter and the accent's own glyph; {code, 0} for any other character.
struct Composed {
  char32_t base;
  char32_t accent;
};
[[nodiscard]] Composed split_accent(char32_t code);

}  // namespace ridgecraft::export_
