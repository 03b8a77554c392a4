// SPDX-License-Identifier: GPL-3.0-or-later
// Thin lines that give way to texts.
#pragma once

#include <vector>

#include "export/page/segment2.hpp"
#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// The stretches of a line that keep away from all texts, those too short to be seen left out. O(texts).
[[nodiscard]] std::vector<Segment2> beside_texts(const Segment2& line, const std::vector<Text>& texts);

}  // namespace ridgecraft::export_
