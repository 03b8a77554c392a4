// SPDX-License-Identifier: GPL-3.0-or-later
// A connected set of faces in the form that the search works on: local numbers, each face flat in a frame of
// its own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_wishes.hpp"
#include "unfold/patch/triangle.hpp"

namespace ridgecraft::unfold {

/// Marks "no face", "no side".
inline constexpr std::uint32_t nothing = 0xffffffffU;

/// Patch::frozen of sides whose faces count as one flat region, of those that hold a needle to its neighbour,
/// and of those across a strip that stays one: both are a region more.
inline constexpr std::uint8_t frozen_in_panel = 1;
inline constexpr std::uint8_t frozen_at_needle = 2;
inline constexpr std::uint8_t frozen_in_band = 3;

/// Faces 0 .. size()-1; side 3 f + k of face f runs from its corner k to its corner k + 1.
struct Patch {
  std::vector<FaceId> face;  ///< of the surface, ascending
  std::vector<std::uint32_t>
      twin;  ///< per side: the side on the other face; nothing at a border of the patch
  std::vector<std::uint8_t> frozen;  ///< per side: 0, or always a fold, since both its faces lie in one
                                     ///< panel or one strip, a user wants it, or one of them is a needle
  std::vector<Triangle> shape;       ///< per face: its corners in its own frame, mm
  std::vector<Rigid>
      across;  ///< per side: the neighbour's frame seen from this face's, laid flat over the side
  std::vector<double> length;             ///< per side, mm
  std::vector<double> fold_angle;         ///< per side: as mesh::Surface::fold_angle
  std::vector<std::uint8_t> labels_meet;  ///< per side: 1 where the labels of its two faces differ, in the
                                          ///< patch or beyond it
  double extent = 0.0;  ///< largest extent of the whole surface, mm: the unit of search_tolerance

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(face.size()); }
};

/// The sides of its face that follow and precede a side, counterclockwise.
[[nodiscard]] inline std::uint32_t next_side(std::uint32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}
[[nodiscard]] inline std::uint32_t previous_side(std::uint32_t side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

/// Makes a patch of these faces (ascending). Sides between faces of the set are twins, all others border; a
/// side that is to be cut is border, too, and one that is to be kept is frozen. `wishes`: per edge, or empty;
/// `labels`: per face of the surface (Options::labels), or empty. O(n log n).
[[nodiscard]] Patch make_patch(const mesh::Surface& surface, const prepare::Panels& panels,
                               std::span<const FaceId> faces, std::span<const EdgeWish> wishes = {},
                               std::span<const std::uint32_t> labels = {});

/// The connected components (over twins) of a set of faces of the surface, each ascending, in the order of
/// their first faces; edges that are to be cut don't connect. O(n log n).
[[nodiscard]] std::vector<std::vector<FaceId>> connected(const mesh::Surface& surface,
                                                         std::span<const FaceId> faces,
                                                         std::span<const EdgeWish> wishes = {});

/// 1 where the faces on both sides of a side count as one flat region, otherwise 0.
[[nodiscard]] inline std::size_t within_panel(const Patch& patch, std::uint32_t side) {
  return patch.frozen[side] == frozen_in_panel ? 1 : 0;
}

/// Whether the model's author has set the faces on both sides of a side apart. Inside a flat region that
/// counts for nothing: it stays whole.
[[nodiscard]] inline bool is_border_of_labels(const Patch& patch, std::uint32_t side) {
  return patch.labels_meet[side] != 0 && patch.frozen[side] == 0;
}

/// One flag per side: is it a fold? Both sides of an edge have the same flag. The folds of a patch make a
/// forest.
using Folds = std::vector<std::uint8_t>;

/// Paper that these faces take, mm2.
[[nodiscard]] double area_of(const Patch& patch, std::span<const std::uint32_t> faces);

/// Paper that the whole patch takes, mm2.
[[nodiscard]] double area_of(const Patch& patch);

/// A face laid flat from the length of its sides: corner k at shape[k], counterclockwise.
[[nodiscard]] Triangle flat_shape(Vec3 a, Vec3 b, Vec3 c);

}  // namespace ridgecraft::unfold
