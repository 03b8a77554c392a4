// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/least_forest.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "bench/spiky_bodies.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/net_search.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;
using test::grown;
using test::tolerance;

namespace {

/// The fewest trees of any forest without overlap, by trying all sets of folds.
std::size_t by_trying_all(const Patch& patch) {
  std::vector<std::uint32_t> sides;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != no_index && side < patch.twin[side]) {
      sides.push_back(side);
    }
  }
  std::size_t fewest = patch.size();
  for (std::uint32_t set = 0; set < (1U << sides.size()); ++set) {
    DisjointSets trees(patch.size());
    Folds folds(patch.twin.size(), 0);
    std::size_t left = patch.size();
    bool forest = true;
    for (std::size_t i = 0; i < sides.size() && forest; ++i) {
      if (((set >> i) & 1U) != 0) {
        forest = trees.join(sides[i] / 3, patch.twin[sides[i]] / 3);
        set_fold(patch, folds, sides[i], true);
        --left;
      }
    }
    if (forest && left < fewest && find_overlaps(lay_out(patch, folds), tolerance).empty()) {
      fewest = left;
    }
  }
  return fewest;
}

/// Two pyramids over a star with five tips.
mesh::Surface star_bipyramid(double height) {
  std::vector<Vec3> points;
  for (int i = 0; i < 10; ++i) {
    const double radius = i % 2 == 0 ? 100.0 : 30.0;
    const double angle = i * std::numbers::pi / 5.0;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
  }
  points.push_back({0.0, 0.0, height});
  points.push_back({0.0, 0.0, -height});
  std::vector<std::array<VertexId, 3>> faces;
  for (unsigned i = 0; i < 10; ++i) {
    const unsigned next = (i + 1) % 10;
    faces.push_back({VertexId(i), VertexId(next), VertexId(10U)});
    faces.push_back({VertexId(next), VertexId(i), VertexId(11U)});
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("the least number of nets is what trying all sets of folds gives", "[proof]") {
  const mesh::Surface ball = bench::spiky_ball(1, 80, 6.0, 1);
  const Patch whole = test::whole_patch(ball, test::no_panels(ball));
  Random random(3);
  std::size_t several = 0;
  for (int i = 0; i < 60; ++i) {
    const Patch patch = sub_patch(whole, grown(whole, 9 + random.below(3), random));
    const std::size_t least = by_trying_all(patch);
    const LeastForest found = least_forest(patch, {tolerance, patch.size(), 100'000'000}, {});
    INFO("patch " << i << " of " << patch.size() << " faces");
    REQUIRE(found.finished);
    CHECK(found.at_least == least);
    CHECK(lay_out(patch, found.folds).faces.size() == least);
    CHECK(find_overlaps(lay_out(patch, found.folds), tolerance).empty());
    several += least > 1 ? 1 : 0;
  }
  CHECK(several > 5);
}

TEST_CASE("the bipyramid over a star has no net", "[proof]") {
  const mesh::Surface star = star_bipyramid(20.0);
  const Patch patch = test::whole_patch(star, test::no_panels(star));
  const LeastForest none = least_forest(patch, {tolerance, 1, 10'000'000}, {});
  CHECK(none.finished);
  CHECK(none.folds.empty());
  CHECK(none.at_least == 2);

  const Nets nets = unfold::unfold(star, test::flat_panels(star), test::one_part(star), {}, {});
  CHECK(test::faults_of(star, nets, {}).empty());
  REQUIRE(nets.pieces.size() == 2);
  CHECK(nets.pieces[PieceId(1)].reason == PieceReason::no_net);
  // Two of them in one part, and what lies apart: each is proven by itself.
  std::vector<Vec3> points(star.points().begin(), star.points().end());
  std::vector<std::array<VertexId, 3>> triangles;
  for (const FaceId f : ids<FaceId>(star.face_count())) {
    triangles.push_back(star.vertices(f));
  }
  const auto count = static_cast<std::uint32_t>(points.size());
  for (const Vec3 p : star.points()) {
    points.push_back(p + Vec3{500.0, 0.0, 0.0});
  }
  for (std::size_t f = 0; f < star.face_count(); ++f) {
    const auto [a, b, c] = triangles[f];
    triangles.push_back(
        {VertexId(a.value() + count), VertexId(b.value() + count), VertexId(c.value() + count)});
  }
  const mesh::Surface two(std::move(points), std::move(triangles));
  std::map<PieceReason, int> reasons;
  for (const Piece& piece : unfold::unfold(two, test::flat_panels(two), test::one_part(two), {}, {}).pieces) {
    ++reasons[piece.reason];
  }
  CHECK(reasons[PieceReason::part] == 1);
  CHECK(reasons[PieceReason::component] == 1);
  CHECK(reasons[PieceReason::no_net] == 2);
  // A higher one has nets.
  const mesh::Surface high = star_bipyramid(100.0);
  const Patch other = test::whole_patch(high, test::no_panels(high));
  const LeastForest one = least_forest(other, {tolerance, 1, 10'000'000}, {});
  CHECK(one.at_least == 1);
  CHECK(lay_out(other, one.folds).faces.size() == 1);
}

TEST_CASE("panels stay whole in a proof", "[proof]") {
  const mesh::Surface frame =
      test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}});
  const Patch patch = test::whole_patch(frame, test::flat_panels(frame));
  const LeastForest found = least_forest(patch, {tolerance, 4, 10'000'000}, {});
  REQUIRE(found.finished);
  // The hole of a ring has room for one of the four inner walls.
  CHECK(found.at_least == 2);
  CHECK(lay_out(patch, found.folds).faces.size() == 2);
  CHECK(find_overlaps(lay_out(patch, found.folds), tolerance).empty());
  const Patch loose = test::whole_patch(frame, test::no_panels(frame));
  CHECK(least_forest(loose, {tolerance, 4, 10'000'000}, {}).at_least == 1);
}

TEST_CASE("a proof ends when its work is spent, and no net was found where it says that there is none",
          "[proof]") {
  const mesh::Surface ball = bench::spiky_ball(1, 64, 3.0, 1);
  const Patch whole = test::whole_patch(ball, test::no_panels(ball));
  const LeastForest cut_short = least_forest(whole, {tolerance, 1, 100'000}, {});
  CHECK_FALSE(cut_short.finished);
  CHECK(cut_short.at_least == 1);
  CHECK(cut_short.folds.empty());
  CHECK(cut_short.work < 200'000);
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    const Patch patch = sub_patch(whole, grown(whole, 26, random));
    const bool found = test::net_of(patch, 1).overlaps == 0;
    const LeastForest least = least_forest(patch, {tolerance, 1, 10'000'000}, {});
    INFO("patch " << i);
    REQUIRE(least.finished);
    CHECK(least.work < 1'000'000);
    CHECK((!found || least.at_least == 1));
  }
}
