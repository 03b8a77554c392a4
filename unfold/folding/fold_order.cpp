// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/fold_order.hpp"

#include <algorithm>
#include <numeric>

namespace ridgecraft::unfold {
namespace {

/// Creases times faces that single creases are tried for: about a tenth of a second.
constexpr std::size_t most_single = 120'000;

}  // namespace

Folding find_folding(const FoldMotion& motion, FoldTrial& trial, const Context& context) {
  return trial.together_works() ? Folding{} : find_order(motion, trial, context);
}

Folding find_order(const FoldMotion& motion, FoldTrial& trial, const Context& context) {
  Folding result;
  const auto& creases = motion.creases();
  std::vector<std::uint32_t> outwards(creases.size());
  std::iota(outwards.begin(), outwards.end(), 0U);
  std::stable_sort(outwards.begin(), outwards.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return creases[a].depth < creases[b].depth; });
  result.order.assign(outwards.rbegin(), outwards.rend());
  result.way = FoldWay::with_care;
  if (creases.size() * motion.face_count() > most_single || context.out_of_time()) {
    return result;
  }
  if (trial.order_works(result.order)) {
    result.way = FoldWay::leaves_first;
  } else if (trial.order_works(outwards)) {
    result.way = FoldWay::middle_first;
    result.order = std::move(outwards);
  }
  return result;
}

FoldOrder find_fold_order(const mesh::Surface& surface, const Nets& nets, PieceId piece,
                          const Context& context) {
  const FoldMotion motion(flat_piece(surface, nets, piece));
  FoldTrial trial(motion, context);
  const Folding folding = find_folding(motion, trial, context);
  const std::vector<FaceId>& faces = nets.pieces[piece].faces;
  FoldOrder result;
  result.way = folding.way;
  const auto add = [&](const FoldMotion::Crease& crease, std::vector<CornerId>& step) {
    for (const std::uint32_t side : crease.sides) {
      step.push_back(mesh::corner(faces[side / 3], side % 3));
    }
  };
  if (folding.way == FoldWay::together && !motion.creases().empty()) {
    std::vector<CornerId>& all = result.steps.emplace_back();
    for (const FoldMotion::Crease& crease : motion.creases()) {
      add(crease, all);
    }
  }
  for (const std::uint32_t crease : folding.order) {
    add(motion.creases()[crease], result.steps.emplace_back());
  }
  return result;
}

}  // namespace ridgecraft::unfold
