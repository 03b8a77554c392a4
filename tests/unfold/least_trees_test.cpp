// SPDX-License-Identifier: GPL-3.0-or-later
// A number of nets that is told as the least is no more than that.
#include <algorithm>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "bench/spiky_bodies.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/least_forest.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;
using test::grown;
using test::tolerance;

namespace {

Patch patch_of(const mesh::Surface& s, const prepare::Panels& panels) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    faces.push_back(f);
  }
  return make_patch(s, panels, faces);
}

std::size_t least_by_blocks(const Patch& patch) {
  return least_trees(patch, {tolerance, 40, 10'000'000}, {});
}

std::size_t least_by_forests(const Patch& patch) {
  const LeastForest least = least_forest(patch, {tolerance, patch.size(), 50'000'000}, {});
  REQUIRE(least.finished);
  return least.at_least;
}

/// A plate of so many cells by as many with columns of `height` cells on some of them.
mesh::Surface columns(int cells, const std::vector<std::array<int, 2>>& places, int height) {
  std::vector<std::array<int, 3>> all;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      all.push_back({i, j, 0});
    }
  }
  for (const auto& [i, j] : places) {
    for (int k = 1; k <= height; ++k) {
      all.push_back({i, j, k});
    }
  }
  return test::voxels(all, 1);
}

}  // namespace

TEST_CASE("columns on a plate are nets of their own, each", "[proof][slow]") {
  // The plate's top has a hole under each, and no wall that is higher than the hole is wide fits into it.
  for (const int height : {1, 3}) {
    for (const std::size_t count : {1U, 2U, 3U}) {
      const std::vector<std::array<int, 2>> places{{1, 1}, {1, 4}, {4, 2}};
      const mesh::Surface s =
          columns(6, {places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count)}, height);
      const Patch patch = patch_of(s, prepare::find_panels(s));
      INFO(count << " columns, " << height << " high");
      CHECK(least_by_blocks(patch) == 1 + count);
      CHECK(least_by_forests(patch) == 1 + count);
    }
  }
}

TEST_CASE("what blocks tell is never more than all forests do", "[proof]") {
  Random random(3);
  for (const mesh::Surface& s : {bench::spiky_ball(1, 64, 8.0, 1), bench::spiky_box(1, 1, 2, 20, 8.0, 2),
                                 columns(5, {{1, 1}, {1, 3}}, 2),
                                 test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}}, 1)}) {
    for (const prepare::Panels& panels : {test::no_panels(s), prepare::find_panels(s)}) {
      const Patch whole = patch_of(s, panels);
      for (int i = 0; i < 6; ++i) {
        const std::size_t size = std::min<std::size_t>(whole.size(), 6 + random.below(14));
        const Patch patch = sub_patch(whole, grown(whole, size, random));
        CHECK(least_by_blocks(patch) <= least_by_forests(patch));
      }
    }
  }
}
