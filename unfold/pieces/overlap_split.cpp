// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/overlap_split.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// Two faces that overlap, as places in the tree.
struct Conflict {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t top = 0;  ///< where their paths to the root meet
};

/// A tree with what lies below each of its folds, named by the place of the lower face.
class Tree {
 public:
  Tree(const Patch& patch, const Folds& folds, std::uint32_t root, std::vector<std::uint32_t>& place)
      : tree_(rooted_tree(patch, folds, root, place)), below_(size(), 1), head_(size(), 0) {
    for (std::uint32_t i = size(); i-- > 1;) {
      below_[tree_.parent[i]] += below_[i];
    }
    std::vector<std::uint32_t> heavy(size(), 0);  // the child with most faces below it
    for (std::uint32_t i = size(); i-- > 1;) {
      std::uint32_t& child = heavy[tree_.parent[i]];
      child = child == 0 || below_[i] > below_[child] ? i : child;
    }
    for (std::uint32_t i = 1; i < size(); ++i) {
      head_[i] = heavy[tree_.parent[i]] == i ? head_[tree_.parent[i]] : i;
    }
  }

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(tree_.order.size()); }
  [[nodiscard]] std::uint32_t up(std::uint32_t i) const { return tree_.up[i]; }
  [[nodiscard]] std::uint32_t parent(std::uint32_t i) const { return tree_.parent[i]; }
  /// Faces on the smaller side of the fold at i.
  [[nodiscard]] std::uint32_t smaller(std::uint32_t i) const {
    return std::min(below_[i], size() - below_[i]);
  }
  /// Where the ways of two places to the root meet. O(log n): each chain of heavy children is one step.
  [[nodiscard]] std::uint32_t meet(std::uint32_t a, std::uint32_t b) const {
    while (head_[a] != head_[b]) {
      // Places grow from parents to children: the later head can't be above the other place.
      std::uint32_t& later = head_[a] > head_[b] ? a : b;
      later = tree_.parent[head_[later]];
    }
    return std::min(a, b);
  }

 private:
  RootedTree tree_;
  std::vector<std::uint32_t> below_;
  std::vector<std::uint32_t> head_;  ///< the top of the chain that a place is on
};

/// A connected part of a tree, with the conflicts inside it.
struct OpenPart {
  std::vector<std::uint32_t> places;  ///< ascending, so parents come first
  std::vector<Conflict> conflicts;
};

/// Cuts one tree until no conflict is left. What is cut on one side of a cut doesn't depend on the other, so
/// each side goes on by itself.
class TreeCutter {
 public:
  TreeCutter(const Patch& patch, const Tree& tree, Folds& result)
      : patch_(patch), tree_(tree), result_(result), hits_(tree.size(), 0), inside_(tree.size(), 0) {}

  /// The fold that goes first.
  [[nodiscard]] std::uint32_t first_cut(std::vector<Conflict> conflicts) {
    const OpenPart all = whole(std::move(conflicts));
    count_hits(all);
    const std::uint32_t best = best_cut(all);
    return hits_[best] > 0 && patch_.frozen[tree_.up(best)] == 0 ? tree_.up(best) : no_index;
  }

  void run(std::vector<Conflict> conflicts) {
    std::vector<OpenPart> open;
    open.push_back(whole(std::move(conflicts)));
    while (!open.empty()) {
      OpenPart branch = std::move(open.back());
      open.pop_back();
      if (!branch.conflicts.empty()) {
        count_hits(branch);
        const std::uint32_t best = best_cut(branch);
        set_fold(patch_, result_, tree_.up(best), false);
        open.push_back(taken_off(branch, best));
        open.push_back(std::move(branch));
      }
    }
  }

 private:
  [[nodiscard]] OpenPart whole(std::vector<Conflict> conflicts) const {
    OpenPart all{std::vector<std::uint32_t>(tree_.size()), std::move(conflicts)};
    std::iota(all.places.begin(), all.places.end(), 0U);
    return all;
  }

  /// How many conflicts' paths run over the fold at each place. O(size of the branch).
  void count_hits(const OpenPart& branch) {
    for (const std::uint32_t i : branch.places) {
      hits_[i] = 0;
    }
    for (const Conflict& c : branch.conflicts) {
      ++hits_[c.a];
      ++hits_[c.b];
      hits_[c.top] -= 2;
    }
    for (std::size_t k = branch.places.size(); k-- > 1;) {
      hits_[tree_.parent(branch.places[k])] += hits_[branch.places[k]];
    }
  }

  /// Whether a is the better place to cut: sides of panels come last, then the most hits count, then the most
  /// faces on the smaller side.
  [[nodiscard]] bool better(std::uint32_t a, std::uint32_t b) const {
    const auto key = [&](std::uint32_t i) {
      const bool whole = patch_.frozen[tree_.up(i)] == 0 && hits_[i] > 0;
      return std::tuple(whole, hits_[i], tree_.smaller(i));
    };
    return key(a) != key(b) ? key(a) > key(b) : a < b;
  }

  [[nodiscard]] std::uint32_t best_cut(const OpenPart& branch) const {
    std::uint32_t best = branch.places[1];
    for (std::size_t k = 2; k < branch.places.size(); ++k) {
      best = better(branch.places[k], best) ? branch.places[k] : best;
    }
    return best;
  }

  /// Takes what lies below a cut off a branch. Conflicts across the cut are none any more.
  OpenPart taken_off(OpenPart& branch, std::uint32_t cut) {
    inside_[branch.places.front()] = 0;
    for (std::size_t k = 1; k < branch.places.size(); ++k) {
      const std::uint32_t i = branch.places[k];
      inside_[i] = i == cut || inside_[tree_.parent(i)] != 0 ? 1 : 0;
    }
    OpenPart below;
    std::copy_if(branch.places.begin(), branch.places.end(), std::back_inserter(below.places),
                 [&](std::uint32_t i) { return inside_[i] != 0; });
    std::copy_if(branch.conflicts.begin(), branch.conflicts.end(), std::back_inserter(below.conflicts),
                 [&](const Conflict& c) { return inside_[c.a] != 0 && inside_[c.b] != 0; });
    std::erase_if(branch.places, [&](std::uint32_t i) { return inside_[i] != 0; });
    std::erase_if(branch.conflicts,
                  [&](const Conflict& c) { return inside_[c.a] != 0 || inside_[c.b] != 0; });
    return below;
  }

  const Patch& patch_;
  const Tree& tree_;
  Folds& result_;
  std::vector<std::uint32_t> hits_;  ///< unsigned, but only sums of them count
  std::vector<std::uint8_t> inside_;
};

/// `place`: of each face in the tree.
std::vector<Conflict> conflicts_of(const Tree& tree, const std::vector<std::uint32_t>& place,
                                   const FacePairs& pairs) {
  std::vector<Conflict> conflicts;
  for (const auto& [f, g] : pairs) {
    conflicts.push_back({place[f], place[g], tree.meet(place[f], place[g])});
  }
  return conflicts;
}

}  // namespace

Folds split_overlaps(const Patch& patch, const Folds& folds, double tolerance) {
  Folds result = folds;
  const Layout layout = lay_out(patch, folds);
  std::vector<FacePairs> pairs(layout.faces.size());
  for (const OverlapFound& pair : find_overlaps(layout, tolerance)) {
    pairs[layout.piece[pair.first]].emplace_back(pair.first, pair.second);
  }
  std::vector<std::uint32_t> place(patch.size(), no_index);
  for (std::size_t piece = 0; piece < pairs.size(); ++piece) {
    if (!pairs[piece].empty()) {
      const Tree tree(patch, folds, layout.faces[piece].front(), place);
      TreeCutter(patch, tree, result).run(conflicts_of(tree, place, pairs[piece]));
    }
  }
  return result;
}

std::uint32_t best_parting_fold(const Patch& patch, const Folds& tree, const FacePairs& pairs) {
  std::vector<std::uint32_t> place(patch.size(), no_index);
  const Tree rooted(patch, tree, 0, place);
  Folds unchanged;
  return TreeCutter(patch, rooted, unchanged).first_cut(conflicts_of(rooted, place, pairs));
}

}  // namespace ridgecraft::unfold
