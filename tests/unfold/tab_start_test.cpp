// SPDX-License-Identifier: GPL-3.0-or-later
// The quick half of the search for tabs.
#include <numeric>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/start_tree.hpp"
#include "unfold/search/overlap_pairs.hpp"
#include "unfold/search/rooted_net.hpp"
#include "unfold/search/tree_search.hpp"
#include "unfold/tabs/place/targets.hpp"
#include "unfold/tabs/trees/quick_search.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::Patch;
using unfold::RootedNet;
using unfold::TabWedges;
using unfold::TreeSearch;

namespace {

constexpr double tolerance = 1e-5;
constexpr double clearance = 0.2;

/// A sphere with dents and bumps, about 60 mm across, so that many of its edges are short of room.
mesh::Surface lumpy(std::uint64_t seed) {
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

struct Example {
  explicit Example(std::uint64_t seed, std::size_t left_out = 0)
      : surface(lumpy(seed)), panels(prepare::find_panels(surface)) {
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
    Random random(seed);
    TreeSearch net(patch, tolerance, seed);
    net.set_tree(unfold::start_tree(patch, unfold::StartTree::short_cuts, random));
    REQUIRE(net.run({20000, 20000}, Context()));
    folds = net.folds();
  }
  [[nodiscard]] TabWedges wedges() const { return {patch, candidates, targets.seam, clearance}; }

  mesh::Surface surface;
  prepare::Panels panels;
  Patch patch;
  unfold::TabTargets targets;
  std::vector<std::vector<unfold::TabCandidate>> candidates;
  Folds folds;
};

bool is_spanning_tree(const Patch& patch, const Folds& folds) {
  DisjointSets sets(patch.size());
  std::uint32_t joined = 0;
  for (std::uint32_t side = 0; side < folds.size(); ++side) {
    if (folds[side] != 0 && side < patch.twin[side]) {
      if (!sets.join(side / 3, patch.twin[side] / 3)) {
        return false;
      }
      ++joined;
    }
  }
  return joined + 1 == patch.size();
}

}  // namespace

TEST_CASE("what a swap changes is what counting afresh shows") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    // The last one is open: it has seams.
    const Example example(seed, seed == 3 ? 20 : 0);
    TabWedges wedges = example.wedges();
    TabWedges fresh = example.wedges();
    RootedNet net(example.patch);
    net.set_tree(example.folds);
    wedges.set_tree(example.folds);
    Random random(seed);
    int kept = 0;
    for (int trial = 0; trial < 3000; ++trial) {
      const std::uint32_t side = random.below(static_cast<std::uint32_t>(example.patch.twin.size()));
      if (example.patch.twin[side] == unfold::nothing || net.folds()[side] != 0) {
        continue;
      }
      const auto path = net.removable_between(side / 3, example.patch.twin[side] / 3);
      const std::uint32_t below = path[random.below(static_cast<std::uint32_t>(path.size()))];
      const double before = wedges.missing();
      const double change = wedges.change(side, net.side_above(below));
      if (random.unit() < 0.5) {
        wedges.drop();
        REQUIRE(wedges.missing() == before);
        continue;
      }
      net.swap(below, side);
      wedges.keep();
      fresh.set_tree(net.folds());
      REQUIRE(wedges.missing() == Approx(before + change).margin(1e-9));
      REQUIRE(wedges.missing() == Approx(fresh.missing()).margin(1e-9));
      for (std::uint32_t cut = 0; cut < example.patch.twin.size(); ++cut) {
        if (net.folds()[cut] == 0) {
          REQUIRE(wedges.missing_on(cut) == fresh.missing_on(cut));
        }
      }
      ++kept;
    }
    CHECK(kept > 200);
  }
}

TEST_CASE("the overlaps that a swap adds are counted as after the swap") {
  const Example example(4);
  RootedNet net(example.patch);
  net.set_tree(example.folds);
  unfold::OverlapPairs pairs(net, tolerance);
  pairs.find_all();
  unfold::OverlapPairs fresh(net, tolerance);
  Random random(5);
  int with_overlap = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const std::uint32_t side = random.below(static_cast<std::uint32_t>(example.patch.twin.size()));
    if (net.folds()[side] != 0) {
      continue;
    }
    const auto path = net.removable_between(side / 3, example.patch.twin[side] / 3);
    const std::uint32_t below = path[random.below(static_cast<std::uint32_t>(path.size()))];
    const auto before = static_cast<std::int64_t>(pairs.total());
    const std::int64_t added = pairs.added(below, side, 1'000'000);
    const std::int64_t limit = added + random.below(3) - 1;
    CHECK((pairs.added(below, side, limit) < limit) == (added < limit));
    pairs.swap(below, side);
    REQUIRE(static_cast<std::int64_t>(pairs.total()) == before + added);
    fresh.find_all();
    REQUIRE(fresh.total() == pairs.total());
    with_overlap += pairs.total() > 0 ? 1 : 0;
  }
  CHECK(with_overlap > 100);
}

TEST_CASE("the quick search finds clean trees with more room for tabs") {
  for (const std::uint64_t seed : {6U, 7U}) {
    const Example example(seed);
    TabWedges wedges = example.wedges();
    wedges.set_tree(example.folds);
    const double before = wedges.missing();
    RootedNet net(example.patch);
    net.set_tree(example.folds);
    const auto found =
        unfold::find_tab_start(example.patch, wedges, net, tolerance, 100'000, {}, seed, Context());
    REQUIRE(found);
    CHECK(is_spanning_tree(example.patch, *found));
    CHECK(unfold::find_overlaps(unfold::lay_out(example.patch, *found), tolerance).empty());
    wedges.set_tree(*found);
    CHECK(wedges.missing() < 0.7 * before);

    RootedNet again(example.patch);
    again.set_tree(example.folds);
    CHECK(unfold::find_tab_start(example.patch, wedges, again, tolerance, 100'000, {}, seed, Context()) ==
          found);
  }
}

TEST_CASE("trees that may not be are not found") {
  const Example example(8);
  TabWedges wedges = example.wedges();
  RootedNet net(example.patch);
  net.set_tree(example.folds);
  int asked = 0;
  const auto none = [&](const Folds&) {
    ++asked;
    return false;
  };
  CHECK_FALSE(unfold::find_tab_start(example.patch, wedges, net, tolerance, 20'000, none, 8, Context()));
  CHECK(asked > 0);
}
