// SPDX-License-Identifier: GPL-3.0-or-later
// What a division of a surface becomes when one side of a mirror plane is carried over to the other.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/mirror_images.hpp"

namespace ridgecraft::unfold {

/// A set of a division that was carried over: one that was there before, or its mirror image.
struct MirrorLabel {
  std::uint32_t of = 0;
  bool is_image = false;

  friend auto operator<=>(const MirrorLabel&, const MirrorLabel&) = default;
};

/// The units of a patch (unit_images.hpp), each with the one that is its mirror image.
class MirrorUnits {
 public:
  /// O(n log n).
  MirrorUnits(const mesh::Surface& surface, const Patch& patch, const MirrorImages& images);

  /// Of each set of a division: does it lie on both sides of the plane, joined across it by edges that
  /// `joined` has a flag for (per side)?
  [[nodiscard]] std::vector<std::uint8_t> crossing(const Patch& patch, std::span<const std::uint8_t> joined,
                                                   std::span<const std::uint32_t> set_of_face) const;

  /// The division (per face) with that of one side of the plane carried over to the other. Sets that cross
  /// the plane become their own mirror images; faces without an image stay in their set.
  [[nodiscard]] std::vector<MirrorLabel> carried_over(std::span<const std::uint32_t> set_of_face,
                                                      std::span<const std::uint8_t> crosses,
                                                      bool above) const;

 private:
  [[nodiscard]] bool is_above(std::uint32_t unit) const { return height_[unit] > 0.0; }
  void find_heights(const mesh::Surface& surface, const Patch& patch, const prepare::MirrorPlane& plane);
  void find_images(const mesh::Surface& surface, const Patch& patch, const MirrorImages& images);

  std::vector<std::uint32_t> unit_;   ///< per face: its number, that of one of its faces
  std::vector<std::uint32_t> image_;  ///< per unit: nothing where there is none, itself across the plane
  std::vector<double> height_;        ///< per unit: above the plane, by area
};

/// The connected sets of faces with one label, ascending, in the order of their first faces.
[[nodiscard]] std::vector<std::pair<MirrorLabel, std::vector<std::uint32_t>>> connected_labels(
    const Patch& patch, std::span<const MirrorLabel> labels);

}  // namespace ridgecraft::unfold
