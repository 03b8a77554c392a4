// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/best_pieces.hpp"

#include <cstdint>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "prepare/prepared/effort.hpp"
#include "unfold/energy/forest_search.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/pieces/symmetry.hpp"

namespace ridgecraft::unfold {
namespace {

using Faces = std::vector<std::uint32_t>;

/// Sets of faces that are searched by themselves, each ascending: what hangs together, or has an image
/// there.
std::vector<Faces> bodies_of(const NetProblem& problem, std::span<const EdgeImages> images) {
  const Patch& patch = problem.patch;
  DisjointSets sets = connected_faces(patch);
  if (!images.empty()) {
    IdVector<EdgeId, std::uint32_t> face_at(problem.surface.edge_count(), no_index);
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      face_at[edge_of(problem.surface, patch, side)] = side / 3;
    }
    for (const EdgeImages& of : images) {
      for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
        const EdgeId image = of.edge[edge_of(problem.surface, patch, side)];
        if (image.valid() && face_at[image] != no_index) {
          static_cast<void>(sets.join(side / 3, face_at[image]));
        }
      }
    }
  }
  std::vector<Faces> bodies(patch.size());
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    bodies[sets.find(f)].push_back(f);
  }
  std::erase_if(bodies, [](const Faces& faces) { return faces.empty(); });
  return bodies;
}

/// Where more of the seams lack a tab than this share of what a budget allows, the search goes on with twice
/// the price for them: some of what it counts on place_tabs doesn't find, ...
constexpr double share_of_budget = 0.5;
/// ... at most so often, ...
constexpr int most_rises = 3;
/// ... beginning with this heat, mm, and with this share of the trials, since it is near already, ...
constexpr double near_heat = 8.0;
constexpr double share_of_trials = 0.4;
/// ... with prices of shapes that rise by so much, too, or else the walk would pay with crooked nets, ...
constexpr double shape_rise = 1.25;
/// ... and no more once that has taken away less than this share of them: the rest would cost many pieces.
constexpr double least_gain = 0.1;

/// Searches on with rising prices of seams without a tab until they are few.
Folds with_enough_tabs(const ForestProblem& problem, Folds folds, SearchRules rules, const Context& context) {
  rules.first_heat = near_heat;
  rules.quick_trials = static_cast<std::uint64_t>(share_of_trials * static_cast<double>(rules.quick_trials));
  Weights weights = problem.weights;
  ForestProblem priced{problem.surface, problem.panels, problem.patch, problem.part,
                       problem.tabs,    problem.room,   weights,       problem.images};
  const double most_bare = share_of_budget * prepare::Budget().weak_share;
  Random random(context.seed);
  double bare = bare_share(priced, folds);
  for (int rise = 0; rise < most_rises && weights.bare > 0.0 && bare > most_bare && !context.out_of_time();
       ++rise) {
    weights.bare *= 2.0;
    for (double Weights::*const weight : {&Weights::mirror, &Weights::outline, &Weights::compact}) {
      weights.*weight *= shape_rise;
    }
    Folds next = search_forest(priced, folds, rules, random.next(), context);
    const double left = bare_share(priced, next);
    if (left > (1.0 - least_gain) * bare) {
      break;
    }
    bare = left;
    folds = std::move(next);
  }
  return folds;
}

/// The best forest of one body, as folds of its sub-patch.
Folds searched(const NetProblem& problem, const Folds& folds, const Faces& faces,
               std::span<const EdgeImages> images, const Context& context) {
  const Patch patch = sub_patch(problem.patch, faces);
  std::vector<std::uint32_t> part;
  for (const std::uint32_t f : faces) {
    part.push_back(problem.part[f].value());
  }
  const std::vector<SideImages> own_images = images_of_sides(problem.surface, patch, images);
  const ForestProblem own{problem.surface, problem.panels,    patch,     part, problem.options.tabs,
                          problem.room,    problem.weights(), own_images};
  SearchRules rules = rules_for(problem.options.pieces.trials_per_face, patch.size());
  rules.first_overlap_price = problem.options.pieces.first_overlap_price;
  Folds found = search_forest(own, sub_folds(problem.patch, folds, faces), rules, context.seed, context);
  return with_enough_tabs(own, std::move(found), rules, context);
}

}  // namespace

Folds best_pieces(const NetProblem& problem, const Folds& folds, std::span<const EdgeImages> images,
                  const Context& context) {
  const std::vector<Faces> bodies = bodies_of(problem, images);
  std::vector<Folds> found(bodies.size());
  do_in_parallel(
      bodies.size(), context,
      [&](std::size_t i, const Context& own) {
        // Not those of the parts (the seed) and of the trees (its complement).
        Context seeded = own;
        seeded.seed = Random::stream(~context.seed + 1, i).next();
        found[i] = own.out_of_time() ? sub_folds(problem.patch, folds, bodies[i])
                                     : searched(problem, folds, bodies[i], images, seeded);
      },
      [&](std::size_t done) {
        context.report("unfold", 0.3 + 0.5 * static_cast<double>(done) / static_cast<double>(bodies.size()));
      });
  Folds result = folds;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    put_back(problem.patch, bodies[i], found[i], result);
  }
  return result;
}

}  // namespace ridgecraft::unfold
