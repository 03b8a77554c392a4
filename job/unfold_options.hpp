// SPDX-License-Identifier: GPL-3.0-or-later
// What a job asks of unfold/.
#pragma once

#include "base/vector.hpp"
#include "job/options.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::job {

/// What pieces must fit, mm: next to anything, where there is no paper.
[[nodiscard]] Vec2 room_for_pieces(const Options& options);

/// `constraints`: of each edge of the prepared surface, or none.
[[nodiscard]] unfold::Options unfold_options(const Options& options, const prepare::Prepared& prepared,
                                             unfold::EdgeConstraints constraints);

}  // namespace ridgecraft::job
