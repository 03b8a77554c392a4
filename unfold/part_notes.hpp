// SPDX-License-Identifier: GPL-3.0-or-later
// What the searches tell of single parts, as sentences about the pieces that the user sees.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "unfold/net/nets.hpp"

namespace ridgecraft::unfold {

/// A fact about a part while its pieces have no names yet.
struct PartNote {
  std::string what;  ///< a sentence's rest after "the part of A: "
  FaceId face;       ///< one of the part's
};

/// One sentence for each fact, in the order in which they first appear, each part told by all of its pieces:
/// "the part of D and E: ...", "the parts of D and E; G; and 62 more: ...". O(facts x pieces).
[[nodiscard]] std::vector<std::string> sentences(std::span<const PartNote> notes, const Nets& nets);

}  // namespace ridgecraft::unfold
