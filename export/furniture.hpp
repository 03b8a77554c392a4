// SPDX-License-Identifier: GPL-3.0-or-later
// What stands at the foot of every page: the model's name, the page's number, the scale bar and the legend.
#pragma once

#include <string_view>

#include "export/drawing.hpp"
#include "export/paper.hpp"

namespace ridgecraft::paper {

/// The furniture of one page, in the band of furniture_height at the foot of the printable area. On narrow
/// paper it takes three rows instead of two, uses shorter words, and leaves out what doesn't fit; nothing
/// reaches out of the band.
[[nodiscard]] Group furniture(const Paper& paper, std::string_view title, int page, int page_count);

}  // namespace ridgecraft::paper
