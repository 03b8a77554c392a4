// SPDX-License-Identifier: GPL-3.0-or-later
// Whether somebody sees that a model was simplified.
#pragma once

#include "base/vector.hpp"

namespace ridgecraft::prepare {

enum class SeenMove {
  none,
  of_size,       ///< it moved by 3 % of its largest extent or more
  of_thickness,  ///< it moved by a tenth of its smallest extent or more, which a thin model looks otherwise
                 ///< by
};

/// `moved_mm`: how far a surface with these bounds (mm) moved at most. Of what is flat, only outlines have
/// moved: it has no thickness.
[[nodiscard]] SeenMove seen_move(double moved_mm, const Box3& bounds);

}  // namespace ridgecraft::prepare
