// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a patch as a patch of its own, and its folds there and back.
#pragma once

#include <cstdint>
#include <span>

#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// The patch of these faces (ascending): face i of it is faces[i]. Sides between two of them are twins, all
/// others border. O(size of the patch).
[[nodiscard]] Patch sub_patch(const Patch& patch, std::span<const std::uint32_t> faces);

/// The folds between these faces, by their numbers in the sub-patch.
[[nodiscard]] Folds sub_folds(const Patch& patch, const Folds& folds, std::span<const std::uint32_t> faces);

/// Replaces the folds between these faces by those of the sub-patch; folds to other faces stay.
void put_back(const Patch& patch, std::span<const std::uint32_t> faces, const Folds& sub, Folds& folds);

}  // namespace ridgecraft::unfold
