// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/carried_trees.hpp"

#include <algorithm>

#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/mirror_images.hpp"

namespace ridgecraft::unfold {

CarriedTrees::CarriedTrees(const NetProblem& problem, const Folds& folds, const Layout& layout,
                           const Context& context)
    : problem_(problem), folds_(folds), layout_(layout), random_(context.seed), context_(context) {
  search_.tolerance = problem.tolerance();
}

bool CarriedTrees::was_a_piece(const std::vector<std::uint32_t>& faces) const {
  const std::uint32_t before = layout_.piece[faces.front()];
  return layout_.faces[before].size() == faces.size() &&
         std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) { return layout_.piece[f] == before; });
}

std::optional<Folds> CarriedTrees::tree_of(const std::vector<std::uint32_t>& faces) {
  if (was_a_piece(faces)) {
    return sub_folds(problem_.patch, folds_, faces);
  }
  return find_one_piece(sub_patch(problem_.patch, faces), problem_.room, search_, random_.next(), context_)
      .tree;
}

std::optional<Folds> CarriedTrees::image_of(const std::vector<std::uint32_t>& original,
                                            const std::vector<std::uint32_t>& faces, const Folds& result,
                                            const IdVector<EdgeId, EdgeId>& images) {
  const Patch own = sub_patch(problem_.patch, faces);
  std::optional<Folds> tree = carried_over(problem_.surface, sub_patch(problem_.patch, original),
                                           sub_folds(problem_.patch, result, original), own, images);
  if (tree && all_fit(own, *tree, problem_.room) &&
      find_overlaps(lay_out(own, *tree), search_.tolerance).empty()) {
    return tree;
  }
  return find_one_piece(own, problem_.room, search_, random_.next(), context_).tree;
}

}  // namespace ridgecraft::unfold
