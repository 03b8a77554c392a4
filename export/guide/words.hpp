// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of the guide at their places.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::paper {

enum class Weight { plain, bold };

/// A text whose baseline begins at `at`.
[[nodiscard]] Text words_from(std::string_view words, Vec2 at, double height, Weight weight = Weight::plain);
/// A text whose baseline ends at `at`.
[[nodiscard]] Text words_to(std::string_view words, Vec2 at, double height, Weight weight = Weight::plain);

/// Rows no wider than `width`, mm; a word that is wider by itself has a row of its own.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view words, double width, double height);

/// As many of the letters as have room, with "…" at the end where some haven't.
[[nodiscard]] std::string shortened(std::string_view words, double width, double height);

}  // namespace ridgecraft::paper
