// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/rooted_net.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "prepare/prepared/panels.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/overlap_pairs.hpp"

using namespace ridgecraft;
using test::tolerance;
using unfold::Patch;
using unfold::RootedNet;

namespace {

/// A side of a random cut, and a random fold that may be removed for it.
std::pair<std::uint32_t, std::uint32_t> draw_swap(RootedNet& net, Random& random) {
  const auto sides = static_cast<std::uint32_t>(net.folds().size());
  std::uint32_t side = random.below(sides);
  while (net.folds()[side] != 0) {
    side = random.below(sides);
  }
  const auto& path = net.removable_between(side / 3, net.patch().twin[side] / 3);
  return {path[random.below(static_cast<std::uint32_t>(path.size()))], side};
}

/// Are the faces of v's subtree those that hang together without the fold above it, at an interval of
/// positions, and do folded neighbours share their edge in the plane?
void check_shape(const RootedNet& net) {
  const Patch& patch = net.patch();
  for (std::uint32_t v = 0; v < net.size(); ++v) {
    REQUIRE(net.face_at(net.position(v)) == v);
    std::uint32_t below = 0;
    for (std::uint32_t x = 0; x < net.size(); ++x) {
      std::uint32_t up = x;
      while (up != v && net.side_above(up) != unfold::nothing) {
        up = net.parent(up);
      }
      REQUIRE(net.in_subtree(v, x) == (up == v));
      below += up == v ? 1U : 0U;
    }
    CHECK(net.smaller_half(v) == std::min(below, net.size() - below));
  }
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (net.folds()[side] != 0) {
      const std::uint32_t twin = patch.twin[side];
      const Vec2 a = net.flat(side / 3)[side % 3];
      const Vec2 b = net.flat(twin / 3)[(twin % 3 + 1) % 3];
      CHECK(length(a - b) < 1e-9);
    }
  }
}

}  // namespace

TEST_CASE("a rooted net stays one tree in the plane, whichever half a swap moves, and swaps can be undone",
          "[rooted_net]") {
  const mesh::Surface surface = test::sphere(7, 5);
  const Patch patch = test::whole_patch(surface);
  Random random(2);
  RootedNet net(patch);
  net.set_tree(unfold::start_tree(patch, unfold::StartTree::depth_first, random));
  int whole_rest = 0;
  for (int i = 0; i < 200; ++i) {
    const auto [below, side] = draw_swap(net, random);
    const auto before = net.folds();
    const std::uint32_t removed = net.side_above(below);
    whole_rest += net.moves_subtree(below) ? 0 : 1;
    const std::uint32_t moved = net.swap(below, side);
    CHECK(net.folds()[side] == 1);
    CHECK(net.folds()[removed] == 0);
    CHECK((net.side_above(moved) == side || net.side_above(moved) == patch.twin[side]));
    check_shape(net);
    if (i % 3 == 0) {
      net.swap(moved, removed);
      CHECK(net.folds() == before);
      check_shape(net);
    }
  }
  CHECK(whole_rest > 5);
}

TEST_CASE("what is near in a rooted net is found, all of it and once", "[rooted_net]") {
  const mesh::Surface surface = test::sphere(9, 6);
  const Patch patch = test::whole_patch(surface);
  Random random(4);
  RootedNet net(patch);
  net.set_tree(unfold::start_tree(patch, unfold::StartTree::short_cuts, random));
  for (int i = 0; i < 40; ++i) {
    const auto [below, side] = draw_swap(net, random);
    net.swap(below, side);
    const double reach = 0.1 * random.unit();
    // The circles are a little enlarged: what is surely near must come up, what is surely far must not.
    constexpr double rounding = 1e-4;
    const auto gap = [&](std::uint32_t f, std::uint32_t g) {
      return length(net.circle(f).centre - net.circle(g).centre) - net.circle(f).radius -
             net.circle(g).radius;
    };
    for (std::uint32_t f = 0; f < net.size(); ++f) {
      std::vector<std::uint32_t> near;
      net.visit_near(net.circle(f).centre, net.circle(f).radius + reach,
                     [&](std::uint32_t g) { near.push_back(g); });
      for (std::uint32_t g = 0; g < net.size(); ++g) {
        if (gap(f, g) < reach - rounding) {
          CHECK(std::count(near.begin(), near.end(), g) == 1);
        }
      }
    }
  }
}

TEST_CASE("what a swap would overlap is what overlaps after it", "[rooted_net]") {
  const mesh::Surface surface = test::sphere(9, 6);
  const Patch patch = test::whole_patch(surface);
  Random random(6);
  RootedNet net(patch);
  net.set_tree(unfold::start_tree(patch, unfold::StartTree::breadth_first, random));
  unfold::OverlapPairs pairs(net, tolerance);
  unfold::OverlapPairs fresh(net, tolerance);
  pairs.find_all();
  std::uint64_t most = 0;
  for (int i = 0; i < 300; ++i) {
    const auto [below, side] = draw_swap(net, random);
    const std::uint64_t kept = pairs.total() - pairs.across(below);
    const std::uint32_t made = pairs.after_swap().count(below, side, unfold::nothing);
    CHECK(pairs.after_swap().found().size() == made);
    CHECK(pairs.after_swap().is_clean(below, side) == (made == 0));
    const std::uint32_t limit = random.below(5) + 1;
    CHECK(pairs.after_swap().count(below, side, limit) == std::min(made, limit));
    pairs.swap(below, side);
    fresh.find_all();
    REQUIRE(pairs.total() == kept + made);
    REQUIRE(fresh.total() == pairs.total());
    for (std::uint32_t f = 0; f < net.size(); ++f) {
      std::vector<std::uint32_t> a = pairs.met_by(f);
      std::vector<std::uint32_t> b = fresh.met_by(f);
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      REQUIRE(a == b);
    }
    CHECK(pairs.bad_faces().size() == fresh.bad_faces().size());
    most = std::max(most, pairs.total());
  }
  CHECK(most > 5);
}
