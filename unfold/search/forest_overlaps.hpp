// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of faces that overlap within the trees of a forest, and what a move would change in them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "unfold/search/forest.hpp"

namespace ridgecraft::unfold {

/// All overlapping pairs of a forest. Whoever moves the forest says so (make), or has it looked at again
/// (find_all). The forest must outlive it.
class Overlaps {
 public:
  /// Overlap is penetration deeper than `tolerance`, mm. Knows of no pair until find_all().
  Overlaps(const Forest& forest, double tolerance);

  /// Finds all pairs of the forest as it is. O(n log n + pairs).
  void find_all();
  [[nodiscard]] std::uint64_t total() const { return total_; }
  /// Faces that overlap any.
  [[nodiscard]] const std::vector<std::uint32_t>& bad_faces() const { return bad_; }
  [[nodiscard]] const std::vector<std::uint32_t>& met_by(std::uint32_t face) const { return meets_[face]; }

  /// How many pairs a legal move adds (negative: takes away); `limit` or more where it is that many at least.
  [[nodiscard]] std::int64_t added(const Move& move, std::int64_t limit);
  /// Whether it adds none, whatever it takes away.
  [[nodiscard]] bool is_clean(const Move& move) { return count_new(move, 1) == 0; }
  /// To be called before the forest makes the move.
  void make(const Move& move);

 private:
  /// Two nodes of circle trees that come near each other when the first is carried to `centre`.
  struct Meeting {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Vec2 centre;
  };
  class Descent;

  std::uint32_t count_new(const Move& move, std::uint32_t limit);
  template <class Use>
  void visit_across(const Forest::Span& moved, Use use) const;
  void add(std::uint32_t f, std::uint32_t g);
  void remove_pair_of(std::uint32_t f, std::uint32_t g);
  void mark_clean(std::uint32_t f);

  const Forest& forest_;
  double tolerance_;
  std::vector<std::vector<std::uint32_t>> meets_;  ///< faces that each face overlaps now
  std::vector<std::uint32_t> bad_;                 ///< faces that overlap any
  std::vector<std::uint32_t> bad_at_;              ///< place of each face in bad_
  std::uint64_t total_ = 0;

  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      found_;  ///< pairs of the move that was asked about last
  std::vector<std::pair<std::uint32_t, std::uint32_t>> dropped_;
  std::vector<Meeting> meetings_;
  std::vector<EdgedTriangle> moved_;     ///< per face: its corners after that move
  std::vector<std::uint64_t> moved_in_;  ///< question that moved_ is of
  std::uint64_t question_ = 0;
};

}  // namespace ridgecraft::unfold
