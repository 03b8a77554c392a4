// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces nearly as large as the sheet: which of their tabs there is paper for.
#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using test::none;
using test::on_sheet;
using unfold::Nets;
using unfold::Options;

namespace {

/// Every piece lies on the sheet with its tabs; how many joins have none.
std::size_t more_tabs(const mesh::Surface& surface, const Options& options) {
  const Nets nets = unfold::unfold(surface, test::flat_panels(surface), test::one_part(surface), options, {});
  CHECK(test::faults_of(surface, nets, options) == none);
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    std::vector<Vec2> points;
    for (const FaceId f : nets.pieces[p].faces) {
      points.insert(points.end(), nets.flat[f].begin(), nets.flat[f].end());
    }
    for (const unfold::Tab& tab : nets.tabs) {
      if (nets.piece[mesh::face_of(tab.side)] == p) {
        points.insert(points.end(), tab.polygon.begin(), tab.polygon.end());
      }
    }
    CHECK(angle_to_fit(convex_hull(points), *options.sheet).has_value());
  }
  std::size_t missing = 0;
  for (const unfold::Join& join : nets.joins) {
    missing += join.tab.valid() ? 0U : 1U;
  }
  return missing;
}

mesh::Surface box(double x, double y, double z) {
  const mesh::Surface cube = test::cube();
  std::vector<Vec3> points;
  for (const Vec3 p : cube.points()) {
    points.push_back({x * p.x, y * p.y, z * p.z});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(cube.face_count())) {
    faces.push_back(cube.vertices(f));
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace

TEST_CASE("a prism nearly as high as the sheet has all tabs, on the sides that have paper", "[tab_rooms]") {
  const Options options = on_sheet(190.0, 266.0);
  for (const double height : {254.0, 257.0, 259.0, 262.0, 264.0, 265.9, 266.0}) {
    INFO("height " << height);
    CHECK(more_tabs(test::revolve({{0, 0}, {90, 0}, {90, height}, {0, height}}, 8), options) == 0);
  }
}

TEST_CASE("squares as wide as the sheet have tabs on two sides each", "[tab_rooms]") {
  for (const double side : {181.0, 186.0, 189.0, 190.0}) {
    INFO("side " << side);
    CHECK(more_tabs(box(side, side, side), on_sheet(190.0, 266.0)) == 0);
  }
}

TEST_CASE("where no piece has paper for a tab there is none, and each fits", "[tab_rooms]") {
  // A face as large as the sheet bears no tab; all its neighbours are as long as the sheet is high.
  CHECK(more_tabs(box(190.0, 266.0, 10.0), on_sheet(190.0, 266.0)) <= 4);
  CHECK(more_tabs(box(190.0, 266.0, 190.0), on_sheet(190.0, 266.0)) <= 12);
}
