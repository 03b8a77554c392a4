// SPDX-License-Identifier: GPL-3.0-or-later
// One box, 2 wide, 1 deep and 3 high (z is up), in formats that ridgecraft-import reads.
#pragma once

#include <string>

namespace ridgecraft::test {

/// FBX as text: in inches, an object "tower" of the orange material "stone".
[[nodiscard]] std::string fbx_tower();
/// COLLADA, the same in centimetres.
[[nodiscard]] std::string dae_tower();
/// 3DS, the same in triangles; the object's name is lost on the way through Assimp.
[[nodiscard]] std::string max3ds_tower();

}  // namespace ridgecraft::test
