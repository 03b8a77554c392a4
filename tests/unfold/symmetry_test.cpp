// SPDX-License-Identifier: GPL-3.0-or-later
// What lies on what when a model is mirrored or turned.
#include "unfold/pieces/symmetry.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "tests/support/concave_shapes.hpp"
#include "tests/support/shapes.hpp"
#include "tests/unfold/nets_checks.hpp"
#include "tests/unfold/tree_nets.hpp"
#include "unfold/energy/orbit.hpp"

using namespace ridgecraft;
using unfold::EdgeImages;
using unfold::Symmetry;
using unfold::Weights;

namespace {

/// Turned a little about an odd axis through the origin, as no modeller would have it.
mesh::Surface askew(const mesh::Surface& surface) {
  return test::mapped(surface, turn_about({0.0, 0.0}, {0.6, 0.8}, 0.7));
}

std::size_t count_images(const EdgeImages& images) {
  return static_cast<std::size_t>(
      std::count_if(images.edge.begin(), images.edge.end(), [](EdgeId e) { return e.valid(); }));
}

/// How often a turn brings an edge elsewhere until it is back.
std::size_t order_of(const EdgeImages& images, EdgeId edge) {
  std::size_t order = 1;
  for (EdgeId e = images.edge[edge]; e.valid() && e != edge && order < 100; e = images.edge[e]) {
    ++order;
  }
  return order;
}

}  // namespace

TEST_CASE("a turned body comes to lie on itself by the smallest turn, and back", "[symmetry]") {
  for (const int n : {3, 5, 8}) {
    const mesh::Surface body = test::revolve({{0, -0.3}, {1, 0}, {1.3, 1}, {1, 2}, {0, 3.3}}, n);
    for (const mesh::Surface& surface : {body, askew(body)}) {
      const Symmetry symmetry = unfold::find_symmetry(surface, Weights(), Context());
      INFO(n);
      REQUIRE(symmetry.plane);
      REQUIRE(symmetry.images.size() == 3);
      const auto& [mirrored, there, back] =
          std::tie(symmetry.images[0], symmetry.images[1], symmetry.images[2]);
      CHECK(count_images(there) == surface.edge_count());
      for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
        CHECK(order_of(there, e) == static_cast<std::size_t>(n));
        CHECK(back.edge[there.edge[e]] == e);
        const EdgeId image = mirrored.edge[e];
        CHECK((!image.valid() || mirrored.edge[image] == e));
      }
    }
  }
}

TEST_CASE("a turn about z is found where half turns about other axes fit as well", "[symmetry]") {
  const mesh::Surface bipyramid = test::revolve({{0, 0}, {1, 1}, {0, 2}}, 6);
  const Symmetry symmetry = unfold::find_symmetry(bipyramid, Weights(), Context());
  REQUIRE(symmetry.images.size() == 3);
  for (const EdgeId e : ids<EdgeId>(bipyramid.edge_count())) {
    CHECK(order_of(symmetry.images[1], e) == 6);
  }
}

TEST_CASE("an orbit opens folds and closes cuts, each once, and has all images of a move where all are alike",
          "[symmetry]") {
  const mesh::Surface body = test::revolve({{0, 0}, {1, 0.2}, {1.5, 1}, {1, 2}, {0, 2.1}}, 4);
  const unfold::Patch patch = test::whole_patch(body, test::no_panels(body));
  const Symmetry symmetry = unfold::find_symmetry(body, Weights(), Context());
  unfold::CutFacts facts;
  const std::vector<unfold::SideImages> images = images_of_sides(body, patch, symmetry.images);
  facts.images = images;
  unfold::CutCosts costs(patch, facts, Weights());
  const auto edge_of = [&](std::uint32_t side) { return std::min(side, patch.twin[side]); };
  std::vector<unfold::Move> orbit;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const unfold::Folds folds = test::random_tree(patch, random);
    costs.set_tree(folds);
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      const unfold::Move move =
          folds[side] != 0 ? unfold::Move{side, no_index} : unfold::Move{no_index, side};
      find_orbit(move, patch, costs, orbit);
      REQUIRE(orbit.front() == move);
      std::set<std::uint32_t> edges;
      for (const unfold::Move& each : orbit) {
        CHECK((each.opened == no_index || !costs.is_cut(each.opened)));
        CHECK((each.closed == no_index || costs.is_cut(each.closed)));
        const std::uint32_t changed = each.opened == no_index ? each.closed : each.opened;
        CHECK(edges.insert(edge_of(changed)).second);
      }
      // The edges of a whole orbit are 2, 4 or 8, or fewer where some are so already.
      CHECK(edges.size() <= 8);
    }
  }
  // All edges are folds: whatever is opened, its images are opened with it.
  costs.set_tree(unfold::Folds(patch.twin.size(), 1));
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    find_orbit({side, no_index}, patch, costs, orbit);
    CHECK((orbit.size() == 4 || orbit.size() == 8));
  }
}

TEST_CASE("a body without symmetry has no images, and none are sought where they weigh nothing",
          "[symmetry]") {
  Weights none;
  none.mirror = 0.0;
  CHECK(unfold::find_symmetry(test::revolve({{0, 0}, {1, 1}, {0, 2}}, 6), none, Context()).images.empty());
  CHECK(unfold::find_symmetry(test::random_hull(60, 3), Weights(), Context()).images.empty());
}
