// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/foldable_pieces.hpp"

#include <cstdint>
#include <vector>

#include "base/parallel.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/linear_split.hpp"

namespace ridgecraft::unfold {

Folds with_foldable_pieces(const Asked& asked, const Plan& plan, const Patch& patch, const Folds& folds,
                           Causes& causes, const Context& context) {
  const Nets nets = nets_of_folds(asked.surface, asked.part, patch, folds, causes);
  std::vector<std::uint8_t> stuck(nets.pieces.size(), 0);
  do_in_parallel(nets.pieces.size(), context, [&](std::size_t i, const Context& own) {
    stuck[i] = find_fold_order(asked.surface, nets, PieceId(i), own).way == FoldWay::with_care ? 1 : 0;
  });
  Folds result = folds;
  for (const PieceId id : ids<PieceId>(nets.pieces.size())) {
    if (stuck[id.value()] == 0) {
      continue;
    }
    std::vector<std::uint32_t> faces;
    for (const FaceId f : nets.pieces[id].faces) {
      faces.push_back(f.value());
    }
    const LinearSplit split =
        split_to_fold_together(sub_patch(patch, faces), sub_folds(patch, folds, faces), plan.room,
                               net_tolerance(patch.extent), context.seed, context);
    put_back(patch, faces, split.folds, result);
  }
  blame(patch, folds, result, PieceReason::shape, causes);
  return result;
}

}  // namespace ridgecraft::unfold
