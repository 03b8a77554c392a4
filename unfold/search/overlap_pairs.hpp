// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of faces that overlap in a net, kept up to date while its tree changes.
#pragma once

#include <cstdint>
#include <vector>

#include "unfold/search/face_pairs.hpp"
#include "unfold/search/rooted_net.hpp"

namespace ridgecraft::unfold {

/// Answers what the half that a swap moves would run into, without making it. The net must outlive it.
class SwapOverlaps {
 public:
  /// Overlap is penetration deeper than tolerance (mm).
  SwapOverlaps(const RootedNet& net, double tolerance) : net_(net), carried_(net.edged_flats(), tolerance) {}

  /// How many pairs of faces would overlap across the new fold; `limit` where there are as many or more. What
  /// overlaps across the old fold now isn't taken into account.
  std::uint32_t count(std::uint32_t below, std::uint32_t side, std::uint32_t limit);
  /// Would the swap make no new overlap?
  [[nodiscard]] bool is_clean(std::uint32_t below, std::uint32_t side) { return count(below, side, 1) == 0; }
  /// The pairs that the last count came upon; may be swapped away.
  [[nodiscard]] FacePairs& found() { return carried_.found(); }

 private:
  const RootedNet& net_;
  CarriedOverlaps carried_;
};

/// All overlapping pairs of a net that changes by swaps of this class only, or is looked at again (find_all).
/// The net must outlive it.
class OverlapPairs {
 public:
  /// Overlap is penetration deeper than tolerance (mm). Knows of no pair until find_all().
  OverlapPairs(RootedNet& net, double tolerance);

  /// Forgets what it knew and finds all pairs of the net as it is. O(n log n + pairs).
  void find_all();

  [[nodiscard]] std::uint64_t total() const { return pairs_.total(); }
  /// Faces that overlap any.
  [[nodiscard]] const std::vector<std::uint32_t>& bad_faces() const { return pairs_.bad_faces(); }
  /// Faces that a face overlaps.
  [[nodiscard]] const std::vector<std::uint32_t>& met_by(std::uint32_t face) const {
    return pairs_.met_by(face);
  }
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
  RootedNet& net_;
  double tolerance_;
  SwapOverlaps after_swap_;
  FacePairSet pairs_;
};

}  // namespace ridgecraft::unfold
