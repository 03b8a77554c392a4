// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of a surface that are the same but for where they lie, mirrored or not: wheels, oars.
#pragma once

#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::prepare {

/// One of several bodies that are copies of the first of them: face i here is its face i, moved. Where it is
/// mirrored, too, corners run the other way round: corner k of the first one's face is corner (3 - k) % 3.
struct TwinBody {
  bool mirrored = false;
  std::vector<FaceId> faces;  ///< a whole component
};

/// Kinds of bodies that there are several of; the first of each kind is the one that the others are copies
/// of, with its faces ascending.
using TwinBodies = std::vector<std::vector<TwinBody>>;

/// The corner of `image`, a copy of a face, that is its corner k.
[[nodiscard]] constexpr CornerId twin_corner(FaceId image, unsigned k, bool mirrored) {
  return mesh::corner(image, mirrored ? (3 - k) % 3 : k);
}
/// The same for the side that runs from corner k on.
[[nodiscard]] constexpr CornerId twin_side(FaceId image, unsigned k, bool mirrored) {
  return mesh::corner(image, mirrored ? 2 - k : k);
}

}  // namespace ridgecraft::prepare
