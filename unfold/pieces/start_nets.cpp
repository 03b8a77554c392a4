// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/start_nets.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/search/forest_overlaps.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {
namespace {

bool has_panels(const Patch& patch) {
  return std::any_of(patch.frozen.begin(), patch.frozen.end(), [](std::uint8_t f) { return f != 0; });
}

/// The best tree that the search for one net comes to.
Folds searched_tree(const Patch& patch, const StartRules& rules, Random& random, const Context& context) {
  const auto search = [&](const Patch& of) {
    const Folds start = start_tree(of, random);
    return find_net(of, start, rules.tolerance, random.next(), context);
  };
  NetFound net = search(patch);
  if (net.overlaps > 0 && rules.panel_cuts == PanelCuts::before_pieces && has_panels(patch)) {
    Patch loose = patch;
    std::fill(loose.frozen.begin(), loose.frozen.end(), std::uint8_t{0});
    if (NetFound other = search(loose); other.overlaps == 0) {
      net = std::move(other);
    }
  }
  return std::move(net.folds);
}

/// When time is up only trees of so few faces are hung on others: looking at large ones takes longer than all
/// else.
constexpr std::uint32_t most_faces_late = 16;

/// Trees that grow together as far as they lie flat and fit.
class GrowingForest {
 public:
  GrowingForest(const Patch& patch, const Folds& folds, const Room& room, double tolerance)
      : room_(room), forest_(patch), overlaps_(forest_, tolerance) {
    forest_.set_folds(folds);
    overlaps_.find_all();
    size_.resize(forest_.tree_limit());
    for (const std::uint32_t tree : forest_.trees()) {
      size_[tree] = {hull_of(tree), panels_of(patch, folds, forest_.faces_of(tree))};
    }
  }

  /// Makes a fold of an edge where that joins two trees to one without overlap that fits, and the smaller one
  /// has no more than so many faces.
  void join_at(std::uint32_t side, std::uint32_t most_faces) {
    const Move move{no_index, side};
    if (forest_.tree_of(side / 3) == forest_.tree_of(forest_.patch().twin[side] / 3)) {
      return;
    }
    const Forest::Carried what = forest_.carried(move);
    if (what.faces.count > most_faces) {
      return;
    }
    std::vector<Vec2> hull = size_[what.to].hull;
    for (const Vec2 p : size_[what.faces.tree].hull) {
      hull.push_back(what.motion(p));
    }
    hull = convex_hull(std::move(hull));
    const std::size_t panels = size_[what.to].panels + size_[what.faces.tree].panels;
    if (room_.holds(hull, panels) && overlaps_.is_clean(move)) {
      overlaps_.make(move);
      forest_.make(move);
      size_[what.to] = {std::move(hull), panels};
    }
  }

  /// Opens what only rounding has kept apart: a layout of its own decides.
  void part_overlaps(double tolerance) {
    const Patch& patch = forest_.patch();
    for (;;) {
      const std::vector<OverlapFound> found = find_overlaps(lay_out(patch, forest_.folds()), tolerance);
      if (found.empty()) {
        return;
      }
      const std::vector<std::uint32_t>& way =
          forest_.folds_between(found.front().first, found.front().second);
      if (way.empty()) {
        return;
      }
      forest_.make({way.front(), no_index});
    }
  }

  [[nodiscard]] const Folds& folds() const { return forest_.folds(); }

 private:
  struct Size {
    std::vector<Vec2> hull;  ///< in the tree's plane
    std::size_t panels = 1;
  };

  [[nodiscard]] std::vector<Vec2> hull_of(std::uint32_t tree) const {
    std::vector<Vec2> corners;
    for (const std::uint32_t f : forest_.faces_of(tree)) {
      corners.insert(corners.end(), forest_.flat(f).begin(), forest_.flat(f).end());
    }
    return convex_hull(std::move(corners));
  }

  const Room& room_;
  Forest forest_;
  ForestOverlaps overlaps_;
  std::vector<Size> size_;  ///< per number of a tree
};

}  // namespace

Folds start_nets(const Patch& patch, const Room& room, const StartRules& rules, std::uint64_t seed,
                 const Context& context) {
  Random random(seed);
  // A net may have been found only where panels come apart.
  const Folds net = rules.one_net ? searched_tree(patch, rules, random, context) : frozen_folds(patch);
  Folds held = net;
  std::transform(held.begin(), held.end(), patch.frozen.begin(), held.begin(),
                 [](std::uint8_t fold, std::uint8_t frozen) { return frozen != 0 ? fold : std::uint8_t{0}; });
  std::vector<std::uint32_t> sides = longest_first(patch, random);
  std::stable_partition(sides.begin(), sides.end(), [&](std::uint32_t side) { return net[side] != 0; });
  GrowingForest forest(patch, held, room, rules.tolerance);
  for (const std::uint32_t side : sides) {
    context.check();
    forest.join_at(side, context.out_of_time() ? most_faces_late : patch.size());
  }
  forest.part_overlaps(rules.tolerance);
  return forest.folds();
}

}  // namespace ridgecraft::unfold
