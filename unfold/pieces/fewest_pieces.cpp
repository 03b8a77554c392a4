// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/fewest_pieces.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/linked_patch.hpp"
#include "unfold/patch/room.hpp"
#include "unfold/pieces/merge_pieces.hpp"
#include "unfold/pieces/overlap_split.hpp"
#include "unfold/pieces/page_split.hpp"
#include "unfold/search/heated_search.hpp"
#include "unfold/search/least_forest.hpp"
#include "unfold/search/least_trees.hpp"

namespace ridgecraft::unfold {
namespace {

/// Pairs of faces that one merge pass may compare: about 0.1 s.
constexpr std::uint64_t merge_pairs = 4'000'000;
/// Pairs that a proof may compare: about 0.5 s. Parts of 26 faces take a thousandth of it, the solid of 36
/// that has no net four times as much.
constexpr std::uint64_t proof_pairs = 10'000'000;
/// Patches of more panels have too many forests.
constexpr std::size_t most_proven_panels = 64;
/// Each number of linked trees gets this part of the trials that a single net is worth.
constexpr std::uint64_t shares_of_linked = 3;

class FewestSearch {
 public:
  FewestSearch(const Patch& patch, double tolerance, std::uint64_t seed, const Context& context)
      : patch_(patch), tolerance_(tolerance), random_(seed), context_(context) {}

  FewestPieces run(const NetFound& failed) {
    cut(failed.folds);
    prove();
    if (finished_ || context_.out_of_time()) {
      return std::move(result_);
    }
    Folds best = failed.folds;
    if (result_.proven_least == 1 && search_one(best)) {
      return std::move(result_);
    }
    search_linked(best);
    return std::move(result_);
  }

 private:
  void keep(Folds folds) {
    result_.pieces = cost_of(patch_, folds).pieces;
    result_.folds = std::move(folds);
  }

  void cut(const Folds& tree) {
    keep(merge_pieces(patch_, split_overlaps(patch_, tree, tolerance_), Room{}, tolerance_, merge_pairs,
                      context_));
  }

  void prove() {
    if (context_.out_of_time()) {
      return;
    }
    // The patch as a whole is left to the second proof, which may find the nets, too.
    const std::size_t panels = panel_count(patch_);
    const std::size_t most_of_block = std::min(most_proven_panels, panels - 1);
    result_.proven_least = least_trees(patch_, {tolerance_, most_of_block, proof_pairs}, context_);
    finished_ = result_.proven_least >= result_.pieces;
    if (finished_ || panels > most_proven_panels) {
      return;
    }
    LeastForest least = least_forest(patch_, {tolerance_, result_.pieces - 1, proof_pairs}, context_);
    result_.proven_least = std::max(result_.proven_least, least.at_least);
    finished_ = least.finished;
    if (!least.folds.empty() && is_clean(least.folds)) {
      keep(std::move(least.folds));
    }
  }

  [[nodiscard]] bool is_clean(const Folds& folds) const {
    return find_overlaps(lay_out(patch_, folds), tolerance_).empty();
  }

  /// One tree with patience. `best`: where it begins, then the best tree that it found.
  bool search_one(Folds& best) {
    const HeatedSearch options{tolerance_, heated_trials(patch_.size())};
    HeatedFound found = heated_search(patch_, best, options, random_.next(), context_);
    best = std::move(found.folds);
    if (found.overlaps > 0) {
      const std::size_t before = result_.pieces;
      FewestPieces cuts = result_;
      cut(best);
      if (result_.pieces >= before) {
        result_ = std::move(cuts);
      }
      return false;
    }
    keep(std::move(best));
    return true;
  }

  /// Fewer trees than the cuts left. More are found sooner, so the number is halved in: each that is found is
  /// the most from then on.
  void search_linked(const Folds& best) {
    const std::vector<std::uint32_t> places = places_to_part(best);
    const std::uint64_t trials = heated_trials(patch_.size()) / shares_of_linked;
    const std::size_t most_trees = std::min(places.size(), LinkedPatch::most_links) + 1;
    std::size_t least = std::max<std::size_t>(2, result_.proven_least);
    for (std::size_t most = std::min(result_.pieces, most_trees + 1);
         least < most && !context_.out_of_time();) {
      const std::size_t trees = least + (most - least) / 2;
      const std::vector<std::uint32_t> links(places.begin(),
                                             places.begin() + static_cast<std::ptrdiff_t>(trees - 1));
      const LinkedPatch linked = linked_patch(patch_, links);
      HeatedFound found = heated_search(linked.joined, best, {tolerance_, trials}, random_.next(), context_);
      for (const std::uint32_t side : links) {
        set_fold(patch_, found.folds, side, false);
      }
      if (found.overlaps == 0 && is_clean(found.folds)) {
        keep(std::move(found.folds));
        most = trees;
      } else {
        least = trees + 1;
      }
    }
  }

  /// Folds of a tree that part it where it overlaps, those that leave the most balanced trees first.
  [[nodiscard]] std::vector<std::uint32_t> places_to_part(const Folds& tree) const {
    const Folds parted = split_overlaps(patch_, tree, tolerance_);
    std::vector<std::uint32_t> place(patch_.size(), nothing);
    const RootedTree rooted = rooted_tree(patch_, tree, 0, place);
    std::vector<std::uint32_t> below(patch_.size(), 1);
    for (std::uint32_t i = patch_.size(); i-- > 1;) {
      below[rooted.parent[i]] += below[i];
    }
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 1; i < patch_.size(); ++i) {
      if (parted[rooted.up[i]] == 0 && patch_.frozen[rooted.up[i]] == 0) {
        places.push_back(i);
      }
    }
    const auto smaller = [&](std::uint32_t i) { return std::min(below[i], patch_.size() - below[i]); };
    std::stable_sort(places.begin(), places.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return smaller(i) > smaller(j); });
    for (std::uint32_t& i : places) {
      i = rooted.up[i];
    }
    return places;
  }

  const Patch& patch_;
  double tolerance_;
  Random random_;
  const Context& context_;
  FewestPieces result_;
  bool finished_ = false;  ///< the proof leaves nothing to search for
};

}  // namespace

FewestPieces fewest_pieces(const Patch& patch, const NetFound& failed, double tolerance, std::uint64_t seed,
                           const Context& context) {
  return FewestSearch(patch, tolerance, seed, context).run(failed);
}

}  // namespace ridgecraft::unfold
