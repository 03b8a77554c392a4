// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/linear_split.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/folding/free_folding.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {
namespace {

using Faces = std::vector<std::uint32_t>;

/// The fold between the most of these pairs, or nothing where only folds that have to stay are.
std::uint32_t best_cut(const Patch& piece, const Folds& tree, const FacePairs& pairs) {
  Faces place(piece.size(), nothing);
  const RootedTree rooted = rooted_tree(piece, tree, 0, place);
  std::vector<std::size_t> between(piece.size(), 0);  // per place: pairs that the fold above parts
  for (const auto& [f, g] : pairs) {
    // The later place of the two can't be above the other.
    for (std::uint32_t a = place[f], b = place[g]; a != b;) {
      std::uint32_t& later = a > b ? a : b;
      ++between[later];
      later = rooted.parent[later];
    }
  }
  std::vector<std::size_t> size(piece.size(), 1);
  for (std::size_t i = size.size(); i-- > 1;) {
    size[rooted.parent[i]] += size[i];
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < size.size(); ++i) {
    const auto smaller = [&](std::size_t k) { return std::min(size[k], piece.size() - size[k]); };
    const bool may_go = piece.frozen[rooted.up[i]] == 0 && between[i] > 0;
    if (may_go &&
        (best == 0 || std::pair(between[i], smaller(i)) > std::pair(between[best], smaller(best)))) {
      best = i;
    }
  }
  return best == 0 ? nothing : rooted.up[best];
}

/// One piece of the forest and what becomes of it.
class Splitting {
 public:
  Splitting(const Patch& piece, Folds folds, const Room& room, double tolerance, std::uint64_t seed,
            const Context& context)
      : piece_(piece),
        folds_(std::move(folds)),
        room_(room),
        tolerance_(tolerance),
        random_(seed),
        context_(context) {}

  /// Its folds, and how many pieces of them don't fold together.
  LinearSplit run() {
    std::size_t stuck = 0;
    std::vector<Faces> open = lay_out(piece_, folds_).faces;
    while (!open.empty()) {
      Faces faces = std::move(open.back());
      open.pop_back();
      std::sort(faces.begin(), faces.end());
      const Patch part = sub_patch(piece_, faces);
      Folds tree = folding_tree(part, sub_folds(piece_, folds_, faces));
      if (!folds_together(part, tree, context_)) {
        const std::uint32_t cut = cut_of(part, tree);
        if (cut == nothing) {
          ++stuck;
        } else {
          set_fold(part, tree, cut, false);
          for (const Faces& half : lay_out(part, tree).faces) {
            Faces& next = open.emplace_back();
            std::transform(half.begin(), half.end(), std::back_inserter(next),
                           [&](std::uint32_t f) { return faces[f]; });
          }
        }
      }
      put_back(piece_, faces, tree, folds_);
    }
    return {std::move(folds_), stuck};
  }

 private:
  /// A tree that folds together, or the given one.
  Folds folding_tree(const Patch& part, const Folds& tree) {
    ChangingNet net(part, tree, tolerance_);
    const std::size_t panels = panel_count(part);
    const bool fits = room_.holds(net.hull(), panels);
    const auto cut_mm = [&](ChangingNet& changed) -> std::optional<double> {
      if (fits && !room_.holds(changed.hull(), panels)) {
        return std::nullopt;
      }
      double sum = 0.0;
      for (std::size_t side = 0; side < part.length.size(); ++side) {
        sum += changed.folds()[side] == 0 ? part.length[side] : 0.0;
      }
      return sum;
    };
    fold_freely(net, cut_mm, std::numeric_limits<double>::infinity(), random_.next(), context_);
    return net.folds();
  }

  [[nodiscard]] std::uint32_t cut_of(const Patch& part, const Folds& tree) const {
    RootedNet net(part);
    net.set_tree(tree);
    FoldingMeetings meetings(part);
    meetings.count(net);
    return best_cut(part, tree, meetings.pairs());
  }

  const Patch& piece_;
  Folds folds_;
  const Room& room_;
  double tolerance_;
  Random random_;
  const Context& context_;
};

}  // namespace

LinearSplit split_to_fold_together(const Patch& patch, const Folds& folds, const Room& room, double tolerance,
                                   std::uint64_t seed, const Context& context) {
  std::vector<Faces> pieces = lay_out(patch, folds).faces;
  std::vector<LinearSplit> splits(pieces.size());
  do_in_parallel(pieces.size(), context, [&](std::size_t i, const Context& own) {
    std::sort(pieces[i].begin(), pieces[i].end());
    Random seeds(seed ^ (0x9e3779b97f4a7c15ULL * (i + 1)));
    const Patch piece = sub_patch(patch, pieces[i]);
    splits[i] =
        Splitting(piece, sub_folds(patch, folds, pieces[i]), room, tolerance, seeds.next(), own).run();
  });
  LinearSplit result{folds, 0};
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    put_back(patch, pieces[i], splits[i].folds, result.folds);
    result.stuck += splits[i].stuck;
  }
  return result;
}

}  // namespace ridgecraft::unfold
