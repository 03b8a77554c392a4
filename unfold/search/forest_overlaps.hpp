// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of faces that overlap within the trees of a forest, and what a move would change in them.
#pragma once

#include <cstdint>
#include <vector>

#include "unfold/search/face_pairs.hpp"
#include "unfold/search/forest.hpp"

namespace ridgecraft::unfold {

/// All overlapping pairs of a forest. Whoever moves the forest says so (make), or has it looked at again
/// (find_all). The forest must outlive it.
class ForestOverlaps {
 public:
  /// Overlap is penetration deeper than `tolerance`, mm. Knows of no pair until find_all().
  ForestOverlaps(const Forest& forest, double tolerance);

  /// Finds all pairs of the forest as it is. O(n log n + pairs).
  void find_all();
  [[nodiscard]] std::uint64_t total() const { return pairs_.total(); }
  /// Faces that overlap any.
  [[nodiscard]] const std::vector<std::uint32_t>& bad_faces() const { return pairs_.bad_faces(); }
  [[nodiscard]] const std::vector<std::uint32_t>& met_by(std::uint32_t face) const {
    return pairs_.met_by(face);
  }

  /// How many pairs a legal move adds (negative: takes away); `limit` or more where it is that many at least.
  [[nodiscard]] std::int64_t added(const Move& move, std::int64_t limit);
  /// Whether it adds none, whatever it takes away.
  [[nodiscard]] bool is_clean(const Move& move) { return count_new(move, 1) == 0; }
  /// To be called before the forest makes the move.
  void make(const Move& move);

 private:
  std::uint32_t count_new(const Move& move, std::uint32_t limit);

  const Forest& forest_;
  double tolerance_;
  FacePairSet pairs_;
  CarriedOverlaps carried_;
  Move counted_;  ///< the last move all of whose new pairs were found, in the forest as it is
};

}  // namespace ridgecraft::unfold
