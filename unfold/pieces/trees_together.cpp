// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/trees_together.hpp"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "unfold/energy/anneal.hpp"
#include "unfold/energy/net_energy.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/search/heated_search.hpp"
#include "unfold/search/least_trees.hpp"

namespace ridgecraft::unfold {
namespace {

/// Swaps for each face of pieces that are searched for a net, of such as don't fit yet, and of such as are
/// compared.
constexpr std::uint64_t heat_per_face = 1200;
constexpr double fit_per_face = 1500.0;
constexpr double settle_per_face = 200.0;
/// Larger unions take too long.
constexpr std::size_t most_faces_of_union = 600;
/// What a proof that a union needs as many pieces may take: pairs of faces, panels of a block.
constexpr std::uint64_t union_proof_pairs = 500'000;
constexpr std::size_t most_panels_of_union = 30;

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

}  // namespace

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
  if (wanted > LinkedPatch::most_links || all.faces.size() > most_faces_of_union ||
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
  const LinkedPatch linked = linked_patch(all.patch, links);
  Folds tree = all.apart;
  set_fold(all.patch, tree, joint, true);
  set_folds(all.patch, tree, links, true);
  const std::uint64_t trials = std::min<std::uint64_t>(heat_per_face * all.patch.size(), heat_work_);
  const HeatedFound found =
      heated_search(linked.joined, tree, {tolerance_, trials}, random_.next(), context_);
  heat_work_ -= std::min(heat_work_, found.trials);
  if (found.overlaps > 0) {
    return std::nullopt;
  }
  std::optional<Folds> forest = parted(all.patch, found.folds, links);
  // Of two that don't fit as one nothing can be handed to others.
  return forest || all.trees == 2 ? forest : parted(all.patch, fitted(linked, found.folds), links);
}

/// The trees that links hold together; nothing where one overlaps or doesn't fit.
std::optional<Folds> TreesTogether::parted(const Patch& patch, Folds tree,
                                           const std::vector<std::uint32_t>& links) const {
  set_folds(patch, tree, links, false);
  const bool good = all_fit(patch, tree, room_) && find_overlaps(lay_out(patch, tree), tolerance_).empty();
  return good ? std::optional(std::move(tree)) : std::nullopt;
}

/// The same trees brought to less energy, of which what is too large is most.
Folds TreesTogether::fitted(const LinkedPatch& linked, const Folds& tree) {
  Annealing rules = annealing_for(fit_per_face, linked.joined.size());
  rules.quick_trials = std::min(rules.quick_trials, fit_work_);
  rules.exact_trials = 0;
  rules.until_it_fits = true;
  if (rules.quick_trials == 0) {
    return tree;
  }
  fit_work_ -= rules.quick_trials;
  TabOptions no_tabs = options_.tabs;
  no_tabs.wanted = false;
  ChangingNet net(surface_, panels_, linked.apart, linked.joined, tree, no_tabs, tolerance_);
  const CutFacts facts = cut_facts(net, no_tabs);
  anneal(net, facts, room_, options_.pieces.weights, rules, random_.next(), context_);
  return net.folds();
}

SettledTrees TreesTogether::settled(const Patch& patch, const Folds& forest) {
  const std::vector<std::uint32_t> links = links_between(patch, lay_out(patch, forest), nothing);
  const LinkedPatch linked = linked_patch(patch, links);
  Folds tree = forest;
  set_folds(patch, tree, links, true);
  Annealing rules = annealing_for(settle_per_face, patch.size());
  rules.exact_trials = 0;
  ChangingNet net(surface_, panels_, linked.apart, linked.joined, tree, options_.tabs, tolerance_);
  const CutFacts facts = cut_facts(net, options_.tabs);
  anneal(net, facts, room_, options_.pieces.weights, rules, random_.next(), context_);
  Folds folds = net.folds();
  set_folds(patch, folds, links, false);
  const NetEnergy linked_energy(net.patch(), net.tree(), facts, room_, options_.pieces.weights);
  const double energy = linked_energy.shape_cost() + cost_of_cuts(patch, folds, net);
  return {std::move(folds), energy};
}

/// What the cuts of a forest cost, links among them: those are no cuts to the energy of linked trees, and
/// forests of more trees have more of them.
double TreesTogether::cost_of_cuts(const Patch& patch, const Folds& forest, ChangingNet& net) const {
  CutFacts facts;
  std::optional<TabState> tabs;
  if (options_.tabs.wanted) {
    tabs.emplace(surface_, panels_, patch, net.tree(), options_.tabs);
    facts = cut_facts(*tabs, options_.tabs);
  }
  CutCosts costs(patch, facts, options_.pieces.weights);
  costs.set_tree(forest);
  return costs.total();
}

}  // namespace ridgecraft::unfold
