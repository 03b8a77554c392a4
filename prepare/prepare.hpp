// SPDX-License-Identifier: GPL-3.0-or-later
// What a model of paper is: size, simplification, flat regions, cuts where no sheet holds one. Read this
// header first.
//
//   mesh::Model (in the file's unit) --prepare--> Prepared (in mm, foldable, with its panels)
//
// Errors are ridgecraft::Error of kinds no_nets, interrupted.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// With a larger share of slivers nobody builds a model; ...
inline constexpr double most_slivers = 0.05;
/// ... where all its faces are as its maker made them, they may be meant.
inline constexpr double most_own_slivers = 0.15;
[[nodiscard]] bool has_many_slivers(const Prepared& prepared);
/// Whether more of its folds are short than a person takes on.
[[nodiscard]] bool is_too_fine(const Prepared& prepared);
/// Whether a person could fold it at its size.
[[nodiscard]] bool can_be_folded(const Prepared& prepared);
/// By what share it is more than it should be, in the sum of all that counts: work, short folds, narrow
/// faces, and how far simplification moved its surface if that is seen. 0 where nothing is.
[[nodiscard]] double excess(const Prepared& prepared, const SimplifyOptions& simplify);

/// Scales, simplifies and remeshes flat regions: a panel has no vertices inside and none on its straight
/// sides that only two panels share, but for where a panel that fits no page in any rotation is cut: by
/// straight lines, as few as possible, into cells that fit with tabs, each a panel of its own. Simplification
/// keeps a mirror plane of the model and the equality of equal components (symmetry/). Cost O(n log n).
/// Throws no_nets where every face is narrower than 0.005 mm (below 0.05 mm they are noted as narrow_faces),
/// or where the model would be larger than 100 m or than a million faces of this paper.
/// Where the size adapts it is that of SizeOptions, or the larger one on few enough pages at which it exceeds
/// least what it should be; or a smaller one where it takes too many pages. Where it can't be folded, the
/// smallest size at which it can is told. Each size that is tried costs as much again.
[[nodiscard]] Prepared prepare(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                               const PanelRoom& room, const Context& context);

/// The same at the size that is asked for, and without telling which other one would do.
[[nodiscard]] Prepared prepare_as_asked(mesh::Model model, const SizeOptions& size,
                                        const SimplifyOptions& simplify, const PanelRoom& room,
                                        const Context& context);

}  // namespace ridgecraft::prepare
