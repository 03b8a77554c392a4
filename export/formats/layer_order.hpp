// SPDX-License-Identifier: GPL-3.0-or-later
// In which order a page is painted.
#pragma once

#include <array>

#include "export/sheet/drawing.hpp"

namespace ridgecraft::export_ {

/// Bottom to top, which is the order of work, too, as some machines follow the file: what is printed, what is
/// written, what is folded, what is cut.
inline constexpr std::array<Layer, layer_count> layer_order{
    Layer::paint,      Layer::tab_fill, Layer::shadow, Layer::glue,     Layer::mark, Layer::label,
    Layer::piece_name, Layer::mountain, Layer::valley, Layer::tab_fold, Layer::cut};

}  // namespace ridgecraft::export_
