// SPDX-License-Identifier: GPL-3.0-or-later
// Anything that could be read becomes a surface. Private to mesh/.
#pragma once

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/soup.hpp"

namespace ridgecraft::mesh {

/// Makes the invariants of Surface true, in the order of docs/design/mesh.md; every change is
/// counted. Name and digest are the caller's. Throws Error(unusable_mesh) without naming the file where no
/// face with an area is left. O(n log n).
[[nodiscard]] Model repair(Soup soup, const ReadOptions& options, const Context& context);

}  // namespace ridgecraft::mesh
