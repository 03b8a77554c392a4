// SPDX-License-Identifier: GPL-3.0-or-later
// What cuts cost, told by the angles of the outline, against counting afresh.
#include "unfold/energy/cut_costs.hpp"

#include <numeric>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"

using namespace ridgecraft;
using unfold::CutCosts;
using unfold::Folds;
using unfold::Forest;
using unfold::Patch;

namespace {

constexpr double clearance = 0.2;

/// A lathe's work with twelve flat regions in each of its four walls, about 60 mm high.
mesh::Surface turned() {
  return test::revolve(
      {{0.0, 0.0}, {18.0, 0.0}, {25.0, 20.0}, {9.0, 35.0}, {9.0, 50.0}, {20.0, 60.0}, {0.0, 60.0}}, 12);
}

/// A sphere with dents and bumps, about 60 mm across, so that many of its edges are short of room.
mesh::Surface small_lumpy(std::uint64_t seed) {
  const mesh::Surface ball = test::sphere(14, 9);
  Random random(seed);
  std::vector<Vec3> points;
  for (const Vec3 p : ball.points()) {
    points.push_back((20.0 + 12.0 * random.unit()) * p);
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    faces.push_back(ball.vertices(f));
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

struct CostExample {
  explicit CostExample(std::uint64_t seed, std::size_t left_out = 0)
      : CostExample(small_lumpy(seed), seed, left_out) {}
  CostExample(mesh::Surface made, std::uint64_t seed, std::size_t left_out)
      : surface(std::move(made)), panels(prepare::find_panels(surface)) {
    std::vector<FaceId> faces;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      faces.push_back(f);
    }
    faces.resize(faces.size() - left_out);
    patch = unfold::make_patch(surface, panels, faces);
    targets = unfold::find_tab_targets(surface, panels, patch, {});
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      candidates.push_back(unfold::tab_candidates(targets.largest[side], patch.length[side], {}));
    }
    const unfold::NetFound net = test::net_of(patch, seed);
    REQUIRE(net.overlaps == 0);
    folds = net.folds;
  }
  /// Most edges are the mirror image of another at each of two planes, at random.
  void pair_edges(std::uint64_t seed) { images = {{pairs(seed), 1.0}, {pairs(~seed), 0.5}}; }
  [[nodiscard]] std::vector<std::uint32_t> pairs(std::uint64_t seed) const {
    std::vector<std::uint32_t> mirror(patch.twin.size(), no_index);
    Random random(seed);
    std::uint32_t open = no_index;
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      if (patch.twin[side] == no_index || patch.twin[side] < side || random.below(4) == 0) {
        continue;
      }
      if (open != no_index) {
        for (const auto& [a, b] : {std::pair(open, side), std::pair(side, open)}) {
          mirror[a] = mirror[patch.twin[a]] = b;
        }
        open = no_index;
      } else {
        open = side;
      }
    }
    return mirror;
  }
  [[nodiscard]] CutCosts costs(const unfold::Weights& weights) const {
    return {patch, {candidates, targets.across, targets.seam, clearance, images}, weights};
  }

  mesh::Surface surface;
  prepare::Panels panels;
  Patch patch;
  unfold::TabTargets targets;
  std::vector<std::vector<unfold::TabCandidate>> candidates;
  std::vector<unfold::SideImages> images;
  Folds folds;
};

}  // namespace

TEST_CASE("what a swap changes is what counting afresh shows", "[energy]") {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    // The third one is open: it has seams. The fourth is a solid of revolution.
    CostExample example = seed == 4 ? CostExample(turned(), seed, 0) : CostExample(seed, seed == 3 ? 20 : 0);
    example.pair_edges(seed);
    CutCosts costs = example.costs({});
    CutCosts fresh = example.costs({});
    Forest net(example.patch);
    net.set_folds(example.folds);
    costs.set_tree(example.folds);
    costs.weigh_images(static_cast<double>(seed));
    fresh.weigh_images(static_cast<double>(seed));
    Random random(seed);
    int kept = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const std::uint32_t side = random.below(static_cast<std::uint32_t>(example.patch.twin.size()));
      if (example.patch.twin[side] == no_index || net.folds()[side] != 0) {
        continue;
      }
      const auto path = net.folds_between(side / 3, example.patch.twin[side] / 3);
      if (path.empty()) {
        continue;
      }
      const std::uint32_t fold = pick(path, random);
      const double before = costs.total();
      const double change = costs.change(side, fold);
      if (random.unit() < 0.5) {
        costs.drop();
        REQUIRE(costs.total() == before);
        continue;
      }
      const double bare = costs.total_without_bare() + change - costs.change_of_bare();
      net.make({fold, side});
      costs.keep();
      fresh.set_tree(net.folds());
      REQUIRE(costs.total() == Approx(before + change).margin(1e-6));
      REQUIRE(costs.total() == Approx(fresh.total()).margin(1e-6));
      REQUIRE(costs.total_without_bare() == Approx(bare).margin(1e-6));
      REQUIRE(costs.total_without_bare() == Approx(fresh.total_without_bare()).margin(1e-6));
      for (std::uint32_t cut = 0; cut < example.patch.twin.size(); ++cut) {
        if (net.folds()[cut] == 0) {
          REQUIRE(costs.lacks_tab(cut) == fresh.lacks_tab(cut));
          REQUIRE(costs.is_asymmetric(cut) == fresh.is_asymmetric(cut));
        }
      }
      ++kept;
    }
    CHECK(kept > 200);
  }
}

TEST_CASE("without other weights cuts cost their length, and each weight costs something", "[energy]") {
  CostExample example(4);
  example.pair_edges(4);
  unfold::Weights alone{};
  alone.bare = alone.slits = alone.mirror = alone.open = 0.0;
  double length = 0.0;
  for (std::uint32_t side = 0; side < example.patch.twin.size(); ++side) {
    length += example.folds[side] == 0 && side < example.patch.twin[side] ? example.patch.length[side] : 0.0;
  }
  const auto total = [&](const unfold::Weights& weights) {
    CutCosts costs = example.costs(weights);
    costs.set_tree(example.folds);
    return costs.total();
  };
  CHECK(total(alone) == Approx(length));
  for (double unfold::Weights::*weight :
       {&unfold::Weights::bare, &unfold::Weights::slits, &unfold::Weights::mirror, &unfold::Weights::open}) {
    unfold::Weights more = alone;
    more.*weight = 1.0;
    CHECK(total(more) > length + 1.0);
    CHECK(total(more) <= 2.5 * length);
  }
}

TEST_CASE("mirror images that count more cost what a greater weight would", "[energy]") {
  CostExample example(4);
  example.pair_edges(4);
  unfold::Weights thrice{};
  thrice.mirror *= 3.0;
  CutCosts plain = example.costs({});
  CutCosts weighed = example.costs(thrice);
  plain.set_tree(example.folds);
  weighed.set_tree(example.folds);
  const double once = plain.total();
  CHECK(weighed.total() > once + 1.0);
  plain.weigh_images(3.0);
  CHECK(plain.total() == Approx(weighed.total()));
  plain.set_tree(example.folds);
  CHECK(plain.total() == Approx(weighed.total()));
  plain.weigh_images(1.0);
  CHECK(plain.total() == Approx(once));
}
