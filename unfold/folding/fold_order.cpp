// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/folding/fold_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "unfold/folding/opening.hpp"

namespace ridgecraft::unfold {
namespace {

/// Creases times faces that single creases are tried for: more takes seconds.
constexpr std::size_t most_single = 1'000'000;

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
  } else {
    const Opening opening = open_piece(motion, trial, context);
    if (opening.opened.size() == creases.size()) {
      result.way = FoldWay::in_order;
      result.order.assign(opening.opened.rbegin(), opening.opened.rend());
    }
    result.in_the_way = opening.in_the_way;
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
  if (folding.in_the_way) {
    const auto [f, g] = *folding.in_the_way;
    result.in_the_way = std::array<FaceId, 2>{faces[f], faces[g]};
  }
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
