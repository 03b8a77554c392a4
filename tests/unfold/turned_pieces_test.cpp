// SPDX-License-Identifier: GPL-3.0-or-later
// What lies around an axis is divided alike, whatever was done with one of it.
#include "unfold/pieces/turned_pieces.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "base/disjoint_sets.hpp"
#include "base/random.hpp"
#include "prepare/symmetry/rotations.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/search/one_piece.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::Patch;

namespace {

/// A body with so many arms about the z axis, mirrored by no plane.
mesh::Surface with_arms(int arms) {
  return test::star_shaped(
      [=](Vec3 d) {
        const double around = std::atan2(d.y, d.x) + 0.3 * d.z;
        const double out = std::hypot(d.x, d.y);
        return 30.0 * (1.0 + 1.2 * out * out * std::pow(0.5 + 0.5 * std::cos(arms * around), 2.0));
      },
      4 * arms, 6);
}

/// Which arm a face belongs to.
int arm_of(const mesh::Surface& surface, FaceId f, int arms) {
  Vec3 p;
  for (const VertexId v : surface.vertices(f)) {
    p = p + surface.point(v) / 3.0;
  }
  const double around = (std::atan2(p.y, p.x) + 0.3 * p.z / length(p)) / (2.0 * std::numbers::pi);
  return static_cast<int>(std::lround(arms * (around + 1.0))) % arms;
}

/// A forest of clean trees, each on one arm; arm 0 has a few faces of arm 1. Nothing where none is found.
std::optional<Folds> random_arms(const mesh::Surface& surface, const Patch& patch, int arms, Random& random) {
  std::vector<int> arm;
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    arm.push_back(arm_of(surface, patch.face[f], arms));
  }
  const std::vector<int> before = arm;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (before[side / 3] == 0 && before[patch.twin[side] / 3] == 1 && random.below(4) == 0) {
      arm[patch.twin[side] / 3] = 0;
    }
  }
  DisjointSets joined(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (arm[side / 3] == arm[patch.twin[side] / 3]) {
      static_cast<void>(joined.join(side / 3, patch.twin[side] / 3));
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> sets;
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    sets[joined.find(f)].push_back(f);
  }
  unfold::OnePieceSearch search;
  search.tolerance = unfold::net_tolerance(patch.extent);
  Folds folds(patch.twin.size(), 0);
  for (const auto& [first, faces] : sets) {
    const auto found = unfold::find_one_piece(unfold::sub_patch(patch, faces), unfold::Room(), search,
                                              random.next(), Context());
    if (!found.tree) {
      return std::nullopt;
    }
    unfold::put_back(patch, faces, *found.tree, folds);
  }
  return folds;
}

/// Of each arm how many of its faces lie in each piece.
std::vector<std::multiset<std::size_t>> pieces_of_arms(const mesh::Surface& surface, const Patch& patch,
                                                       const unfold::Layout& layout, int arms) {
  std::vector<std::map<std::uint32_t, std::size_t>> faces(static_cast<std::size_t>(arms));
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    ++faces[static_cast<std::size_t>(arm_of(surface, patch.face[f], arms))][layout.piece[f]];
  }
  std::vector<std::multiset<std::size_t>> result;
  for (const auto& of_arm : faces) {
    std::multiset<std::size_t>& sizes = result.emplace_back();
    for (const auto& [piece, count] : of_arm) {
      sizes.insert(count);
    }
  }
  return result;
}

}  // namespace

TEST_CASE("pieces around an axis get one division and one tree", "[unfold]") {
  const unfold::Weights weights;
  std::size_t clean = 0;
  std::size_t changed = 0;
  for (const int arms : {3, 4, 5}) {
    const mesh::Surface surface = with_arms(arms);
    const prepare::Panels panels = test::no_panels(surface);
    const unfold::Options options;
    const unfold::Room room;
    const Patch patch = test::whole_patch(surface, panels);
    const double tolerance = unfold::net_tolerance(patch.extent);
    const auto turn = unfold::turn_of(surface, weights);
    REQUIRE(turn.has_value());
    CHECK(turn->order == static_cast<unsigned>(arms));
    unfold::Weights none;
    none.mirror = 0.0;
    CHECK_FALSE(unfold::turn_of(surface, none).has_value());
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      CAPTURE(arms, seed);
      Random random(seed);
      const std::optional<Folds> given = random_arms(surface, patch, arms, random);
      if (!given) {
        continue;
      }
      ++clean;
      const Folds& folds = *given;
      const unfold::Layout before = unfold::lay_out(patch, folds);
      Context seeded;
      seeded.seed = seed;
      const Folds turned =
          unfold::turned_pieces({surface, panels, patch, {}, options, room}, folds, *turn, {}, seeded);
      const unfold::Layout after = unfold::lay_out(patch, turned);
      changed += turned != folds ? 1U : 0U;
      CHECK(unfold::find_overlaps(after, tolerance).empty());
      CHECK(after.faces.size() <= before.faces.size());
      const auto of_arms = pieces_of_arms(surface, patch, after, arms);
      for (const auto& arm : of_arms) {
        CHECK(arm == of_arms[0]);
      }
      CHECK(unfold::unevenness(surface, unfold::edges_in_forest(surface, patch, turned), turn->edge) == 0.0);
    }
  }
  CHECK(clean > 20);
  CHECK(changed > 15);
}

TEST_CASE("pieces that are joined in a ring are equal with their tabs, too", "[unfold]") {
  for (const int arms : {3, 4}) {
    CAPTURE(arms);
    const mesh::Surface surface = with_arms(arms);
    IdVector<FaceId, PartId> part(surface.face_count());
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      part[f] = PartId(static_cast<std::uint32_t>(arm_of(surface, f, arms)));
    }
    unfold::Options options;
    options.tabs.wanted = true;
    const unfold::Nets nets = unfold::unfold(surface, test::no_panels(surface), part, options, {});
    REQUIRE(nets.pieces.size() == static_cast<std::size_t>(arms));
    REQUIRE(nets.equal.size() == 1);
    CHECK(nets.equal[0].size() == static_cast<std::size_t>(arms));
    for (const unfold::EqualPiece& equal : nets.equal[0]) {
      CHECK_FALSE(equal.other_tabs);
    }
  }
}
