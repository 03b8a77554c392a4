// SPDX-License-Identifier: GPL-3.0-or-later
// What a reading of the paper means for each stage.
#pragma once

#include "segment/parts/options.hpp"

namespace ridgecraft::segment {

/// The rules that readings differ in (docs/design/segmentation.md, "Where this differs from the paper, and
/// from its plainest reading"); all of them hold for Reading::b.
struct Rules {
  bool jumps = true;            ///< a valley may run straight across the opening that a cut left
  bool cap = true;              ///< a vertex is no deeper than the hull is far along its normal
  bool derivation = true;       ///< what one bridge measured serves those beside it
  bool folds_by_length = true;  ///< the price of a fold grows with its length; nearly flat ones are none
  bool merging = true;          ///< neighbours whose union is within the tolerance are joined
};

[[nodiscard]] constexpr Rules rules_of(Reading reading) {
  if (reading == Reading::b) {
    return {};
  }
  return {.jumps = reading == Reading::a,
          .cap = false,
          .derivation = false,
          .folds_by_length = false,
          .merging = false};
}

}  // namespace ridgecraft::segment
