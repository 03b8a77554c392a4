// SPDX-License-Identifier: GPL-3.0-or-later
// By how much the model is folded at an edge.
#pragma once

#include "verify/relations/relations.hpp"

namespace ridgecraft::verify {

/// The fold that the model has between two faces: negative for mountains.
struct ModelFold {
  double angle_deg = 0.0;
  double tolerance_deg = 0.0;  ///< how well the angle is known: badly between slender faces
};

/// At a side of the model that has a twin. O(1).
[[nodiscard]] ModelFold model_fold(const File& file, const Relations& relations, Index model_side);

}  // namespace ridgecraft::verify
