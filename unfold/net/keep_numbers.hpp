// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of joins that outlive a change of nets.
#pragma once

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// Gives joins the numbers that their edges had before, and chains of others those that follow the last of
/// these; then puts joins in the order of their numbers. Where a number is no longer one row of edges on the
/// outline of either piece, the part with most edges keeps it. O(n log n).
void keep_numbers(const mesh::Surface& surface, const IdVector<JoinId, Join>& before, Nets& nets);

}  // namespace ridgecraft::unfold
