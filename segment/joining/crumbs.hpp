// SPDX-License-Identifier: GPL-3.0-or-later
// The crumbs of a damaged surface join the parts that they touch (docs/design/segmentation.md, "Damaged
// models").
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Puts parts into one of them; false, and nothing is changed, where they can't be one.
using UniteParts = std::function<bool(std::span<const std::uint32_t> parts, std::uint32_t into)>;

/// Small components that touch a larger one at a vertex join its part there, if `unite` allows it; what had
/// joined the crumb before comes along. Of several parts that which has the smallest facet at such a vertex
/// is asked first. `components`: of the whole surface. `parts`: the facets of each. Asks once
/// for each crumb and part at its vertices, and again in each further pass, of which there are as many as the
/// longest chain of crumbs has links.
void absorb_crumbs(const ScaledSurface& surface, std::vector<Facets> components, std::vector<Facets> parts,
                   const UniteParts& unite, const Context& context);

}  // namespace ridgecraft::segment
