// SPDX-License-Identifier: GPL-3.0-or-later
// Orders of folding hold every fold once, and are told wherever there are any.
#include "unfold/folding/fold_order.hpp"

#include <cmath>
#include <iterator>
#include <map>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/bent_sheets.hpp"
#include "unfold/nets_checks.hpp"

using namespace ridgecraft;
using test::any_order_works;
using test::bent_sheet;
using test::crosses;
using test::crosses_in_order;
using test::crosses_together;
using test::joints_of;
using test::random_hooks;
using test::random_profile;
using test::random_spiral;
using test::samples;
using unfold::FoldWay;
using unfold::Nets;

TEST_CASE("an order of folding has each folded edge once", "[unfold]") {
  std::vector<mesh::Surface> surfaces{test::cube(), test::sphere(12, 8),
                                      test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 3)};
  for (const std::string& file : test::shared_models()) {
    if (file.find("bunny_128") != std::string::npos || file.find("star80") != std::string::npos) {
      surfaces.push_back(test::read_off(file));
    }
  }
  for (const mesh::Surface& surface : surfaces) {
    const Nets nets = test::default_nets(surface);
    std::map<EdgeId, int> times;
    for (const unfold::Piece& piece : nets.pieces) {
      for (const auto& step : piece.folding.steps) {
        CHECK(!step.empty());
        for (const CornerId side : step) {
          ++times[surface.edge(side)];
          CHECK(nets.piece[mesh::face_of(side)] == PieceId(&piece - &nets.pieces[PieceId(0)]));
        }
      }
      CHECK((piece.folding.way != FoldWay::together || piece.folding.steps.size() <= 1));
    }
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const bool folded = nets.use[e] == unfold::EdgeUse::fold && std::abs(surface.fold_angle(e)) > 1e-5;
      CHECK(times[e] == (folded ? 1 : 0));
    }
  }
}

TEST_CASE("a cube folds up with all creases at a time", "[unfold]") {
  const mesh::Surface cube = test::scaled(test::cube(), 50.0);
  const Nets nets = test::default_nets(cube);
  CHECK(nets.pieces[PieceId(0)].folding.way == FoldWay::together);
}

TEST_CASE("strips fold as their profiles say", "[unfold]") {
  // The profile's joints turn in the plane: whether it crosses itself there is another question than the
  // program's, with the same answer.
  Random random(7);
  std::map<FoldWay, int> seen;
  for (int round = 0; round < 300; ++round) {
    const std::vector<Vec2> profile = round % 2 == 0 ? random_profile(random) : random_hooks(random);
    const mesh::Surface sheet = bent_sheet(profile, 30.0);
    const Nets nets = test::default_nets(sheet);
    REQUIRE(nets.pieces.size() == 1);
    const unfold::FoldOrder& folding = nets.pieces[PieceId(0)].folding;
    ++seen[folding.way];
    CHECK((folding.way == FoldWay::together) == !crosses_together(profile, 0.3));
    if (folding.way != FoldWay::together && folding.way != FoldWay::with_care) {
      CHECK(!crosses_in_order(profile, joints_of(sheet, folding), 0.3));
    }
    CHECK(folding.in_the_way.has_value() == (folding.way == FoldWay::with_care));
  }
  CHECK(seen[FoldWay::together] > 0);
  CHECK(seen[FoldWay::leaves_first] + seen[FoldWay::middle_first] + seen[FoldWay::in_order] > 0);
}

TEST_CASE("an order is told wherever there is one, and only there", "[unfold]") {
  // Of few joints all orders can be tried.
  Random random(11);
  std::map<FoldWay, int> seen;
  for (int round = 0; round < 4000; ++round) {
    std::vector<Vec2> profile = random_spiral(random);
    if (!crosses_together(profile, 0.3)) {
      continue;
    }
    const mesh::Surface sheet = bent_sheet(profile, 30.0);
    const Nets nets = test::default_nets(sheet);
    REQUIRE(nets.pieces.size() == 1);
    const unfold::FoldOrder& folding = nets.pieces[PieceId(0)].folding;
    ++seen[folding.way];
    INFO(round);
    // Triangles give way a little farther than the stretches of the profile.
    if (folding.way == FoldWay::with_care) {
      CHECK(!any_order_works(profile, 0.0));
    } else {
      CHECK(!crosses_in_order(profile, joints_of(sheet, folding), 1.5));
    }
  }
  CHECK(seen[FoldWay::in_order] > 0);
}

TEST_CASE("hems that hold each other need care, and two of their faces are named", "[unfold]") {
  // A square tube closed by a seam as cans have it: each edge is bent back into the other.
  const std::vector<Vec2> seam{{40, 103}, {70, 103},    {70, 100},   {0, 100},    {0, 0},
                               {100, 0},  {100, 104.5}, {38, 104.5}, {38, 101.5}, {67, 101.5}};
  for (std::size_t joint = 1; joint + 1 < seam.size(); ++joint) {
    int crossing = 0;
    for (int sample = 0; sample < samples; ++sample) {
      std::vector<double> share(seam.size(), 1.0);
      share[joint] = static_cast<double>(sample) / samples;
      crossing += crosses(seam, share, 1.0) ? 1 : 0;
    }
    CHECK(crossing > 0);
  }
  const Nets nets = test::default_nets(bent_sheet(seam, 30.0));
  REQUIRE(nets.pieces.size() == 1);
  const unfold::FoldOrder& folding = nets.pieces[PieceId(0)].folding;
  CHECK(folding.way == FoldWay::with_care);
  REQUIRE(folding.in_the_way.has_value());
  CHECK((*folding.in_the_way)[0] != (*folding.in_the_way)[1]);
}
