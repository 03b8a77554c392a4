// SPDX-License-Identifier: GPL-3.0-or-later
// What of a piece is rolled, and the words for it.
#pragma once

#include <string>
#include <vector>

#include "base/id.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// What of a band lies on one piece without a cut across it.
struct RolledPart {
  PieceId piece;
  RollId roll;
  std::vector<EdgeId> bends;  ///< in order along the band
};

/// By piece. O(n log n).
[[nodiscard]] std::vector<RolledPart> rolled_parts(const prepare::Prepared& model, const unfold::Nets& nets);

/// How many bends nets have, where they would else be folded along drawn lines.
[[nodiscard]] std::size_t count_rolled_folds(const prepare::Prepared& model, const unfold::Nets& nets,
                                             double hidden_fold_angle);

/// "roll, radius 14 mm", "roll, radius 5 to 14 mm", "roll, print inside, ...": for sheets.
[[nodiscard]] std::string roll_words(const prepare::Prepared& model, RollId roll);
/// "a pen of 12 mm": round what, for guides. Paper springs back, so it is thinner than the band.
[[nodiscard]] std::string round_words(const prepare::Roll& roll);

}  // namespace ridgecraft::export_
