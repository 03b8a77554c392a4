// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/overlap_split.hpp"

#include <algorithm>

#include "unfold/patch/check.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"

namespace ridgecraft::unfold {
namespace {

/// A tree with the folds on the path of each overlapping pair, as places of the lower face.
struct Conflicts {
  RootedTree tree;
  std::vector<std::uint32_t> below;  ///< faces in the branch at each place
  std::vector<std::vector<std::uint32_t>> paths;
};

Conflicts find_conflicts(const Patch& patch, const Folds& folds, std::uint32_t root,
                         const std::vector<OverlapFound>& pairs, const Layout& layout) {
  Conflicts conflicts;
  std::vector<std::uint32_t> place(patch.size(), nothing);
  conflicts.tree = rooted_tree(patch, folds, root, place);
  const RootedTree& tree = conflicts.tree;
  conflicts.below.assign(tree.order.size(), 1);
  for (std::size_t i = tree.order.size(); i-- > 1;) {
    conflicts.below[tree.parent[i]] += conflicts.below[i];
  }
  for (const OverlapFound& pair : pairs) {
    if (layout.piece[pair.first] != layout.piece[root]) {
      continue;
    }
    std::vector<std::uint32_t>& path = conflicts.paths.emplace_back();
    // Places grow from parents to children, so the later one is climbed from until both meet.
    std::uint32_t a = place[pair.first];
    std::uint32_t b = place[pair.second];
    while (a != b) {
      std::uint32_t& later = a > b ? a : b;
      path.push_back(later);
      later = tree.parent[later];
    }
  }
  return conflicts;
}

}  // namespace

Folds split_overlaps(const Patch& patch, const Folds& folds, double tolerance) {
  Folds result = folds;
  const Layout layout = lay_out(patch, folds);
  const std::vector<OverlapFound> pairs = find_overlaps(layout, tolerance);
  for (const auto& faces : layout.faces) {
    Conflicts conflicts = find_conflicts(patch, folds, faces.front(), pairs, layout);
    const auto n = static_cast<std::uint32_t>(conflicts.tree.order.size());
    std::vector<std::uint32_t> hits(n, 0);
    for (const auto& path : conflicts.paths) {
      for (const std::uint32_t i : path) {
        ++hits[i];
      }
    }
    while (!conflicts.paths.empty()) {
      const auto better = [&](std::uint32_t a, std::uint32_t b) {
        const auto whole = [&](std::uint32_t i) {
          return patch.frozen[conflicts.tree.up[i]] == 0 && hits[i] > 0;
        };
        if (whole(a) != whole(b)) {
          return whole(a);
        }
        if (hits[a] != hits[b]) {
          return hits[a] > hits[b];
        }
        const auto smaller = [&](std::uint32_t i) {
          return std::min(conflicts.below[i], n - conflicts.below[i]);
        };
        return smaller(a) != smaller(b) ? smaller(a) > smaller(b) : a < b;
      };
      std::uint32_t best = 1;
      for (std::uint32_t i = 2; i < n; ++i) {
        if (better(i, best)) {
          best = i;
        }
      }
      set_fold(patch, result, conflicts.tree.up[best], false);
      std::erase_if(conflicts.paths, [&](const std::vector<std::uint32_t>& path) {
        if (std::find(path.begin(), path.end(), best) == path.end()) {
          return false;
        }
        for (const std::uint32_t i : path) {
          --hits[i];
        }
        return true;
      });
    }
  }
  return result;
}

}  // namespace ridgecraft::unfold
