// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces of a piece run through each other while it is folded in one way or another.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/net/nets.hpp"

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

// A folded piece is opened crease by crease: backwards, that is an order in which it can be folded.

/// How far opening came.
struct Opening {
  std::vector<std::uint32_t>
      opened;  ///< creases in the order in which they went flat; all where it succeeded
  /// Two faces that meet when one of the others is opened; nothing where there is none or the search was
  /// stopped at once.
  std::optional<FoldTrial::Pair> in_the_way = std::nullopt;
};

/// Opens the folded piece: of the creases that nothing keeps from lying flat one goes flat, and so on. Where
/// none is free before all are flat it begins again, and what was stuck comes earlier: some dozens of times,
/// within a budget of work that is about 0.2 s. What it ends with is the attempt that came farthest. Where
/// not one crease is free in the folded piece there is no order of single creases. Deterministic but for the
/// deadline.
[[nodiscard]] Opening open_piece(const FoldMotion& motion, FoldTrial& trial, const Context& context);

// Can a piece be folded up without running through itself, and in which order? Self-folding sheets can't help
// themselves with a finger, and makers like to know before they glue.

/// A way to fold, and the creases in their order (none where all are folded at a time).
struct Folding {
  FoldWay way = FoldWay::together;
  std::vector<std::uint32_t> order;
  /// Two faces that stop the search where it came farthest: there where no order was found in spite of it.
  std::optional<FoldTrial::Pair> in_the_way = std::nullopt;
};

/// The first of these ways in which no two faces of the piece meet, found by sampled motion: all creases at a
/// time, growing alike; one after the other, the outermost first; one after the other from the middle; one
/// after the other in the order that opening the folded piece backwards gives. Where each way
/// fails it is `with_care`, in the second order. Single creases are tried where their number times that of
/// the faces is no more than a million: about a thousand flat regions. Tabs are not looked at. Deterministic
/// but for the deadline.
[[nodiscard]] Folding find_folding(const FoldMotion& motion, FoldTrial& trial, const Context& context);

/// The same without the first way, which is known to fail.
[[nodiscard]] Folding find_order(const FoldMotion& motion, FoldTrial& trial, const Context& context);

/// The same for a finished piece, edge by edge.
[[nodiscard]] FoldOrder find_fold_order(const mesh::Surface& surface, const Nets& nets, PieceId piece,
                                        const Context& context);

}  // namespace ridgecraft::unfold
