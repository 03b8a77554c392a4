// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that meet on the way, counted, and trees in which they do not.
#include "unfold/folding/folding_meetings.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/folding/fold_motion.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/search/free_folding.hpp"

using namespace ridgecraft;
using unfold::FoldMotion;

namespace {

/// The faces that a swap carries.
std::vector<std::uint32_t> moved_by(const unfold::Forest& net, const unfold::Move& swap) {
  const unfold::Forest::Span span = net.carried(swap).faces;
  std::vector<std::uint32_t> faces;
  for (std::uint32_t i = 0; i < span.count; ++i) {
    faces.push_back(net.face_in(span, i));
  }
  return faces;
}

/// A cut, and a fold on the way round it.
std::optional<unfold::Move> draw_swap(unfold::Forest& net, Random& random) {
  const std::uint32_t cut = random.below(static_cast<std::uint32_t>(net.folds().size()));
  const unfold::Patch& patch = net.patch();
  if (patch.twin[cut] == no_index || patch.frozen[cut] != 0 || net.folds()[cut] != 0) {
    return std::nullopt;
  }
  const auto& way = net.folds_between(cut / 3, patch.twin[cut] / 3);
  return way.empty() ? std::nullopt : std::optional(unfold::Move{pick(way, random), cut});
}

/// A net found with no thought of folding, from any tree; without folds where there is none.
std::pair<unfold::Patch, unfold::Folds> net_from_anywhere(const mesh::Surface& surface, std::uint64_t seed) {
  unfold::Patch patch = test::whole_patch(surface, test::flat_panels(surface));
  Random random(seed);
  unfold::NetFound net = test::net_of(patch, test::random_tree(patch, random), seed);
  return {std::move(patch), net.overlaps == 0 ? std::move(net.folds) : unfold::Folds{}};
}

/// Such a net, and the faces of it that meet while it folds.
struct CountedNet {
  explicit CountedNet(const mesh::Surface& surface) : CountedNet(net_from_anywhere(surface, 3)) {}

  unfold::Patch patch;
  unfold::Forest net;
  unfold::FoldingMeetings meetings;

 private:
  explicit CountedNet(std::pair<unfold::Patch, unfold::Folds> found)
      : patch(std::move(found.first)), net(patch), meetings(patch) {
    REQUIRE_FALSE(found.second.empty());
    net.set_folds(found.second);
    meetings.count(net.folds());
  }
};

/// Pairs of faces that meet in a pose, all of them compared, but for those of one plate or beside one crease.
std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_in(const FoldMotion& motion,
                                                           const std::vector<double>& share) {
  FoldMotion::Pose pose;
  motion.pose(share, pose);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t f = 0; f < motion.face_count(); ++f) {
    for (std::uint32_t g = f + 1; g < motion.face_count(); ++g) {
      const std::uint32_t p = motion.plate(f);
      const std::uint32_t q = motion.plate(g);
      unfold::Corners one = pose.corners[f];
      unfold::Corners other = pose.corners[g];
      if (p != q && !motion.hinged(p, q) && unfold::without_seam(one, one) &&
          unfold::without_seam(other, other) && unfold::meet(one, other)) {
        pairs.emplace(f, g);
      }
    }
  }
  return pairs;
}

/// Pairs that meet on the way when all creases are folded together, and not at its end.
unfold::FacePairs pairs_that_meet(const FoldMotion& motion) {
  const std::size_t creases = motion.creases().size();
  const auto always = pairs_in(motion, std::vector<double>(creases, 1.0));
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (int sample = 1; sample < unfold::samples_of_motion; ++sample) {
    found.merge(pairs_in(
        motion, std::vector<double>(creases, static_cast<double>(sample) / unfold::samples_of_motion)));
  }
  unfold::FacePairs pairs;
  std::set_difference(found.begin(), found.end(), always.begin(), always.end(), std::back_inserter(pairs));
  return pairs;
}

/// Pairs that meet on the way when one crease is folded after the other.
std::size_t meetings_in_order(const FoldMotion& motion, const std::vector<std::uint32_t>& order) {
  std::vector<double> share(motion.creases().size(), 1.0);
  const auto always = pairs_in(motion, share);
  std::fill(share.begin(), share.end(), 0.0);
  std::size_t count = 0;
  for (const std::uint32_t crease : order) {
    for (int sample = 1; sample <= unfold::samples_of_motion; ++sample) {
      share[crease] = static_cast<double>(sample) / unfold::samples_of_motion;
      for (const auto& pair : pairs_in(motion, share)) {
        count += always.contains(pair) ? 0U : 1U;
      }
    }
  }
  return count;
}

}  // namespace

TEST_CASE("a tree that gets in its own way is exchanged for one that doesn't", "[unfold][slow]") {
  // A ball and a knot of cubes: many of their nets run through themselves.
  const std::vector<mesh::Surface> surfaces{
      test::scaled(test::sphere(14, 9), 40.0),
      test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 2), 30.0)};
  int stuck = 0;
  int freed = 0;
  for (const mesh::Surface& surface : surfaces) {
    const unfold::Patch patch = test::whole_patch(surface, test::flat_panels(surface));
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const double tolerance = unfold::net_tolerance(patch.extent);
      Random random(seed);
      const unfold::NetFound net = test::net_of(patch, test::random_tree(patch, random), seed);
      if (net.overlaps > 0 || unfold::folds_together(patch, net.folds, {})) {
        continue;
      }
      ++stuck;
      // Trees with shorter cuts cost less.
      const auto freed_for = [&](double worth) {
        const auto cost = [&](const unfold::Folds& tree) -> std::optional<double> {
          double sum = 0.0;
          for (std::size_t side = 0; side < patch.length.size(); ++side) {
            sum += tree[side] == 0 ? patch.length[side] : 0.0;
          }
          return sum;
        };
        const std::optional<unfold::Folds> changed =
            unfold::fold_freely(patch, net.folds, {tolerance, cost, worth}, seed, {});
        CHECK((!changed || *changed != net.folds));
        CHECK((!changed || *cost(*changed) <= *cost(net.folds) + worth));
        return changed.value_or(net.folds);
      };
      const unfold::Folds other = freed_for(1e9);
      CHECK(unfold::lay_out(patch, other).faces.size() == 1);
      CHECK(unfold::find_overlaps(unfold::lay_out(patch, other), tolerance).empty());
      for (std::size_t side = 0; side < other.size(); ++side) {
        CHECK((patch.frozen[side] == 0 || other[side] == net.folds[side]));
      }
      CHECK((other == net.folds || unfold::folds_together(patch, other, {})));
      freed += other != net.folds ? 1 : 0;
      CHECK(freed_for(1e9) == other);
      CHECK(freed_for(-1e9) == net.folds);
    }
  }
  CHECK(stuck > 0);
  CHECK(freed == stuck);
}

TEST_CASE("what opens backwards folds forwards", "[unfold]") {
  // Nets that were searched without a thought of folding.
  int opened = 0;
  for (const mesh::Surface& surface :
       {test::scaled(test::sphere(8, 5), 40.0), test::scaled(test::cube(), 50.0),
        test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 1), 30.0)}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const auto [patch, folds] = net_from_anywhere(surface, seed);
      if (folds.empty()) {
        continue;
      }
      const FoldMotion motion(unfold::flat_piece(patch, folds));
      const Context context;
      unfold::FoldTrial trial(motion, context);
      const unfold::Opening opening = unfold::open_piece(motion, trial, context);
      if (opening.opened.size() < motion.creases().size()) {
        CHECK(opening.in_the_way.has_value());
        continue;
      }
      ++opened;
      std::set<std::uint32_t> each(opening.opened.begin(), opening.opened.end());
      CHECK(each.size() == motion.creases().size());
      std::vector<std::uint32_t> order(opening.opened.rbegin(), opening.opened.rend());
      const unfold::Folding folding = unfold::find_order(motion, trial, context);
      const bool works = trial.order_works(order);
      CHECK((folding.way != unfold::FoldWay::in_order || (works && folding.order == order)));
      CHECK((folding.way == unfold::FoldWay::with_care || meetings_in_order(motion, folding.order) == 0));
      const unfold::Opening again = unfold::open_piece(motion, trial, context);
      CHECK(again.opened == opening.opened);
    }
  }
  CHECK(opened > 6);
}

TEST_CASE("meetings are counted as if each tree were folded afresh", "[unfold]") {
  std::size_t most = 0;
  for (const mesh::Surface& surface :
       {test::scaled(test::sphere(8, 6), 40.0),
        test::scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, 1), 30.0)}) {
    CountedNet counted(surface);
    auto& [patch, net, meetings] = counted;
    Random random(5);
    for (int step = 0; step < 80; ++step) {
      auto pairs = meetings.pairs();
      std::sort(pairs.begin(), pairs.end());
      CHECK(pairs == pairs_that_meet(FoldMotion(unfold::flat_piece(patch, net.folds()))));
      most = std::max(most, pairs.size());
      const auto swap = draw_swap(net, random);
      if (!swap) {
        continue;
      }
      const std::size_t after =
          meetings.after({moved_by(net, *swap), net.faces_of(net.tree_of(0)), swap->closed}, 100000);
      for (const std::size_t limit : {std::size_t{1}, after, after + 1}) {
        CHECK(meetings.after({moved_by(net, *swap), net.faces_of(net.tree_of(0)), swap->closed}, limit) ==
              std::min(limit, after));
      }
      if (random.below(3) > 0) {
        meetings.keep(net.folds());
        net.make(*swap);
        CHECK(meetings.total() == after);
      }
    }
  }
  CHECK(most > 0);
}

TEST_CASE("meetings stay as they are counted afresh over thousands of swaps", "[unfold]") {
  const mesh::Surface surface = test::scaled(test::sphere(8, 6), 40.0);
  CountedNet counted_net(surface);
  auto& [patch, net, meetings] = counted_net;
  Random random(11);
  for (int step = 0; step < 4000; ++step) {
    const auto swap = draw_swap(net, random);
    if (swap) {
      static_cast<void>(
          meetings.after({moved_by(net, *swap), net.faces_of(net.tree_of(0)), swap->closed}, 1'000'000));
      meetings.keep(net.folds());
      net.make(*swap);
    }
  }
  auto kept = meetings.pairs();
  meetings.count(net.folds());
  auto counted = meetings.pairs();
  std::sort(kept.begin(), kept.end());
  std::sort(counted.begin(), counted.end());
  CHECK(kept == counted);
}
