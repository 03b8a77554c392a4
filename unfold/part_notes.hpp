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

/// One sentence for each fact, in the order in which they first appear, with the pieces of the faces: "the
/// part of D: ...", "the parts of D, G and 62 more: ...". O(n log n).
[[nodiscard]] std::vector<std::string> sentences(std::span<const PartNote> notes, const Nets& nets);

}  // namespace ridgecraft::unfold
