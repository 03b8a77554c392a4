// SPDX-License-Identifier: GPL-3.0-or-later
// What lies around an axis within a piece is cut alike, however it was cut before.
#include "unfold/pieces/turned_branches.hpp"

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
#include "unfold/patch/start_tree.hpp"
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
