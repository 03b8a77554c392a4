// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/page_split.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// Roots from which a tree is cut; more gain little.
constexpr int roots_tried = 12;
/// Passes over all neighbouring pieces that move the cuts between them.
constexpr int balance_passes = 3;
/// Weights of a new cut, as shares of its length or of the side of a square with the two pieces' area: a fold
/// of 90 degrees is this much better than a flat one, and two equal pieces are this much better than all and
/// nothing.
constexpr double sharpness_bonus = 0.4;
constexpr double balance_weight = 0.5;
/// A cut inside a panel counts as this many mm more.
constexpr double panel_penalty = 1e6;

using Hull = std::vector<Vec2>;

Hull joined(const Hull& a, const Hull& b) {
  Hull points = a;
  points.insert(points.end(), b.begin(), b.end());
  return convex_hull(std::move(points));
}

Hull hull_of(const Triangle& t) {
  return convex_hull({t.begin(), t.end()});
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

/// Hulls and areas on both sides of each fold of a tree.
struct Sides {
  std::vector<Hull> below, above;  ///< per place in order; above[i] is the tree without the branch at i
  std::vector<double> area_below;
  std::vector<std::size_t> panels_below;
};

Sides measure_sides(const Patch& patch, std::span<const Triangle> laid, const RootedTree& tree) {
  const std::size_t n = tree.order.size();
  Sides sides;
  sides.below.resize(n);
  sides.above.resize(n);
  sides.area_below.assign(n, 0.0);
  sides.panels_below.assign(n, 1);
  std::vector<std::vector<std::uint32_t>> children(n);
  for (std::size_t i = n; i-- > 0;) {
    const Triangle& flat = laid[tree.order[i]];
    sides.below[i] = hull_of(flat);
    sides.area_below[i] += area_of(flat);
    for (const std::uint32_t child : children[i]) {
      sides.below[i] = joined(sides.below[i], sides.below[child]);
    }
    if (i > 0) {
      const std::uint32_t p = tree.parent[i];
      children[p].push_back(static_cast<std::uint32_t>(i));
      sides.area_below[p] += sides.area_below[i];
      sides.panels_below[p] += sides.panels_below[i] - within_panel(patch, tree.up[i]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::uint32_t child : children[i]) {
      Hull hull = joined(sides.above[i], hull_of(laid[tree.order[i]]));
      for (const std::uint32_t other : children[i]) {
        if (other != child) {
          hull = joined(hull, sides.below[other]);
        }
      }
      sides.above[child] = std::move(hull);
    }
  }
  return sides;
}

/// How bad a cut over this side is, mm: long, flat and unbalanced ones are.
double badness(const Patch& patch, std::uint32_t side, double area_a, double area_b) {
  const double sharp = std::min(1.0, std::abs(patch.fold_angle[side]) / (0.5 * std::numbers::pi));
  const double total = area_a + area_b;
  const double imbalance = total > 0.0 ? std::abs(area_a - area_b) / total : 0.0;
  return patch.length[side] * (1.0 - sharpness_bonus * sharp) +
         balance_weight * imbalance * std::sqrt(total) + (patch.frozen[side] != 0 ? panel_penalty : 0.0);
}

/// What each move of a cut needs, with a slot for each face of the patch.
struct Scratch {
  std::vector<std::uint32_t> place;
  std::vector<Triangle> flat;
};

/// Moves the cut between the two pieces at `side` to the best fold of their union. True when it moved.
bool move_cut(const Patch& patch, const Room& room, std::uint32_t side, Folds& folds, Scratch& scratch) {
  set_fold(patch, folds, side, true);
  const RootedTree tree = rooted_tree(patch, folds, side / 3, scratch.place);
  // Laid flat by itself: the two pieces needn't lie in one plane yet.
  std::vector<Rigid> at(tree.order.size());
  for (std::uint32_t i = 0; i < tree.order.size(); ++i) {
    if (i > 0) {
      at[i] = at[tree.parent[i]] * patch.across[patch.twin[tree.up[i]]];
    }
    for (unsigned k = 0; k < 3; ++k) {
      scratch.flat[tree.order[i]][k] = at[i](patch.shape[tree.order[i]][k]);
    }
  }
  const Sides sides = measure_sides(patch, scratch.flat, tree);
  const std::size_t n = tree.order.size();
  double least = INFINITY;
  std::uint32_t best = side;
  for (std::uint32_t i = 1; i < n; ++i) {
    if (!room.holds(sides.below[i], sides.panels_below[i]) ||
        !room.holds(sides.above[i],
                    sides.panels_below[0] - sides.panels_below[i] + within_panel(patch, tree.up[i]))) {
      continue;
    }
    const double bad =
        badness(patch, tree.up[i], sides.area_below[i], sides.area_below[0] - sides.area_below[i]);
    if (bad < least) {
      least = bad;
      best = tree.up[i];
    }
  }
  set_fold(patch, folds, best, false);
  return best != side && best != patch.twin[side];
}

/// `cuts`: the folds of the tree that was split. They bound neighbouring pieces and stay a tree of pieces.
void balance(const Patch& patch, const Folds& before, const Room& room, Folds& folds,
             const Context& context) {
  Scratch scratch{std::vector<std::uint32_t>(patch.size(), nothing), std::vector<Triangle>(patch.size())};
  for (int pass = 0; pass < balance_passes; ++pass) {
    bool moved = false;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      if (before[side] != 0 && folds[side] == 0 && side < patch.twin[side]) {
        context.check();
        if (context.out_of_grace()) {
          return;
        }
        moved = move_cut(patch, room, side, folds, scratch) || moved;
      }
    }
    if (!moved) {
      return;
    }
  }
}

}  // namespace

SplitCost cost_of(const Patch& patch, const Folds& folds) {
  SplitCost cost;
  std::size_t tree_folds = 0;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin == nothing || twin < side) {
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
  std::vector<std::uint32_t> place(patch.size(), nothing);
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
  balance(patch, folds, room, result, context);
  return result;
}

}  // namespace ridgecraft::unfold
