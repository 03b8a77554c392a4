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
/// Whether a person could fold it at its size.
[[nodiscard]] bool can_be_folded(const Prepared& prepared);
/// Whether a model is as good to build as another preparation of it of the same size: it can be folded,
/// hasn't more slivers nor comes in more bodies, tabs and numbers have room, or as much as there, and
/// simplification isn't seen, or is there.
[[nodiscard]] bool is_as_good(const Prepared& prepared, const Prepared& other);

/// Scales, simplifies and remeshes flat regions: a panel has no vertices inside and none on its straight
/// sides that only two panels share, but for where a panel that fits no page in any rotation is cut: by
/// straight lines, as few as possible, into cells that fit with tabs, each a panel of its own. Simplification
/// keeps a mirror plane of the model and the equality of equal components (symmetry/). Cost O(n log n).
/// Throws no_nets where every face is narrower than 0.005 mm (below 0.05 mm they are noted as narrow_faces),
/// or where the model would be larger than 100 m or than a million faces of this paper.
/// Where the size adapts it is that of SizeOptions if the model can be folded there on few enough pages, with
/// room for tabs and numbers, and without simplification that is seen; else the next larger one at which that
/// is so, or a smaller one. Where it can't be folded, the smallest size at
/// which it can is told. Each size that is tried costs as much again.
[[nodiscard]] Prepared prepare(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                               const PanelRoom& room, const Context& context);

/// The same at the size that is asked for, and without telling which other one would do.
[[nodiscard]] Prepared prepare_as_asked(mesh::Model model, const SizeOptions& size,
                                        const SimplifyOptions& simplify, const PanelRoom& room,
                                        const Context& context);

}  // namespace ridgecraft::prepare
