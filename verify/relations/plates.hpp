// SPDX-License-Identifier: GPL-3.0-or-later
// The stiff plates of a piece and the creases between them: what moves when it is folded.
#pragma once

#include <span>
#include <vector>

#include "verify/file/file.hpp"
#include "verify/relations/relations.hpp"

namespace ridgecraft::verify {

/// Faces of the nets that folds flatter than an angle join.
struct Plates {
  std::vector<Index> plate;  ///< per net face, numbered by their first faces
  Index count = 0;
};

/// Sound folds below `flat_deg` join faces. O(n α(n)).
[[nodiscard]] Plates find_plates(const File& file, const Relations& relations, double flat_deg);

/// All folds between two plates: they lie on one line, or the plates couldn't move.
struct Crease {
  Index first = 0, second = 0;  ///< plates, the smaller number first
  std::vector<Index> edges;
};

/// The creases of each piece. O(n log n).
[[nodiscard]] std::vector<std::vector<Crease>> find_creases(const File& file, const Relations& relations,
                                                            const Plates& plates);

/// Whether creases, in the order in which they are folded one at a time, come by their distance from some
/// plate, the farthest first. At least one crease; distances are counted in creases. O(n log n).
[[nodiscard]] bool goes_inwards(std::span<const Crease* const> order);

}  // namespace ridgecraft::verify
