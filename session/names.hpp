// SPDX-License-Identifier: GPL-3.0-or-later
// Names of pieces and numbers of joins that outlive edits.
#pragma once

#include "unfold/net/nets.hpp"

namespace ridgecraft::session {

/// Gives pieces with the faces of one before its name, and edges that were cut before their numbers. Other
/// pieces are named as in the first nets, where they have such a piece, or after the piece before that most
/// of their area comes from (C.1, C.2); other edges get numbers behind all others. Neither is one that was in
/// use before. All nets are of this surface. O(n log n).
void keep_names(const mesh::Surface& surface, const unfold::Nets& first, const unfold::Nets& before,
                unfold::Nets& after);

}  // namespace ridgecraft::session
