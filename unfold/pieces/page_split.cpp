// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/page_split.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// Roots from which a tree is cut; more gain little.
constexpr int roots_tried = 12;

using Hull = std::vector<Vec2>;

Hull joined(const Hull& a, const Hull& b) {
  Hull points = a;
  points.insert(points.end(), b.begin(), b.end());
  return convex_hull(std::move(points));
}

/// The place of the uppermost face of each face's panel.
std::vector<std::uint32_t> panel_tops(const Patch& patch, const RootedTree& tree) {
  std::vector<std::uint32_t> top(tree.order.size(), 0);
  for (std::uint32_t i = 1; i < top.size(); ++i) {
    top[i] = patch.frozen[tree.up[i]] != 0 ? top[tree.parent[i]] : i;
  }
  return top;
}

/// Cuts one rooted tree from its leaves upwards: at each panel the branches are taken in, small ones first,
/// as long as the whole fits; the others are cut off.
void peel(const Patch& patch, const Layout& layout, const RootedTree& tree, const Room& room, Folds& folds) {
  struct Branch {
    Hull hull;
    std::size_t panels = 1;
    double area = 0.0;
  };
  const std::size_t n = tree.order.size();
  const std::vector<std::uint32_t> top = panel_tops(patch, tree);
  std::vector<Branch> branch(n);
  std::vector<std::vector<Vec2>> own(n);
  std::vector<std::vector<std::uint32_t>> children(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const Triangle& flat = layout.flat[tree.order[i]];
    own[top[i]].insert(own[top[i]].end(), flat.begin(), flat.end());
    branch[top[i]].area += area_of(flat);
    if (i > 0 && top[i] != i) {
      branch[top[i]].panels += 1 - within_panel(patch, tree.up[i]);
    }
    if (i > 0 && top[i] == i) {
      children[top[tree.parent[i]]].push_back(i);
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    if (top[i] != i) {
      continue;
    }
    branch[i].hull = convex_hull(std::move(own[i]));
    auto& below = children[i];
    std::sort(below.begin(), below.end(), [&](std::uint32_t a, std::uint32_t b) {
      return branch[a].area != branch[b].area ? branch[a].area < branch[b].area : a < b;
    });
    for (const std::uint32_t child : below) {
      Hull hull = joined(branch[i].hull, branch[child].hull);
      const std::size_t panels = branch[i].panels + branch[child].panels;
      if (room.holds(hull, panels)) {
        branch[i].hull = std::move(hull);
        branch[i].panels = panels;
        branch[i].area += branch[child].area;
      } else {
        set_fold(patch, folds, tree.up[child], false);
      }
      branch[child] = Branch{};
    }
  }
}

}  // namespace

SplitCost cost_of(const Patch& patch, const Folds& folds) {
  SplitCost cost;
  std::size_t tree_folds = 0;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin == no_index || twin < side) {
      continue;
    }
    if (folds[side] != 0) {
      ++tree_folds;
    } else {
      cost.cut_mm += patch.length[side];
      // Frozen sides that no tree could fold too (a fan around a vertex) count alike for all trees.
      cost.cut_panels += patch.frozen[side] != 0 ? 1U : 0U;
    }
  }
  cost.pieces = patch.size() - tree_folds;
  return cost;
}

Folds split_to_fit(const Patch& patch, const Folds& folds, const Room& room, Random& random,
                   const Context& context) {
  Folds result = folds;
  const Layout layout = lay_out(patch, folds);
  std::vector<std::uint32_t> place(patch.size(), no_index);
  for (const auto& faces : layout.faces) {
    if (room.holds(hull_of(layout, faces), panels_of(patch, folds, faces))) {
      continue;
    }
    std::optional<SplitCost> least;
    Folds best;
    for (int attempt = 0; attempt < roots_tried; ++attempt) {
      context.check();
      if (attempt > 0 && context.out_of_grace()) {
        break;
      }
      const std::uint32_t root = faces[random.below(static_cast<std::uint32_t>(faces.size()))];
      Folds trial = result;
      peel(patch, layout, rooted_tree(patch, folds, root, place), room, trial);
      const SplitCost cost = cost_of(patch, trial);
      if (!least || cost < *least) {
        least = cost;
        best = std::move(trial);
      }
    }
    result = std::move(best);
  }
  return result;
}

}  // namespace ridgecraft::unfold
