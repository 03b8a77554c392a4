// SPDX-License-Identifier: GPL-3.0-or-later
// A hue for each piece, and how light falls on it.
#pragma once

#include "base/vector.hpp"
#include "export/sheet/drawing.hpp"
#include "export/view/camera.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::paper {

/// Twelve hues; pieces that are glued to each other have different ones while there are fewer than twelve of
/// them, and each hue is used about as often as the others. O(joins + 12 pieces).
[[nodiscard]] IdVector<PieceId, Color> piece_hues(const mesh::Surface& surface, const unfold::Nets& nets);

/// The light on a face with this normal: it comes over the left shoulder of whoever looks.
class FaceLight {
 public:
  /// `depth` is how much darker the darkest face is, 0 to 1.
  FaceLight(Vec3 normal, const Camera& camera, double depth);

  /// What is left of a hue.
  [[nodiscard]] Color on(Color hue) const;

 private:
  double share_;    ///< of the hue that is left
  double lighter_;  ///< how much of it becomes white
};

/// A hue in the light on one face.
[[nodiscard]] Color shaded(Color hue, Vec3 normal, const Camera& camera, double depth);

/// Between two colours, all of b at share 1.
[[nodiscard]] Color mixed(Color a, Color b, double share);

}  // namespace ridgecraft::paper
