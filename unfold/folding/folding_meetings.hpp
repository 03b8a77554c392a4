// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of faces that meet while nets are folded with all creases together, kept up to date while their
// trees change: what overlap is for nets that lie flat (search/forest_overlaps.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/geometry.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// For any search among the forests of one patch, which must outlive it: `count` once, `after` for each move
/// that is thought of and not yet made, `keep` for each that stays. Faces meet as FoldTrial has it
/// (fold_order.hpp), at the same samples. What lies on one side of a fold that leaves a tree moves as it did
/// before, so a move is described by the pairs across it alone.
class FoldingMeetings {
 public:
  explicit FoldingMeetings(const Patch& patch);

  /// Looks at this forest afresh, the first time at a spanning tree, which tells what meets in the folded
  /// model. O(n^2) balls of faces, and what comes near each other.
  void count(const Folds& folds);
  /// Pairs of the nets as they are.
  [[nodiscard]] std::size_t total() const { return pairs_.size(); }
  [[nodiscard]] const FacePairs& pairs() const { return pairs_; }

  /// What a move does: carries `moved` faces over the new fold `side` to a tree of these faces, maybe their
  /// own; without a side to a tree of their own.
  struct Carry {
    std::span<const std::uint32_t> moved;
    std::span<const std::uint32_t> to;
    std::uint32_t side = no_index;
  };
  /// How many pairs there would be after it; `limit` where it were that many or more. O(faces moved * faces
  /// there): about 0.02 ms for a piece of 50 faces.
  [[nodiscard]] std::size_t after(const Carry& carry, std::size_t limit);
  /// Takes the move that was asked about last for made; its answer must have been below its limit. `folds`
  /// may be those before it or after it. O(faces moved + pairs).
  void keep(const Folds& folds);

 private:
  /// All of a trial's but the folded piece itself.
  static constexpr std::size_t samples = samples_of_motion - 1;
  template <class T>
  using Samples = std::array<T, samples>;
  /// Of a face's ball, in every sample.
  struct Centres {
    Samples<float> x, y, z;
  };

  void find_plates();
  void find_always(const Folds& tree);
  void place_all(const Folds& folds);
  void place_tree(const Folds& folds, std::vector<std::uint32_t>& open);
  void settle(std::uint32_t face);
  [[nodiscard]] Samples<Motion> motions(std::uint32_t side);
  [[nodiscard]] bool always(std::uint32_t f, std::uint32_t g) const;
  [[nodiscard]] std::uint64_t near(std::uint32_t f, const Centres& centres_of_f, std::uint32_t g) const;
  [[nodiscard]] bool is_across(const std::pair<std::uint32_t, std::uint32_t>& pair) const {
    return moves_[pair.first] != moves_[pair.second];
  }
  [[nodiscard]] bool meets(std::uint32_t f, const Samples<Motion>* motion, std::uint32_t g,
                           std::uint64_t near) const;
  void place_beyond(std::uint32_t fold);
  void find_made(const Carry& carry, std::size_t limit);

  const Patch& patch_;
  std::vector<Samples<Motion>> hinge_;  ///< per side: the frame of the face beyond it, seen from this face's
  std::vector<std::uint32_t> plate_;    ///< per face: frozen flat folds join them
  std::vector<Corners> rest_;           ///< per face: without its seam, in its own frame
  std::vector<float> radius_;           ///< of the ball around that; negative where nothing is left
  FacePairs always_;                    ///< faces that meet in the folded piece, ascending
  bool knows_always_ = false;
  // Of the nets.
  std::vector<std::uint32_t> root_;      ///< of each face's tree, as it was when all were counted
  std::vector<Samples<Motion>> frame_;   ///< of each face
  std::vector<Samples<Corners>> solid_;  ///< of each face
  std::vector<Centres> centres_;         ///< of each face
  FacePairs pairs_;                      ///< that meet, in no order
  // The last move that was asked about.
  std::vector<std::uint32_t> moved_;   ///< faces
  std::vector<std::uint8_t> moves_;    ///< per face: is it one of these?
  FacePairs made_;                     ///< pairs that it makes meet
  Samples<Motion> motion_;             ///< of what it moves
  std::uint32_t new_fold_ = no_index;  ///< the side, in what stays, of the fold that it makes, if any
  std::vector<std::uint32_t> open_;    ///< space to work in
};

}  // namespace ridgecraft::unfold
