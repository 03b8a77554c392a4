// SPDX-License-Identifier: GPL-3.0-or-later
// Models without thickness: a solid that was scaled to nothing in one direction, for example.
#pragma once

#include "mesh/model/surface.hpp"

namespace ridgecraft::unfold {

/// Whether all of a surface lies in one plane, to a thousandth of a millimetre and a millionth of its extent,
/// in several layers that hang together over edges folded by 180 degrees. O(n).
[[nodiscard]] bool is_folded_flat(const mesh::Surface& surface);

}  // namespace ridgecraft::unfold
