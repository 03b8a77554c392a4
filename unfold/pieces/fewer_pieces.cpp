// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/fewer_pieces.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "unfold/energy/forest_search.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/patch_nets.hpp"
#include "unfold/pieces/piece_borders.hpp"
#include "unfold/search/heated_search.hpp"
#include "unfold/search/least_forest.hpp"

namespace ridgecraft::unfold {
namespace {

/// Swaps for each face of pieces that are searched for a net, and of such as don't fit yet.
constexpr std::uint64_t heat_per_face = 1200;
constexpr double fit_per_face = 1500.0;
/// Larger unions take too long.
constexpr std::size_t most_faces_of_union = 600;
/// What a proof that a union needs as many pieces may take: pairs of faces, panels of a block.
constexpr std::uint64_t union_proof_pairs = 500'000;
constexpr std::size_t most_panels_of_union = 30;

/// A few pieces as one patch. The first of them is to be joined to another one.
struct PiecesTogether {
  std::vector<std::uint32_t> faces;  ///< of the whole, ascending
  Patch patch;
  Folds apart;
  std::size_t trees = 0;    ///< that it has
  std::uint32_t first = 0;  ///< one of the first piece's faces, of the patch
};

/// Sides over which trees meet, long ones first, as many as make one tree of them; beside those that `joint`
/// joins already.
std::vector<std::uint32_t> links_between(const Patch& patch, const Layout& layout, std::uint32_t joint) {
  DisjointSets sets(layout.faces.size());
  const auto join = [&](std::uint32_t side) {
    return sets.join(layout.piece[side / 3], layout.piece[patch.twin[side] / 3]);
  };
  if (joint != nothing) {
    static_cast<void>(join(joint));
  }
  std::vector<std::uint32_t> links;
  for (const std::uint32_t side : borders_of_trees(patch, layout.piece)) {
    if (join(side)) {
      links.push_back(side);
    }
  }
  return links;
}

/// The longest side at which the first piece meets another one, or nothing.
std::uint32_t joint_of(const PiecesTogether& all, const Layout& layout) {
  const std::uint32_t first = layout.piece[all.first];
  for (const std::uint32_t side : borders_of_trees(all.patch, layout.piece)) {
    if (layout.piece[side / 3] == first || layout.piece[all.patch.twin[side] / 3] == first) {
      return side;
    }
  }
  return nothing;
}

void set_folds(const Patch& patch, Folds& folds, const std::vector<std::uint32_t>& sides, bool folded) {
  for (const std::uint32_t side : sides) {
    set_fold(patch, folds, side, folded);
  }
}

/// These pieces of a forest of the whole; the first of them comes first. `layout`: of the forest.
PiecesTogether pieces_together(const Patch& whole, const Folds& folds, const Layout& layout,
                               std::span<const std::uint32_t> pieces) {
  PiecesTogether all;
  for (const std::uint32_t p : pieces) {
    all.faces.insert(all.faces.end(), layout.faces[p].begin(), layout.faces[p].end());
  }
  std::sort(all.faces.begin(), all.faces.end());
  all.patch = sub_patch(whole, all.faces);
  all.apart = sub_folds(whole, folds, all.faces);
  all.trees = pieces.size();
  const std::uint32_t f = layout.faces[pieces.front()].front();
  all.first =
      static_cast<std::uint32_t>(std::lower_bound(all.faces.begin(), all.faces.end(), f) - all.faces.begin());
  return all;
}

/// Searches with a budget for all of them: about a second for trees, and one for the room.
class TreesTogether {
 public:
  /// All must outlive this.
  TreesTogether(const NetProblem& problem, const Context& context);

  /// Clean trees that fit the room, one fewer than they are: linked trees are searched for a net by heat
  /// (heated_search.hpp) and, where they don't fit the room, for borders at which they do
  /// (energy/forest_search.hpp). What is proven to need as many (least_forest.hpp) isn't tried. Throws
  /// Error(interrupted).
  [[nodiscard]] std::optional<Folds> one_fewer(const PiecesTogether& pieces);

 private:
  [[nodiscard]] std::optional<Folds> allowed(const Patch& patch, Folds forest) const;
  [[nodiscard]] Folds fitted(const Patch& patch, const Folds& forest);

  static constexpr std::uint64_t heat_budget = 400'000;
  static constexpr std::uint64_t fit_budget = 400'000;

  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const Options& options_;
  const Room& room_;
  const Context& context_;
  double tolerance_;
  Random random_;
  std::uint64_t heat_work_ = heat_budget;
  std::uint64_t fit_work_ = fit_budget;
};

TreesTogether::TreesTogether(const NetProblem& problem, const Context& context)
    : surface_(problem.surface),
      panels_(problem.panels),
      options_(problem.options),
      room_(problem.room),
      context_(context),
      tolerance_(problem.tolerance()),
      random_(context.seed) {}

std::optional<Folds> TreesTogether::one_fewer(const PiecesTogether& all) {
  const std::size_t wanted = all.trees - 1;
  if (wanted > most_links || all.faces.size() > most_faces_of_union ||
      least_pieces(all.patch, room_) > wanted ||
      least_trees(all.patch, {tolerance_, most_panels_of_union, union_proof_pairs}, context_) > wanted) {
    return std::nullopt;
  }
  const Layout layout = lay_out(all.patch, all.apart);
  const std::uint32_t joint = joint_of(all, layout);
  const std::vector<std::uint32_t> links = links_between(all.patch, layout, joint);
  if (joint == nothing || links.size() + 1 != wanted) {
    return std::nullopt;  // the pieces don't hang together
  }
  const Patch linked = linked_patch(all.patch, links);
  Folds tree = all.apart;
  set_fold(all.patch, tree, joint, true);
  set_folds(all.patch, tree, links, true);
  const std::uint64_t trials = std::min<std::uint64_t>(heat_per_face * all.patch.size(), heat_work_);
  const HeatedFound found = heated_search(linked, tree, {tolerance_, trials}, random_.next(), context_);
  heat_work_ -= std::min(heat_work_, found.trials);
  if (found.overlaps > 0) {
    return std::nullopt;
  }
  Folds apart = found.folds;
  set_folds(all.patch, apart, links, false);
  std::optional<Folds> forest = allowed(all.patch, apart);
  // Of two that don't fit as one nothing can be handed to others.
  return forest || all.trees == 2 ? forest : allowed(all.patch, fitted(all.patch, apart));
}

/// The forest, if none of its trees overlaps or doesn't fit.
std::optional<Folds> TreesTogether::allowed(const Patch& patch, Folds forest) const {
  const bool good =
      all_fit(patch, forest, room_) && find_overlaps(lay_out(patch, forest), tolerance_).empty();
  return good ? std::optional(std::move(forest)) : std::nullopt;
}

/// As many trees brought to less cost, of which what is too large is most.
Folds TreesTogether::fitted(const Patch& patch, const Folds& forest) {
  SearchRules rules = rules_for(fit_per_face, patch.size());
  rules.quick_trials = std::min(rules.quick_trials, fit_work_);
  rules.exact_trials = 0;
  rules.pieces_change = false;
  rules.until_it_fits = true;
  fit_work_ -= rules.quick_trials;
  TabOptions no_tabs = options_.tabs;
  no_tabs.wanted = false;
  const ForestProblem own{surface_, panels_, patch, {}, no_tabs, room_, options_.pieces.weights};
  return search_forest(own, forest, rules, random_.next(), context_);
}

using Faces = std::vector<std::uint32_t>;

/// The connected sets of faces, each ascending.
std::vector<Faces> bodies_of(const Patch& patch) {
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != nothing) {
      sets.join(side / 3, patch.twin[side] / 3);
    }
  }
  std::vector<Faces> bodies(patch.size());
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    bodies[sets.find(f)].push_back(f);
  }
  std::erase_if(bodies, [](const Faces& faces) { return faces.empty(); });
  return bodies;
}

/// One body and its forest.
class Body {
 public:
  Body(Patch patch, Folds folds, const Room& room)
      : patch_(std::move(patch)), folds_(std::move(folds)), room_(room), least_(least_pieces(patch_, room)) {}

  [[nodiscard]] const Folds& folds() const { return folds_; }

  /// All of it as one part.
  void unfold_as_one(PanelCuts cuts, std::uint64_t seed, const Context& context) {
    if (pieces() > least_) {
      take_if_fewer(
          unfold_patch(patch_, room_, cuts, net_tolerance(patch_.extent), seed, Effort::full, context).folds);
    }
  }

  /// A few of its pieces one fewer; false where none can be saved. `failed`: what was tried in vain, by
  /// faces.
  bool save_a_piece(TreesTogether& trees, std::set<Faces>& failed, const Context& context) {
    if (pieces() <= least_) {
      return false;
    }
    const Layout layout = lay_out(patch_, folds_);
    for (const std::vector<std::uint32_t>& together : unions(layout)) {
      context.check();
      if (context.out_of_time()) {
        return false;
      }
      const PiecesTogether all = pieces_together(patch_, folds_, layout, together);
      if (failed.contains(all.faces)) {
        continue;
      }
      if (const std::optional<Folds> fewer = trees.one_fewer(all)) {
        put_back(patch_, all.faces, *fewer, folds_);
        return true;
      }
      failed.insert(all.faces);
    }
    return false;
  }

 private:
  [[nodiscard]] std::size_t pieces() const { return lay_out(patch_, folds_).faces.size(); }

  void take_if_fewer(Folds folds) {
    if (lay_out(patch_, folds).faces.size() < pieces() && all_fit(patch_, folds, room_)) {
      folds_ = std::move(folds);
    }
  }

  /// Sets of pieces, each beginning with the one that joins another: pairs, threes, all.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> unions(const Layout& layout) const {
    const std::vector<PieceBorder> borders = piece_borders(patch_, layout.piece);
    std::vector<std::vector<std::uint32_t>> sets;
    for (const PieceBorder& border : borders) {
      sets.push_back({border.a, border.b});
    }
    for (const PieceBorder& border : borders) {
      for (const PieceBorder& next : borders) {
        for (const auto& [at, beyond] : {std::pair(next.a, next.b), std::pair(next.b, next.a)}) {
          if ((at == border.a || at == border.b) && beyond != border.a && beyond != border.b) {
            sets.push_back({border.a, border.b, beyond});
          }
        }
      }
    }
    if (layout.faces.size() > 3) {
      std::vector<std::uint32_t>& all = sets.emplace_back();
      for (std::uint32_t p = 0; p < layout.faces.size(); ++p) {
        all.push_back(p);
      }
    }
    return sets;
  }

  Patch patch_;
  Folds folds_;
  const Room& room_;
  std::size_t least_;  ///< pieces that no arrangement can do without
};

}  // namespace

Folds fewer_pieces(const NetProblem& problem, const Folds& folds, const Context& context) {
  const Patch& patch = problem.patch;
  Folds result = folds;
  Random random(context.seed);
  TreesTogether trees(problem, context);
  for (const Faces& faces : bodies_of(patch)) {
    if (context.out_of_time()) {
      break;
    }
    Body body(sub_patch(patch, faces), sub_folds(patch, result, faces), problem.room);
    body.unfold_as_one(problem.options.panel_cuts, random.next(), context);
    std::set<Faces> failed;
    while (body.save_a_piece(trees, failed, context)) {
    }
    put_back(patch, faces, body.folds(), result);
  }
  return result;
}

}  // namespace ridgecraft::unfold
