// SPDX-License-Identifier: GPL-3.0-or-later
// Which edges of a model come to lie on which when it is mirrored or turned, so that what is cut here is cut
// there, too, and equal shapes become equal pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "unfold/energy/cut_costs.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// What lies on what when a model is mirrored or turned.
struct EdgeImages {
  /// Of each edge its image, which may be the edge itself; none where it has none.
  IdVector<EdgeId, EdgeId> edge;
  double weight = 1.0;  ///< of a mm of seam whose image is none, as a share of Weights::mirror
};

/// How a model, or a fair part of it, comes to lie on itself. The images generate all others: mirrored at the
/// plane, where there is one, then turned about an axis by the smallest angle, one way and the other, with
/// half the weight each.
struct Symmetry {
  std::optional<prepare::MirrorPlane> plane;
  std::vector<EdgeImages> images;
};

/// The best plane, and the smallest turn. Empty where neither fits a fair part of the model, or images weigh
/// nothing. O(n log n). Throws Error(interrupted); after the deadline nothing more is looked for.
[[nodiscard]] Symmetry find_symmetry(const mesh::Surface& surface, const Weights& weights,
                                     const Context& context);

/// The same for the sides of a patch: one side of the image, `no_index` where that is no fold or cut within
/// the patch that could be exchanged, or the side's own edge, or where labels meet at one of the two alone.
/// O(n log n).
[[nodiscard]] std::vector<SideImages> images_of_sides(const mesh::Surface& surface, const Patch& patch,
                                                      std::span<const EdgeImages> images);

/// The folds of a patch as they are in the tree of its image: where each of its edges
/// that could be a cut has its image there. Nothing where that isn't so, or isn't a tree. O(n log n).
[[nodiscard]] std::optional<Folds> carried_over(const mesh::Surface& surface, const Patch& from,
                                                const Folds& tree, const Patch& to,
                                                const IdVector<EdgeId, EdgeId>& images);

}  // namespace ridgecraft::unfold
