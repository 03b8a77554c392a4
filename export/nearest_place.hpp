// SPDX-License-Identifier: GPL-3.0-or-later
// Room for a piece that somebody holds nearly where it has none.
#pragma once

#include <optional>

#include "base/id.hpp"
#include "export/sheet/pages.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// The place nearest to where the piece is held, in steps of about a millimetre, where it lies on the sheet
/// and keeps the paper's gap to all others, which lie as `pages` has them. It stays on its page, which may be
/// one behind the last, and turned as it is. None within `reach_mm`. What belongs on a page together isn't
/// heeded. O(n) and, for each place that is tried, the pairs of faces and tabs that may come near each other.
[[nodiscard]] std::optional<Placement> nearest_place(const unfold::Nets& nets, const Pages& pages,
                                                     PieceId piece, const Placement& held, double reach_mm);

}  // namespace ridgecraft::export_
