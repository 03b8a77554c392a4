// SPDX-License-Identifier: GPL-3.0-or-later
// Which edges of a model are mirror images of each other, so that what is cut on one side is cut on the
// other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/symmetry/isometry.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// How far an image, mirrored or turned, may be off for cuts to be carried over, as a share of the model's
/// extent: hardly seen.
inline constexpr double seen_as_image = 0.02;
/// Larger models are searched without regard to symmetry: finding it would take as long as all else.
inline constexpr std::size_t most_faces_of_images = 20'000;
/// What lies on what at the plane of a model.
struct MirrorImages {
  IdVector<EdgeId, EdgeId> edge;  ///< of each edge; empty where the model has no such plane
  prepare::MirrorPlane plane;
};

/// For each edge its mirror image at the plane at which most of the model has one, the edge itself where it
/// lies on the plane or crosses it upright, none where it has none. Empty where no plane mirrors a fair part
/// of the model, or mirror images weigh nothing. O(n log n).
[[nodiscard]] MirrorImages mirror_images(const mesh::Surface& surface, const Weights& weights);

/// The same for the sides of a patch: one side of the image, `no_index` where that is no fold or cut within
/// the patch that could be exchanged, or the side's own edge. O(n log n).
[[nodiscard]] std::vector<std::uint32_t> mirror_sides(const mesh::Surface& surface, const Patch& patch,
                                                      const IdVector<EdgeId, EdgeId>& images);

/// What an edge is in a forest of the whole surface.
enum class InForest : std::int8_t { fold = -1, fixed = 0, cut = 1 };

/// What each edge is; `fixed` where it can't be exchanged. O(n log n).
[[nodiscard]] IdVector<EdgeId, InForest> edges_in_forest(const mesh::Surface& surface, const Patch& whole,
                                                         const Folds& folds);

/// Per side of a patch: what the mirror image of its edge is, as InForest, where that lies outside the patch;
/// 0 for all others. O(n log n).
[[nodiscard]] std::vector<std::int8_t> images_outside(const mesh::Surface& surface, const Patch& patch,
                                                      const IdVector<EdgeId, EdgeId>& images,
                                                      const IdVector<EdgeId, InForest>& edges);

/// The folds of a patch as they are in the tree of its image, mirrored or turned: where each of its edges
/// that could be a cut has its image there. Nothing where that isn't so, or isn't a tree. O(n log n).
[[nodiscard]] std::optional<Folds> carried_over(const mesh::Surface& surface, const Patch& from,
                                                const Folds& tree, const Patch& to,
                                                const IdVector<EdgeId, EdgeId>& images);

}  // namespace ridgecraft::unfold
