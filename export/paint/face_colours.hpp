// SPDX-License-Identifier: GPL-3.0-or-later
// What of a face's colours can be drawn as areas, and what needs a picture.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/look/look.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::export_ {

struct FaceColours {
  /// An area of one colour: corners as weights of the face's second and third corner.
  struct Fragment {
    std::vector<Vec2> polygon;
    mesh::Rgb colour;
  };
  /// One colour all over, ...
  std::optional<mesh::Rgb> flat;
  /// ... or areas that cover the face, where it is still that of the original surface; both empty: a picture.
  std::vector<Fragment> fragments;

  [[nodiscard]] bool needs_picture() const { return !flat && fragments.empty(); }
};

/// Of each face. Where faces of the original surface lie in the face and cover it, their borders are kept
/// exactly; elsewhere the nearest places of the original surface are looked at, a millimetre apart. O(faces
/// of both x log n). Throws Error(interrupted).
[[nodiscard]] IdVector<FaceId, FaceColours> face_colours(const mesh::Surface& surface, const mesh::Look& look,
                                                         const Context& context);

}  // namespace ridgecraft::export_
