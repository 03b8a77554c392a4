// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/overlap_split.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;

namespace {

/// A ball whose vertices are pushed in and out: its random trees overlap in many places.
Patch bumpy_patch(std::uint64_t seed, int longitudes, int latitudes) {
  const mesh::Surface ball = test::sphere(longitudes, latitudes);
  Random random(seed);
  std::vector<Vec3> points;
  for (const Vec3 p : ball.points()) {
    points.push_back((20.0 + 60.0 * random.unit()) * p);
  }
  std::vector<std::array<VertexId, 3>> vertices;
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    vertices.push_back(ball.vertices(f));
    faces.push_back(f);
  }
  const mesh::Surface bumpy(std::move(points), std::move(vertices));
  return make_patch(bumpy, test::no_panels(bumpy), faces);
}

/// The rule as it is written down: as long as a path is left, the best fold of the whole tree goes.
Folds split_by_the_book(const Patch& patch, const Folds& folds, double tolerance) {
  Folds result = folds;
  std::vector<std::uint32_t> place(patch.size(), no_index);
  const RootedTree tree = rooted_tree(patch, folds, 0, place);
  const auto n = static_cast<std::uint32_t>(tree.order.size());
  std::vector<std::uint32_t> below(n, 1);
  for (std::uint32_t i = n; i-- > 1;) {
    below[tree.parent[i]] += below[i];
  }
  std::vector<std::vector<std::uint32_t>> paths;
  for (const OverlapFound& pair : find_overlaps(lay_out(patch, folds), tolerance)) {
    std::uint32_t a = place[pair.first];
    std::uint32_t b = place[pair.second];
    std::vector<std::uint32_t>& path = paths.emplace_back();
    while (a != b) {
      std::uint32_t& later = a > b ? a : b;
      path.push_back(later);
      later = tree.parent[later];
    }
  }
  while (!paths.empty()) {
    std::vector<std::uint32_t> hits(n, 0);
    for (const auto& path : paths) {
      for (const std::uint32_t i : path) {
        ++hits[i];
      }
    }
    const auto key = [&](std::uint32_t i) {
      return std::tuple(patch.frozen[tree.up[i]] == 0 && hits[i] > 0, hits[i],
                        std::min(below[i], n - below[i]), n - i);
    };
    std::uint32_t best = 1;
    for (std::uint32_t i = 2; i < n; ++i) {
      best = key(i) > key(best) ? i : best;
    }
    set_fold(patch, result, tree.up[best], false);
    std::erase_if(paths,
                  [&](const auto& path) { return std::find(path.begin(), path.end(), best) != path.end(); });
  }
  return result;
}

}  // namespace

TEST_CASE("overlaps are split as the rule says", "[overlap_split]") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    Patch patch = bumpy_patch(seed, 18, 11);
    Random random(seed);
    const double tolerance = 1e-7 * patch.extent;
    for (const Folds& tree : {test::random_tree(patch, random), start_tree(patch, random)}) {
      CAPTURE(seed);
      const Folds split = split_overlaps(patch, tree, tolerance);
      CHECK(split == split_by_the_book(patch, tree, tolerance));
      CHECK(find_overlaps(lay_out(patch, split), tolerance).empty());
    }
    // Sides that a user wants to be folds are cut last.
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      if (random.below(3) == 0) {
        patch.frozen[side] = patch.frozen[patch.twin[side]] = 1;
      }
    }
    const Folds tree = test::random_tree(patch, random);
    CHECK(split_overlaps(patch, tree, tolerance) == split_by_the_book(patch, tree, tolerance));
  }
}

TEST_CASE("a forest is split tree by tree", "[overlap_split]") {
  const Patch patch = bumpy_patch(7, 18, 11);
  Random random(7);
  const double tolerance = 1e-7 * patch.extent;
  Folds forest = test::random_tree(patch, random);
  for (int cut = 0; cut < 5; ++cut) {
    const std::uint32_t side = random.below(3 * patch.size());
    set_fold(patch, forest, side, false);
  }
  const Folds split = split_overlaps(patch, forest, tolerance);
  CHECK(find_overlaps(lay_out(patch, split), tolerance).empty());
  for (std::size_t side = 0; side < forest.size(); ++side) {
    CHECK(split[side] <= forest[side]);
  }
}
