// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/best_pieces.hpp"

#include <cstdint>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
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
  return search_forest(own, sub_folds(problem.patch, folds, faces), rules, context.seed, context);
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
