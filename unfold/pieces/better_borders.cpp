// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/better_borders.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/energy/anneal.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/mirror_images.hpp"

namespace ridgecraft::unfold {
namespace {

/// Where the search begins near the best, mm: walls that go round stay strips at this heat.
constexpr double heat_nearby = 8.0;

/// Pieces that are searched together, and the sides that link them.
struct Group {
  std::vector<std::uint32_t> faces;  ///< ascending
  std::vector<std::uint32_t> links;  ///< sides of the whole patch, one of each
};

/// Pieces that meet, longest borders first, as long as no group has more links than one may.
std::vector<Group> groups_of(const Patch& patch, const Layout& layout) {
  DisjointSets sets(layout.faces.size());
  std::vector<std::size_t> links(layout.faces.size(), 0);  // of each set, at its first
  std::vector<std::uint32_t> chosen;
  for (const std::uint32_t side : borders_of_trees(patch, layout.piece)) {
    const std::uint32_t a = sets.find(layout.piece[side / 3]);
    const std::uint32_t b = sets.find(layout.piece[patch.twin[side] / 3]);
    if (a == b || links[a] + links[b] + 1 > LinkedPatch::most_links) {
      continue;
    }
    const std::size_t all = links[a] + links[b] + 1;
    static_cast<void>(sets.join(a, b));
    links[sets.find(a)] = all;
    chosen.push_back(side);
  }
  std::vector<Group> groups(layout.faces.size());
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    groups[sets.find(layout.piece[f])].faces.push_back(f);
  }
  for (const std::uint32_t side : chosen) {
    groups[sets.find(layout.piece[side / 3])].links.push_back(side);
  }
  std::erase_if(groups, [](const Group& group) { return group.faces.empty(); });
  return groups;
}

struct Rules {
  const IdVector<EdgeId, EdgeId>& mirrored;
  Start start = Start::anywhere;
};

/// The trees of one group with less energy, as folds of its sub-patch.
Folds searched(const NetProblem& problem, const Folds& folds, const Group& group, const Rules& rules,
               const Context& context) {
  const mesh::Surface& surface = problem.surface;
  const TabOptions& tabs = problem.options.tabs;
  const Patch patch = sub_patch(problem.patch, group.faces);
  Folds tree = sub_folds(problem.patch, folds, group.faces);
  std::vector<std::uint32_t> links;
  for (const std::uint32_t side : group.links) {
    const auto at = std::lower_bound(group.faces.begin(), group.faces.end(), side / 3);
    links.push_back(3 * static_cast<std::uint32_t>(at - group.faces.begin()) + side % 3);
  }
  const LinkedPatch linked = linked_patch(patch, links);
  const Folds apart = tree;
  for (const std::uint32_t side : links) {
    set_fold(patch, tree, side, true);
  }
  ChangingNet net(surface, problem.panels, linked.apart, linked.joined, tree, tabs,
                  net_tolerance(patch.extent));
  CutFacts facts = cut_facts(net, tabs);
  const std::vector<std::uint32_t> mirror = mirror_sides(surface, linked.apart, rules.mirrored);
  facts.mirror = mirror;
  // A link stays a cut, so that its image had better be one.
  const std::vector<std::int8_t> images_of_links =
      images_outside(surface, linked.apart, rules.mirrored, edges_in_forest(surface, patch, apart));
  facts.image_outside = images_of_links;
  Annealing annealing = annealing_for(problem.options.pieces.trials_per_face, patch.size());
  if (rules.start == Start::near) {
    annealing.first_heat = heat_nearby;
  }
  anneal(net, facts, problem.room, problem.weights(), annealing, context.seed, context);
  tree = net.folds();
  for (const std::uint32_t side : links) {
    set_fold(patch, tree, side, false);
  }
  return tree;
}

}  // namespace

Folds better_borders(const NetProblem& problem, const Folds& folds, const IdVector<EdgeId, EdgeId>& mirrored,
                     Start start, const Context& context) {
  const Patch& patch = problem.patch;
  const std::vector<Group> groups = groups_of(patch, lay_out(patch, folds));
  std::vector<Folds> trees(groups.size());
  do_in_parallel(
      groups.size(), context,
      [&](std::size_t i, const Context& own) {
        if (own.out_of_time()) {
          trees[i] = sub_folds(patch, folds, groups[i].faces);
          return;
        }
        // Beside those of the parts (the seed) and of the trees (its complement).
        Context seeded = own;
        seeded.seed = Random::stream(~context.seed + 1, i).next();
        trees[i] = searched(problem, folds, groups[i], {mirrored, start}, seeded);
      },
      [&](std::size_t done) {
        context.report("unfold", 0.8 + 0.1 * static_cast<double>(done) / static_cast<double>(groups.size()));
      });
  Folds result = folds;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    put_back(patch, groups[i].faces, trees[i], result);
  }
  return result;
}

}  // namespace ridgecraft::unfold
