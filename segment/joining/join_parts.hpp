// SPDX-License-Identifier: GPL-3.0-or-later
// What cutting divided too far is put together: crumbs, then neighbours by the merge pass or by the attempts
// of more effort (docs/design/segmentation.md, "Merge pass").
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/division.hpp"
#include "segment/joining/assembly.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

// The crumbs of a damaged surface join the parts that they touch (docs/design/segmentation.md, "Damaged
// models").

/// Puts parts into one of them; false, and nothing is changed, where they can't be one.
using UniteParts = std::function<bool(std::span<const std::uint32_t> parts, std::uint32_t into)>;

/// Small components that touch a larger one at a vertex join its part there, if `unite` allows it; what had
/// joined the crumb before comes along. Of several parts that which has the smallest facet at such a vertex
/// is asked first. `components`: of the whole surface. `parts`: the facets of each. Asks once
/// for each crumb and part at its vertices, and again in each further pass, of which there are as many as the
/// longest chain of crumbs has links.
void absorb_crumbs(const ScaledSurface& surface, std::vector<Facets> components, std::vector<Facets> parts,
                   const UniteParts& unite, const Context& context);

/// What joining works with, on one thread.
struct JoiningTools {
  Measurer* measurer;
  const EdgeWeights* weights;
  Assembly* assembly;    ///< null: the merge pass is all
  ValleyCache* valleys;  ///< known ones; those that are found are added
};

/// Joins parts that are within the tolerance to fewer that are, too. A part that comes out as it went in
/// keeps its reason.
[[nodiscard]] std::vector<PartTask> join_parts(std::vector<MeasuredPart> parts, const JoiningTools& tools);

/// The same parts as tasks.
[[nodiscard]] std::vector<PartTask> leave_parts(std::vector<MeasuredPart> parts);

struct Rejoined {
  std::vector<MeasuredPart> kept;
  std::vector<PartTask> changed;  ///< within the tolerance from scratch, but not known how far
};

/// Joins parts of which the last measurement divided some (their depth is above 0): these with each other and
/// with their neighbours, where the union is within the tolerance from scratch.
[[nodiscard]] Rejoined rejoin_divided(std::vector<MeasuredPart> parts, const JoiningTools& tools);

}  // namespace ridgecraft::segment
