// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/carried_trees.hpp"

#include <algorithm>

#include "unfold/patch/check.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/mirror_images.hpp"

namespace ridgecraft::unfold {

CarriedTrees::CarriedTrees(const mesh::Surface& surface, const Patch& patch, const Folds& folds,
                           const Layout& layout, const Room& room, double tolerance, std::uint64_t seed,
                           const Context& context)
    : surface_(surface),
      patch_(patch),
      folds_(folds),
      layout_(layout),
      room_(room),
      random_(seed),
      context_(context) {
  search_.tolerance = tolerance;
}

bool CarriedTrees::was_a_piece(const std::vector<std::uint32_t>& faces) const {
  const std::uint32_t before = layout_.piece[faces.front()];
  return layout_.faces[before].size() == faces.size() &&
         std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) { return layout_.piece[f] == before; });
}

std::optional<Folds> CarriedTrees::tree_of(const std::vector<std::uint32_t>& faces) {
  if (was_a_piece(faces)) {
    return sub_folds(patch_, folds_, faces);
  }
  return find_one_piece(sub_patch(patch_, faces), room_, search_, random_.next(), context_).tree;
}

std::optional<Folds> CarriedTrees::image_of(const std::vector<std::uint32_t>& original,
                                            const std::vector<std::uint32_t>& faces, const Folds& result,
                                            const IdVector<EdgeId, EdgeId>& images) {
  const Patch own = sub_patch(patch_, faces);
  std::optional<Folds> tree =
      carried_over(surface_, sub_patch(patch_, original), sub_folds(patch_, result, original), own, images);
  if (tree && all_fit(own, *tree, room_) && find_overlaps(lay_out(own, *tree), search_.tolerance).empty()) {
    return tree;
  }
  return find_one_piece(own, room_, search_, random_.next(), context_).tree;
}

}  // namespace ridgecraft::unfold
