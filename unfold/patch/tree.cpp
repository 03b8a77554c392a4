// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/tree.hpp"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/random.hpp"

namespace ridgecraft::unfold {

RootedTree rooted_tree(const Patch& patch, const Folds& folds, std::uint32_t root,
                       std::vector<std::uint32_t>& place) {
  RootedTree tree;
  tree.order.push_back(root);
  tree.up.push_back(no_index);
  tree.parent.push_back(no_index);
  place[root] = 0;
  for (std::uint32_t i = 0; i < tree.order.size(); ++i) {
    const std::uint32_t f = tree.order[i];
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (folds[side] == 0 || side == tree.up[i]) {
        continue;
      }
      const std::uint32_t twin = patch.twin[side];
      if (const std::uint32_t at = place[twin / 3]; at < tree.order.size() && tree.order[at] == twin / 3) {
        throw Error(ErrorKind::internal, "the folds of a piece close a circle");
      }
      place[twin / 3] = static_cast<std::uint32_t>(tree.order.size());
      tree.order.push_back(twin / 3);
      tree.up.push_back(twin);
      tree.parent.push_back(i);
    }
  }
  return tree;
}

namespace {

void fold_side(const Patch& patch, Folds& folds, std::uint32_t side) {
  folds[side] = 1;
  folds[patch.twin[side]] = 1;
}

/// Panels as nodes: each a set of faces that frozen folds hold together.
struct Groups {
  std::vector<std::uint32_t> of;                  ///< per face
  std::vector<std::vector<std::uint32_t>> sides;  ///< per group: sides that lead out of it
};

Groups find_groups(const Patch& patch, DisjointSets& sets, Random& random) {
  Groups groups;
  groups.of.assign(patch.size(), no_index);
  std::vector<std::uint32_t> number(patch.size(), no_index);
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    const std::uint32_t set = sets.find(f);
    if (number[set] == no_index) {
      number[set] = static_cast<std::uint32_t>(groups.sides.size());
      groups.sides.emplace_back();
    }
    groups.of[f] = number[set];
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (patch.twin[side] != no_index && patch.frozen[side] == 0) {
        groups.sides[number[set]].push_back(side);
      }
    }
  }
  for (auto& sides : groups.sides) {
    shuffle(sides, random);
  }
  return groups;
}

/// Traverses the groups from a random one: the newest reached first, or the oldest.
void traverse(const Patch& patch, Folds& folds, const Groups& groups, bool depth_first, Random& random) {
  const auto count = static_cast<std::uint32_t>(groups.sides.size());
  std::vector<std::uint8_t> reached(count, 0);
  std::vector<std::uint32_t> cursor(count, 0);
  std::vector<std::uint32_t> open{random.below(count)};
  reached[open[0]] = 1;
  std::size_t head = 0;
  while (head < open.size()) {
    const std::uint32_t group = depth_first ? open.back() : open[head];
    const auto& sides = groups.sides[group];
    if (cursor[group] == sides.size()) {
      if (depth_first) {
        open.pop_back();
      } else {
        ++head;
      }
      continue;
    }
    const std::uint32_t side = sides[cursor[group]++];
    const std::uint32_t next = groups.of[patch.twin[side] / 3];
    if (reached[next] == 0) {
      reached[next] = 1;
      fold_side(patch, folds, side);
      open.push_back(next);
    }
  }
}

/// Kruskal's tree; ties in random order.
void by_weight(const Patch& patch, Folds& folds, DisjointSets& sets, bool by_length, Random& random) {
  std::vector<std::uint32_t> sides;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != no_index && side < patch.twin[side] && patch.frozen[side] == 0) {
      sides.push_back(side);
    }
  }
  shuffle(sides, random);
  const auto weight = [&](std::uint32_t side) {
    return by_length ? -patch.length[side] : std::abs(patch.fold_angle[side]);
  };
  std::stable_sort(sides.begin(), sides.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return weight(a) < weight(b); });
  for (const std::uint32_t side : sides) {
    if (sets.join(side / 3, patch.twin[side] / 3)) {
      fold_side(patch, folds, side);
    }
  }
}

}  // namespace

Folds start_tree(const Patch& patch, StartTree kind, Random& random) {
  Folds folds(patch.twin.size(), 0);
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.frozen[side] != 0 && sets.join(side / 3, patch.twin[side] / 3)) {
      fold_side(patch, folds, side);
    }
  }
  if (kind == StartTree::short_cuts || kind == StartTree::flat_folds) {
    by_weight(patch, folds, sets, kind == StartTree::short_cuts, random);
  } else {
    traverse(patch, folds, find_groups(patch, sets, random), kind == StartTree::depth_first, random);
  }
  return folds;
}

}  // namespace ridgecraft::unfold
