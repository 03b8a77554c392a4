// SPDX-License-Identifier: GPL-3.0-or-later
// Hairs, wires and threads: bodies that are long and thin, also where they are bent. Private to prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/details/neighbours.hpp"

namespace ridgecraft::prepare {

/// A strand is a component that would be flatter than `narrow` if it were pressed flat (a strip: narrower),
/// and many times as long. Its width is told by its area over its length, so it may be bent. What meets two
/// components that are no strands, as far as their faces' boxes tell, holds them together, and is none. Where
/// strands have most of the area of a surface, they are what the model is made of, and none is told. Of each
/// component by its faces, whether it is one. O(n log n).
[[nodiscard]] std::vector<bool> are_strands(const mesh::Surface& surface,
                                            const std::vector<ComponentFaces>& components, double narrow,
                                            const Context& context);

/// Along its longest principal axis, in the unit of the surface: what a strand is at least long.
[[nodiscard]] double strand_length(const mesh::Surface& surface, const ComponentFaces& strand);

}  // namespace ridgecraft::prepare
