// SPDX-License-Identifier: GPL-3.0-or-later
// A piece of paper that is being folded: where its faces are in space when some creases are folded by some
// share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface.hpp"
#include "unfold/nets.hpp"

namespace ridgecraft::unfold {

/// Faces that folds without an angle join are one plate; folded edges between two plates are one crease. The
/// creases of a spanning tree from the plate in the middle move everything beyond them, each about its own
/// line; others close circles of plates, and those may gape until all is folded.
class FoldMotion {
 public:
  /// O(n log n) for a piece of n faces.
  FoldMotion(const mesh::Surface& surface, const Nets& nets, PieceId piece);

  struct Crease {
    std::uint32_t inner;          ///< plate nearer to the middle
    std::uint32_t outer;          ///< the plate that it moves, with all beyond it
    std::uint32_t depth = 0;      ///< creases from the middle plate to `outer`
    std::vector<CornerId> sides;  ///< its edges, one side of each, and those of circles that it closes
  };
  /// In the order of the tree: inner ones before those beyond them.
  [[nodiscard]] const std::vector<Crease>& creases() const { return creases_; }

  [[nodiscard]] std::size_t face_count() const { return plate_.size(); }
  /// Of the piece's i-th face.
  [[nodiscard]] std::uint32_t plate(std::uint32_t face) const { return plate_[face]; }
  /// Whether one crease joins the plates: then they can't run through each other.
  [[nodiscard]] bool hinged(std::uint32_t plate, std::uint32_t other) const {
    return inner_of_[plate] == other || inner_of_[other] == plate;
  }

  /// Corners of each face, mm, with crease i folded by share[i] (0 flat, 1 as in the model). The middle plate
  /// stays in the plane z = 0, its printed side up.
  void pose(std::span<const double> share, std::vector<std::array<Vec3, 3>>& corners) const;

 private:
  struct Hinge {
    Vec2 start;
    Vec2 direction;
    double angle = 0.0;  ///< about the direction, radians, when folded
  };
  std::vector<std::array<Vec2, 3>> flat_;
  std::vector<std::uint32_t> plate_;
  std::vector<std::uint32_t>
      inner_of_;  ///< per plate: the one that its crease hangs it on; itself in the middle
  std::vector<Crease> creases_;
  std::vector<Hinge> hinges_;  ///< of each crease
};

}  // namespace ridgecraft::unfold
