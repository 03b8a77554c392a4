// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/layout.hpp"

#include "base/convex_hull.hpp"
#include "base/error.hpp"
#include "unfold/net/tolerance.hpp"

namespace ridgecraft::unfold {

Layout lay_out(const Patch& patch, const Folds& folds) {
  const std::uint32_t n = patch.size();
  Layout layout;
  layout.flat.resize(n);
  layout.piece.assign(n, nothing);
  std::vector<Rigid> place(n);
  for (std::uint32_t root = 0; root < n; ++root) {
    if (layout.piece[root] != nothing) {
      continue;
    }
    const auto piece = static_cast<std::uint32_t>(layout.faces.size());
    std::vector<std::uint32_t>& order = layout.faces.emplace_back();
    layout.piece[root] = piece;
    order.push_back(root);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::uint32_t f = order[i];
      for (unsigned k = 0; k < 3; ++k) {
        layout.flat[f][k] = place[f](patch.shape[f][k]);
        const std::uint32_t side = 3 * f + k;
        if (folds[side] == 0) {
          continue;
        }
        RIDGECRAFT_ASSERT(folds[patch.twin[side]] != 0);
        const std::uint32_t g = patch.twin[side] / 3;
        if (layout.piece[g] == nothing) {
          layout.piece[g] = piece;
          place[g] = place[f] * patch.across[side];
          order.push_back(g);
        }
      }
    }
  }
  return layout;
}

bool is_slit(const Patch& patch, const Folds& folds, const Layout& layout, std::uint32_t side) {
  const std::uint32_t twin = patch.twin[side];
  if (twin == nothing || patch.frozen[side] == 0 || folds[side] != 0 ||
      layout.piece[side / 3] != layout.piece[twin / 3]) {
    return false;
  }
  const Triangle& here = layout.flat[side / 3];
  const Triangle& there = layout.flat[twin / 3];
  return length(here[side % 3] - there[(twin % 3 + 1) % 3]) <= closing_tolerance_mm &&
         length(here[(side % 3 + 1) % 3] - there[twin % 3]) <= closing_tolerance_mm;
}

std::vector<Vec2> hull_of(const Layout& layout, std::span<const std::uint32_t> faces) {
  std::vector<Vec2> points;
  points.reserve(3 * faces.size());
  for (const std::uint32_t f : faces) {
    points.insert(points.end(), layout.flat[f].begin(), layout.flat[f].end());
  }
  return convex_hull(std::move(points));
}

}  // namespace ridgecraft::unfold
