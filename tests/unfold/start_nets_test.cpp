// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/start_nets.hpp"

#include <array>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/tree.hpp"

using namespace ridgecraft;
using namespace ridgecraft::unfold;

namespace {

/// A ball whose vertices are pushed in and out, mm: its trees overlap in many places.
Patch bumpy_patch(std::uint64_t seed) {
  const mesh::Surface ball = test::sphere(18, 11);
  Random random(seed);
  std::vector<Vec3> points;
  for (const Vec3 p : ball.points()) {
    points.push_back((20.0 + 60.0 * random.unit()) * p);
  }
  std::vector<std::array<VertexId, 3>> vertices;
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(ball.face_count())) {
    vertices.push_back(ball.vertices(f));
    faces.push_back(f);
  }
  const mesh::Surface bumpy(std::move(points), std::move(vertices));
  return make_patch(bumpy, test::no_panels(bumpy), faces);
}

bool is_allowed(const Patch& patch, const Folds& folds, const Room& room, double tolerance) {
  return find_overlaps(lay_out(patch, folds), tolerance).empty() && all_fit(patch, folds, room);
}

}  // namespace

TEST_CASE("first nets lie flat, fit, and no two of them could be one", "[start_nets]") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    CAPTURE(seed);
    const Patch patch = bumpy_patch(seed);
    const double tolerance = net_tolerance(patch.extent);
    for (const Room& room : {Room{}, Room{Sheet{120.0, 90.0}, 5.0, 0}, Room{std::nullopt, 0.0, 12}}) {
      const Folds folds = start_nets(patch, room, {tolerance}, seed, {});
      CHECK(is_allowed(patch, folds, room, tolerance));
      const Layout layout = lay_out(patch, folds);
      for (std::uint32_t side = 0; side < folds.size(); ++side) {
        const std::uint32_t twin = patch.twin[side];
        if (side < twin && layout.piece[side / 3] != layout.piece[twin / 3]) {
          Folds joined = folds;
          set_fold(patch, joined, side, true);
          CHECK_FALSE(is_allowed(patch, joined, room, tolerance));
        }
      }
    }
  }
}
