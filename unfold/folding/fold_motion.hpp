// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two faces of a piece that is being folded are in each other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// Of a triangle in space, mm.
using Corners = std::array<Vec3, 3>;

/// The triangle less a seam of fold_give_mm (net/tolerance.hpp) along its sides, in which it gives way; false
/// where nothing is left. `rest` may be `t`.
[[nodiscard]] bool without_seam(const Corners& t, Corners& rest);

/// Whether two triangles have a point in common. Floating point decides: for triangles without their seams,
/// which are a million times wider than its errors, it can't be wrong about faces that share a side.
[[nodiscard]] bool meet(const Corners& f, const Corners& g);

// A piece of paper that is being folded: where its faces are in space when some creases are folded by some
// share.

/// Folds of less don't move anything that one could see, radians.
inline constexpr double flat_fold = 2e-6;

/// A piece laid flat, and by how much each of its folds is folded in the model. Its faces have local numbers;
/// side 3 f + k of face f runs from its corner k to its corner k + 1.
struct FlatPiece {
  std::vector<Triangle> flat;  ///< per face, mm
  std::vector<std::uint32_t>
      across;                 ///< per side: the face beyond the fold there; nothing where there is none
  std::vector<double> angle;  ///< per side: as mesh::Surface::fold_angle
};
/// Face i is the piece's i-th.
[[nodiscard]] FlatPiece flat_piece(const mesh::Surface& surface, const Nets& nets, PieceId piece);
/// Of a connected patch and a tree that spans it.
[[nodiscard]] FlatPiece flat_piece(const Patch& patch, const Folds& tree);

/// Faces that folds without an angle join are one plate; folded edges between two plates are one crease. The
/// creases of a spanning tree from the plate in the middle move everything beyond them, each about its own
/// line; others close circles of plates, and those may gape until all is folded.
class FoldMotion {
 public:
  /// O(n log n) for a piece of n faces.
  explicit FoldMotion(const FlatPiece& piece);

  struct Crease {
    std::uint32_t inner;               ///< plate nearer to the middle
    std::uint32_t outer;               ///< the plate that it moves, with all beyond it
    std::uint32_t depth = 0;           ///< creases from the middle plate to `outer`
    std::vector<std::uint32_t> sides;  ///< its edges, one side of each, and those of circles that it closes
  };
  /// In the order of the tree: inner ones before those beyond them.
  [[nodiscard]] const std::vector<Crease>& creases() const { return creases_; }

  [[nodiscard]] std::size_t face_count() const { return plate_.size(); }
  [[nodiscard]] std::uint32_t plate(std::uint32_t face) const { return plate_[face]; }
  /// Whether one crease joins the plates: then they can't run through each other.
  [[nodiscard]] bool hinged(std::uint32_t plate, std::uint32_t other) const {
    return inner_of_[plate] == other || inner_of_[other] == plate;
  }

  /// Where everything is. The middle plate stays in the plane z = 0, its printed side up.
  struct Pose {
    std::vector<double> share;                 ///< per crease: 0 flat, 1 as in the model
    std::vector<std::array<Vec3, 3>> corners;  ///< of each face, mm
    std::vector<Motion> motion;                ///< of each plate
  };
  /// The pose with these shares. O(n).
  void pose(std::vector<double> share, Pose& pose) const;

  /// The faces that a crease moves. O(their number).
  [[nodiscard]] std::vector<std::uint32_t> faces_beyond(std::uint32_t crease) const;
  /// Whether a face is one of these. O(1).
  [[nodiscard]] bool moves(std::uint32_t crease, std::uint32_t face) const {
    const std::uint32_t first = place_[creases_[crease].outer];
    const std::uint32_t at = place_[plate_[face]];
    return at >= first && at < first + below_[creases_[crease].outer];
  }
  /// A point on the crease's line and the line's direction, of length 1.
  [[nodiscard]] std::pair<Vec3, Vec3> line_of(std::uint32_t crease, const Pose& pose) const;
  /// How what lies beyond the crease would move from where it is to where it were with this share.
  [[nodiscard]] Motion beyond(std::uint32_t crease, double share, const Pose& pose) const;
  /// Changes the share of one crease. O(the faces that it moves).
  void fold(std::uint32_t crease, double share, Pose& pose) const;

 private:
  struct Hinge {
    Vec2 start;
    Vec2 direction;
    double angle = 0.0;  ///< about the direction, radians, when folded
  };
  /// Moves the crease's outer plate to where its inner one and its share put it.
  void place(std::uint32_t crease, Pose& pose) const;
  [[nodiscard]] std::vector<std::uint32_t> creases_from(std::uint32_t crease) const;
  void number_plates();

  std::vector<Triangle> flat_;
  std::vector<std::uint32_t> plate_;
  std::vector<std::vector<std::uint32_t>> faces_;  ///< of each plate
  std::vector<std::uint32_t>
      inner_of_;  ///< per plate: the one that its crease hangs it on; itself in the middle
  std::vector<std::vector<std::uint32_t>> hung_;  ///< per plate: creases that hang on it
  std::vector<Crease> creases_;
  std::vector<Hinge> hinges_;         ///< of each crease
  std::vector<std::uint32_t> place_;  ///< of each plate: what hangs on it has the places after its own
  std::vector<std::uint32_t> below_;  ///< per plate: plates that hang on it, and itself
};

}  // namespace ridgecraft::unfold
