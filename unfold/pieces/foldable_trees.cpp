// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/foldable_trees.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "unfold/energy/forest_search.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/symmetry.hpp"
#include "unfold/search/free_folding.hpp"

namespace ridgecraft::unfold {
namespace {

/// What a piece that folds freely may cost more, mm of seam (net/options.hpp).
constexpr double worth_of_free_folding_mm = 300.0;
/// From a tree that folds freely a better one is searched for by a share of the trials that the first search
/// had, beginning with this heat, mm: it is near already.
constexpr double trials_again = 0.16;
constexpr double first_heat = 8.0;

/// Folds of one piece that fold up with all creases together, where that is worth it; else those it has.
Folds improved(const NetProblem& problem, const Folds& folds, std::span<const EdgeImages> images_of_edges,
               const std::vector<std::uint32_t>& faces, const Context& context) {
  Random random(context.seed);
  const Patch piece = sub_patch(problem.patch, faces);
  Folds given = sub_folds(problem.patch, folds, faces);
  if (folds_together(piece, given, context)) {
    return given;
  }
  const std::vector<SideImages> images = images_of_sides(problem.surface, piece, images_of_edges);
  const ForestProblem own{problem.surface, problem.panels,    piece, {}, problem.options.tabs,
                          problem.room,    problem.weights(), images};
  const auto cost = [&](const Folds& tree) { return exact_cost(own, tree); };
  const double infinite = std::numeric_limits<double>::infinity();
  const double tolerance = net_tolerance(piece.extent);
  const bool at_any_price = problem.options.pieces.fold_linear;
  const std::optional<Folds> free =
      fold_freely(piece, given, {tolerance, cost, infinite}, random.next(), context);
  if (!free && !at_any_price) {
    return given;
  }
  const Folds& start = free ? *free : given;
  SearchRules rules = rules_for(trials_again * problem.options.pieces.trials_per_face, piece.size());
  rules.first_heat = first_heat;
  rules.folds_together = true;
  Folds better = search_forest(own, start, rules, random.next(), context);
  if (!folds_together(piece, better, context)) {
    better = start;
  }
  const double worth = at_any_price ? infinite : worth_of_free_folding_mm;
  return cost(better).value_or(infinite) <= cost(given).value_or(infinite) + worth ? better : given;
}

/// An earlier piece that is a piece's image, faces and folds.
struct ImageOfPiece {
  std::size_t piece = 0;
  const EdgeImages* at = nullptr;  ///< where there is one
};

std::vector<ImageOfPiece> images_of_pieces(const mesh::Surface& surface, const Patch& patch,
                                           const Folds& folds,
                                           const std::vector<std::vector<std::uint32_t>>& pieces,
                                           std::span<const EdgeImages> images) {
  std::vector<ImageOfPiece> result(pieces.size());
  IdVector<EdgeId, std::size_t> folded_in(surface.edge_count(), pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const std::uint32_t f : pieces[i]) {
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (folds[side] != 0) {
          folded_in[edge_of(surface, patch, side)] = i;
        }
      }
    }
  }
  const auto where_image_is = [&](std::size_t i, const EdgeImages& at) {
    for (const std::uint32_t f : pieces[i]) {
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (folds[side] != 0 && at.edge[edge_of(surface, patch, side)].valid()) {
          return folded_in[at.edge[edge_of(surface, patch, side)]];
        }
      }
    }
    return i;
  };
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const EdgeImages& at : images) {
      const std::size_t other = where_image_is(i, at);
      if (other < i && pieces[other].size() == pieces[i].size() &&
          carried_over(surface, sub_patch(patch, pieces[other]), sub_folds(patch, folds, pieces[other]),
                       sub_patch(patch, pieces[i]), at.edge)) {
        result[i] = {other, &at};
        break;
      }
    }
  }
  return result;
}

}  // namespace

Folds foldable_trees(const NetProblem& problem, const Folds& folds, std::span<const EdgeImages> images,
                     const Context& context) {
  const mesh::Surface& surface = problem.surface;
  const Patch& patch = problem.patch;
  std::vector<std::vector<std::uint32_t>> pieces = lay_out(patch, folds).faces;
  for (std::vector<std::uint32_t>& faces : pieces) {
    std::sort(faces.begin(), faces.end());
  }
  const std::vector<ImageOfPiece> image = images_of_pieces(surface, patch, folds, pieces, images);
  std::vector<Folds> trees(pieces.size());
  const auto improve = [&](std::size_t i, Context own) {
    // Parts were unfolded with the streams of the seed itself.
    own.seed = Random::stream(~context.seed, i).next();
    trees[i] = own.out_of_grace() ? sub_folds(patch, folds, pieces[i])
                                  : improved(problem, folds, images, pieces[i], own);
  };
  do_in_parallel(
      pieces.size(), context,
      [&](std::size_t i, const Context& own) {
        if (image[i].at == nullptr) {
          improve(i, own);
        }
      },
      [&](std::size_t done) {
        context.report("unfold", 0.8 + 0.2 * static_cast<double>(done) / static_cast<double>(pieces.size()));
      });
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (image[i].at == nullptr) {
      continue;
    }
    const Patch own = sub_patch(patch, pieces[i]);
    const std::optional<Folds> tree = carried_over(surface, sub_patch(patch, pieces[image[i].piece]),
                                                   trees[image[i].piece], own, image[i].at->edge);
    // The image may be off by what the eye doesn't see, but a net may not.
    if (tree && all_fit(own, *tree, problem.room) &&
        find_overlaps(lay_out(own, *tree), net_tolerance(own.extent)).empty()) {
      trees[i] = *tree;
    } else {
      improve(i, context);
    }
  }
  Folds result = folds;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    put_back(patch, pieces[i], trees[i], result);
  }
  return result;
}

}  // namespace ridgecraft::unfold
