// SPDX-License-Identifier: GPL-3.0-or-later
// What lies around an axis within a piece is cut alike, however it was cut before.
#include "unfold/pieces/turned_branches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "prepare/symmetry/rotations.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/room.hpp"
#include "unfold/patch/sub_patch.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/pieces/turned_pieces.hpp"
#include "unfold/search/one_piece.hpp"

using namespace ridgecraft;
using unfold::Folds;
using unfold::Patch;

namespace {

/// A body with so many teeth about the z axis.
mesh::Surface gear(int teeth) {
  return test::star_shaped(
      [=](Vec3 d) {
        const double around = std::atan2(d.y, d.x);
        const double out = std::hypot(d.x, d.y);
        return 30.0 * (1.0 + 0.5 * out * out * std::pow(0.5 + 0.5 * std::cos(teeth * around + 0.4), 2.0));
      },
      4 * teeth, 6);
}

}  // namespace

TEST_CASE("branches of flat regions become alike, in each piece, and on the sheet", "[unfold]") {
  // A cross of cubes: arms of two around a column of three. Its foot is a piece, the rest another.
  std::vector<std::array<int, 3>> cells{{0, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const int reach : {1, 2}) {
    cells.insert(cells.end(), {{reach, 0, 0}, {-reach, 0, 0}, {0, reach, 0}, {0, -reach, 0}});
  }
  const mesh::Surface surface = test::mapped(test::voxels(cells), [](Vec3 p) {
    return 20.0 * (p - Vec3{0.5, 0.5, 0.5});
  });
  const Patch patch = test::whole_patch(surface, test::flat_panels(surface));
  const double tolerance = unfold::net_tolerance(patch.extent);
  const unfold::Weights weights;
  const auto turn = unfold::turn_of(surface, weights);
  REQUIRE(turn.has_value());
  CHECK(turn->order == 4);
  std::vector<std::uint32_t> foot, rest;
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    double top = -100.0;
    for (const VertexId v : surface.vertices(patch.face[f])) {
      top = std::max(top, surface.point(v).z);
    }
    (top < -9.0 ? foot : rest).push_back(f);
  }
  unfold::Room room;
  room.sheet = unfold::Sheet{190.0, 270.0};
  unfold::OnePieceSearch search;
  search.tolerance = tolerance;
  std::size_t changed = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Folds before(patch.twin.size(), 0);
    bool is_whole = true;
    for (const auto& faces : {foot, rest}) {
      const auto found =
          unfold::find_one_piece(unfold::sub_patch(patch, faces), room, search, seed, Context());
      is_whole = is_whole && found.tree;
      if (found.tree) {
        unfold::put_back(patch, faces, *found.tree, before);
      }
    }
    if (!is_whole) {
      continue;
    }
    const Folds after =
        unfold::turned_branches(surface, patch, before, *turn, {}, weights, room, tolerance, Context());
    const unfold::Layout layout = unfold::lay_out(patch, after);
    CHECK(layout.faces.size() == 2);
    CHECK(unfold::find_overlaps(layout, tolerance).empty());
    CHECK(unfold::all_fit(patch, after, room));
    for (const std::uint32_t f : foot) {
      CHECK(layout.piece[f] == layout.piece[foot.front()]);
    }
    for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
      CHECK(after[side] == after[patch.twin[side]]);
      CHECK((patch.frozen[side] == 0 || layout.piece[side / 3] == layout.piece[patch.twin[side] / 3]));
    }
    const auto uneven = [&](const Folds& folds) {
      return unfold::unevenness(surface, unfold::edges_in_forest(surface, patch, folds), turn->edge);
    };
    changed += uneven(after) < uneven(before) ? 1U : 0U;
  }
  CHECK(changed > 6);
}

TEST_CASE("branches around an axis become alike, and pieces stay one clean net", "[unfold]") {
  const unfold::Weights weights;
  std::size_t changed = 0;
  std::size_t whole = 0;
  for (const int teeth : {3, 4, 6}) {
    const mesh::Surface surface = gear(teeth);
    const Patch patch = test::whole_patch(surface, test::no_panels(surface));
    const double tolerance = unfold::net_tolerance(patch.extent);
    const auto turn = unfold::turn_of(surface, weights);
    REQUIRE(turn.has_value());
    unfold::OnePieceSearch search;
    search.tolerance = tolerance;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      CAPTURE(teeth, seed);
      const std::optional<Folds> before =
          unfold::find_one_piece(patch, unfold::Room(), search, seed, Context()).tree;
      if (!before) {
        continue;
      }
      ++whole;
      const Folds after = unfold::turned_branches(surface, patch, *before, *turn, {}, weights, unfold::Room(),
                                                  tolerance, Context());
      const unfold::Layout layout = unfold::lay_out(patch, after);
      CHECK(layout.faces.size() == 1);
      CHECK(unfold::find_overlaps(layout, tolerance).empty());
      const std::array images{&turn->edge};
      if (after != *before) {
        ++changed;
        CHECK(unfold::cost_of_forest(surface, patch, after, images, weights) <
              unfold::cost_of_forest(surface, patch, *before, images, weights));
      }
      // Nothing is left to do for a second run.
      CHECK(unfold::turned_branches(surface, patch, after, *turn, {}, weights, unfold::Room(), tolerance,
                                    Context()) == after);
    }
  }
  CHECK(whole > 20);
  CHECK(changed > 4);
}
