// SPDX-License-Identifier: GPL-3.0-or-later
// In which order a page is painted.
#pragma once

#include <array>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::paper {

/// Bottom to top: colours lie lowest, then fills, folds under cuts (machines work in this order: scores
/// first, outlines last), texts on top.
inline constexpr std::array<Layer, layer_count> layer_order{Layer::paint,  Layer::tab_fill,   Layer::mountain,
                                                            Layer::valley, Layer::tab_fold,   Layer::cut,
                                                            Layer::label,  Layer::piece_name, Layer::mark};

}  // namespace ridgecraft::paper
