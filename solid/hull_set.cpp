// SPDX-License-Identifier: GPL-3.0-or-later
// Hulls for a whole model.
#include <algorithm>
#include <utility>
#include <vector>

#include "solid/cover.hpp"
#include "solid/hulls.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

/// Two bodies whose hull is larger than they are by no more than this share are as good as one.
constexpr double free_share = 1e-3;

}  // namespace

HullSet model_hulls(const mesh::Surface& surface, const segment::Segmentation& parts,
                    const HullOptions& options, const Context& context) {
  HullSet set;
  set.bodies = part_hulls(surface, parts, {}, context);
  const std::size_t of_parts = set.bodies.size();
  set.fit = cover_volume(surface, set.bodies, context);
  set.filling = set.bodies.size() - of_parts;
  bool changed = set.filling > 0;
  if (set.filling > 0) {
    // Much of what was filled goes with the parts around it into one.
    set.bodies =
        joined(std::move(set.bodies), {.most = options.max_hulls, .free_share = free_share}, context);
  } else if (options.max_hulls > 0 && set.bodies.size() > options.max_hulls) {
    set.bodies = joined(std::move(set.bodies), {.most = options.max_hulls, .free_share = -1.0}, context);
    changed = true;
  }
  for (Body& body : set.bodies) {
    if (options.max_vertices != 0 && body.points.size() > options.max_vertices) {
      body = enclosing_polytope(body, options.max_vertices, context);
      changed = true;
    }
  }
  if (changed) {
    set.fit = fit_of(surface, set.bodies, context);
  }
  return set;
}

}  // namespace ridgecraft::solid
