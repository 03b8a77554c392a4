// SPDX-License-Identifier: GPL-3.0-or-later
// How much paper a tab hangs on.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// Paper that a tab hangs on must reach so far behind its base, mm, along half of it: less tears off, and is
/// nothing to press on.
inline constexpr double least_paper_mm = 2.0;

/// Does enough paper lie behind a cut for a tab to hang on it? Looks from nine places on the edge straight
/// into the piece, over folds, until a cut. O(faces within least_paper_mm).
[[nodiscard]] bool enough_paper_behind(const mesh::Surface& surface, const Nets& nets, CornerId side);

}  // namespace ridgecraft::unfold
