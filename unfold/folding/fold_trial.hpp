// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces of a piece run through each other while it is folded in one way or another.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "unfold/folding/face_meeting.hpp"
#include "unfold/folding/fold_motion.hpp"

namespace ridgecraft::unfold {

/// Looks at a motion, at equal distances from its beginning: all creases at a time, or one of them. A face as
/// wide as the seam (fold_give_mm) can't slip through unseen where it moves by less between two looks: those
/// that lie within 40 mm of a crease that is folded by 20 degrees.
inline constexpr int samples_of_motion = 50;

/// Two faces meet where they are in each other deeper than fold_give_mm. Faces that meet in the folded piece,
/// too, belong to a model that runs through itself, and don't count, nor do those that a crease joins.
///
/// A trial stands in one pose, the flat one at first; creases are moved from there. The motion and the
/// context must outlive it.
class FoldTrial {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< of faces, the smaller number first

  FoldTrial(const FoldMotion& motion, const Context& context);

  /// Whether nothing meets while all creases are folded at a time, growing alike: samples_of_motion, O(n log
  /// n) each.
  [[nodiscard]] bool together_works();
  /// Whether nothing meets while one crease is folded after the other. False, too, at the deadline.
  [[nodiscard]] bool order_works(std::span<const std::uint32_t> order);

  /// Pairs that meet in the folded piece, ascending.
  [[nodiscard]] const std::vector<Pair>& always() const { return always_; }

  /// Flat (0) or as in the model (1): all creases. O(n).
  void set_all(double share);
  /// Moves a crease there. O(the faces that it moves).
  void fold(std::uint32_t crease, double share);
  /// Two faces that meet while the crease is moved to this share; nothing where none do: samples_of_motion.
  /// The pose stays as it is. `suspects`, if given, are tried first. Pairs whose distances from the crease's
  /// line or places along it differ can't meet, so hardly any of O(faces moved · the rest) is looked at
  /// closely.
  [[nodiscard]] std::optional<Pair> obstacle(std::uint32_t crease, double share,
                                             std::optional<Pair> suspects = std::nullopt);

  /// What has been looked at so far, in steps of about ten nanoseconds: for a limit that isn't time.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  /// A face less the seam in which it gives way, and a ball around it.
  struct Solid {
    Corners corners;
    Vec3 centre;
    double radius = 0.0;
    bool empty = true;
  };
  /// What stays as it is for a face that turns about a line: its stretch along it, and its distances from it.
  struct Ring {
    std::uint32_t face = 0;
    double low = 0.0, high = 0.0;
    double inner = 0.0, outer = 0.0;
  };

  [[nodiscard]] Solid solid(std::uint32_t face) const;
  [[nodiscard]] Ring ring(std::uint32_t face, Vec3 on_line, Vec3 along) const;
  [[nodiscard]] bool counts(std::uint32_t f, std::uint32_t g) const;
  [[nodiscard]] std::vector<Pair> meetings(bool any_will_do);
  void find_candidates(std::uint32_t crease);
  [[nodiscard]] std::optional<Pair> first_meeting(std::uint32_t crease, double share);

  const FoldMotion& motion_;
  const Context& context_;
  FoldMotion::Pose pose_;
  std::vector<Solid> solids_;  ///< of each face in this pose
  std::vector<Pair> always_;
  std::uint64_t work_ = 0;
  // Space to work in: pairs that may meet, a face that moves and one that doesn't, ascending.
  std::vector<Pair> candidates_;
  std::vector<Ring> moving_, resting_;
};

}  // namespace ridgecraft::unfold
