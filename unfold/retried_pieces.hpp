// SPDX-License-Identifier: GPL-3.0-or-later
// Other nets for the faces of some pieces; all other pieces stay as they lie.
#pragma once

#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/changed_folds.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

/// Each of these pieces gets another net of its faces, found by the context's seed: the best one, or, where
/// it has that already, the best one of those in which one of its folds is a cut. Refused where no net is
/// found that keeps it in one piece and is another one. Takes the time of unfold() for each of them.
[[nodiscard]] ChangedNets retry_pieces(const mesh::Surface& surface, const prepare::Panels& panels,
                                       const IdVector<FaceId, PartId>& part, const Options& options,
                                       const Nets& nets, std::span<const PieceId> pieces,
                                       const Context& context);

}  // namespace ridgecraft::unfold
