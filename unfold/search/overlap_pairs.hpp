// SPDX-License-Identifier: GPL-3.0-or-later
// What would overlap after a swap: asked without making it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {

/// Pairs of faces.
using FacePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Answers what the half that a swap moves would run into. The net must outlive it.
class SwapOverlaps {
 public:
  /// Overlap is penetration deeper than tolerance (mm).
  SwapOverlaps(const RootedNet& net, double tolerance);

  /// How many pairs of faces would overlap across the new fold; `limit` where there are as many or more. What
  /// overlaps across the old fold now isn't taken into account.
  std::uint32_t count(std::uint32_t below, std::uint32_t side, std::uint32_t limit);
  /// Would the swap make no new overlap?
  [[nodiscard]] bool is_clean(std::uint32_t below, std::uint32_t side) { return count(below, side, 1) == 0; }
  /// The pairs that the last count came upon; may be swapped away.
  [[nodiscard]] FacePairs& found() { return found_; }

 private:
  /// Two nodes of the circle tree that come near each other when the first is carried to `centre`.
  struct Meeting {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Vec2 centre;
  };
  class Descent;

  const RootedNet& net_;
  double tolerance_;
  FacePairs found_;
  std::vector<Meeting> meetings_;        ///< space to work in
  std::vector<EdgedTriangle> moved_;     ///< per face: its corners after the swap that was asked about
  std::vector<std::uint64_t> moved_in_;  ///< question that moved_ is of
  std::uint64_t question_ = 0;
};

// The pairs of faces that overlap in a net, kept up to date while its tree changes.

/// All overlapping pairs of a net that changes by swaps of this class only, or is looked at afresh
/// (find_all). The net must outlive it.
class OverlapPairs {
 public:
  /// Overlap is penetration deeper than tolerance (mm). Knows of no pair until find_all().
  OverlapPairs(RootedNet& net, double tolerance);

  /// Forgets what it knew and finds all pairs of the net as it is. O(n log n + pairs).
  void find_all();

  [[nodiscard]] std::uint64_t total() const { return total_; }
  /// Faces that overlap any.
  [[nodiscard]] const std::vector<std::uint32_t>& bad_faces() const { return bad_; }
  /// Faces that a face overlaps.
  [[nodiscard]] const std::vector<std::uint32_t>& met_by(std::uint32_t face) const { return meets_[face]; }
  /// How many pairs have a face on either side of the fold above `below`: those that its removal may resolve.
  /// O(smaller of the half that would move and the overlapping faces, and their pairs).
  [[nodiscard]] std::uint32_t across(std::uint32_t below) const;

  /// What a swap would make overlap anew.
  [[nodiscard]] SwapOverlaps& after_swap() { return after_swap_; }
  /// How many pairs a swap adds (negative: takes away); `limit` or more where it is that many at least.
  [[nodiscard]] std::int64_t added(std::uint32_t below, std::uint32_t side, std::int64_t limit);

  /// Makes a swap of the net (RootedNet::swap).
  std::uint32_t swap(std::uint32_t below, std::uint32_t side);
  /// The same where all pairs that will overlap anew are known (SwapOverlaps::found).
  std::uint32_t swap(std::uint32_t below, std::uint32_t side, const FacePairs& made);

 private:
  template <class Use>
  void visit_across(const RootedNet::Span& moved, Use use) const;
  void add(std::uint32_t f, std::uint32_t g);
  void remove_pair_of(std::uint32_t f, std::uint32_t g);
  void mark_clean(std::uint32_t f);
  void drop_across(std::uint32_t below);

  RootedNet& net_;
  double tolerance_;
  SwapOverlaps after_swap_;
  std::vector<std::vector<std::uint32_t>> meets_;  ///< faces that each face overlaps now
  std::vector<std::uint32_t> bad_;                 ///< faces that overlap any
  std::vector<std::uint32_t> bad_at_;              ///< place of each face in bad_
  std::uint64_t total_ = 0;
  FacePairs dropped_;  ///< space to work in
};

}  // namespace ridgecraft::unfold
