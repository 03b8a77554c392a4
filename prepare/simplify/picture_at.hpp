// SPDX-License-Identifier: GPL-3.0-or-later
// Where a picture lies on a face. Private to prepare/.
#pragma once

#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"

namespace ridgecraft::prepare {

/// The place in the picture that belongs to a point in a face's plane. `faces` are those of the surface, with
/// textures.
[[nodiscard]] Vec2 picture_at(const mesh::Surface& surface, const mesh::LooseFaces& faces, FaceId f, Vec3 p);

}  // namespace ridgecraft::prepare
