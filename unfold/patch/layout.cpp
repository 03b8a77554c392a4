// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/layout.hpp"

#include <algorithm>

#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/geometry.hpp"
#include "unfold/net/tolerance.hpp"

namespace ridgecraft::unfold {

namespace {

/// How far a point within `reach` of a face's middle lies from itself when the face is at one place and at
/// the other, at most.
double distance_between(const Rigid& one, const Rigid& other, double reach) {
  return length(one.shift - other.shift) +
         reach * elementary::hypot(one.cosine - other.cosine, one.sine - other.sine);
}

}  // namespace

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

bool lies_one_way(const Patch& patch, const Folds& tree, double tolerance) {
  std::vector<Rigid> place(patch.size());
  std::vector<std::uint8_t> placed(patch.size(), 0);
  std::vector<std::uint32_t> order{0};
  placed[0] = 1;
  double reach = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t f = order[i];
    reach = std::max(reach, 2.0 * length(place[f].shift) + length(patch.shape[f][0]));
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      const std::uint32_t g = tree[side] != 0 ? patch.twin[side] / 3 : f;
      if (placed[g] == 0) {
        placed[g] = 1;
        place[g] = place[f] * patch.across[side];
        order.push_back(g);
      }
    }
  }
  // Two trees differ by what their folds differ by, added up over no more folds than there are faces.
  const double allowed = 0.1 * tolerance / patch.size();
  for (std::uint32_t side = 0; side < tree.size(); ++side) {
    if (patch.twin[side] != nothing && tree[side] == 0 &&
        !(distance_between(place[side / 3] * patch.across[side], place[patch.twin[side] / 3], reach) <=
          allowed)) {
      return false;
    }
  }
  return true;
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
