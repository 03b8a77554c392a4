// SPDX-License-Identifier: GPL-3.0-or-later
// A surface in parts becomes pieces of paper: nets without overlap, with glue tabs. Read this header first;
// docs/design/unfolding.md has the method.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

/// Unfolds each part into one net where one exists, splits those that don't fit the sheet in as few pieces as
/// possible, and gives every cut edge that has room a tab; where tabs.split_pieces asks for it, splits them
/// further until every edge that is wide enough has a usable one. `part` gives each face its part (parts are
/// connected over edges or are treated as several); neighbouring pieces are merged as `pieces` says; panels
/// larger than the sheet are cut, others as `panel_cuts` says. The result has no overlap deeper than
/// overlap_tolerance_mm (unfold/net/options.hpp): an all-pairs check of its own confirms it before it is
/// returned. Deterministic for one seed as long as the deadline isn't reached. Throws Error(no_nets),
/// Error(interrupted).
[[nodiscard]] Nets unfold(const mesh::Surface& surface, const prepare::Panels& panels,
                          const IdVector<FaceId, PartId>& part, const Options& options,
                          const Context& context);

}  // namespace ridgecraft::unfold
