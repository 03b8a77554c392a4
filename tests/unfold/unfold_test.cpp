// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/unfold.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "unfold/nets_checks.hpp"

using namespace ridgecraft;
using test::faults_of;
using test::none;
using test::on_sheet;
using test::scaled;
using unfold::Nets;
using unfold::Options;
using unfold::PieceReason;

namespace {

bool same(const Nets& a, const Nets& b) {
  bool equal = a.use == b.use && a.piece == b.piece && a.flat == b.flat && a.notes == b.notes &&
               a.pieces.size() == b.pieces.size() && a.joins.size() == b.joins.size();
  for (std::size_t i = 0; equal && i < a.joins.size(); ++i) {
    equal = a.joins[JoinId(i)].edge == b.joins[JoinId(i)].edge;
  }
  return equal;
}

}  // namespace

TEST_CASE("a cube becomes one net of six squares", "[unfold]") {
  const mesh::Surface cube = test::cube();
  const Nets nets = unfold::unfold(cube, test::flat_panels(cube), test::one_part(cube), {}, {});
  CHECK(faults_of(cube, nets, {}) == none);
  REQUIRE(nets.pieces.size() == 1);
  CHECK(nets.pieces[PieceId(0)].name == "A");
  CHECK(nets.joins.size() == 7);
}

TEST_CASE("one face, two faces and an open strip are nets", "[unfold]") {
  const mesh::Surface one({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{VertexId(0), VertexId(1), VertexId(2)}});
  const Nets nets = unfold::unfold(one, test::no_panels(one), test::one_part(one), {}, {});
  CHECK(faults_of(one, nets, {}) == none);
  CHECK(nets.joins.empty());
  const mesh::Surface two({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {3, 4, 5}},
                          {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(2), VertexId(1), VertexId(3)}});
  const Nets pair = unfold::unfold(two, test::no_panels(two), test::one_part(two), {}, {});
  CHECK(faults_of(two, pair, {}) == none);
  CHECK(pair.pieces.size() == 1);
  CHECK(pair.joins.empty());
}

TEST_CASE("faces without area are laid flat like others", "[unfold]") {
  // A square of two triangles with a collinear third between them.
  const mesh::Surface s({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, 1, 1}},
                        {{VertexId(0), VertexId(1), VertexId(4)},
                         {VertexId(1), VertexId(0), VertexId(2)},
                         {VertexId(0), VertexId(3), VertexId(2)},
                         {VertexId(2), VertexId(3), VertexId(1)}});
  const Nets nets = unfold::unfold(s, test::no_panels(s), test::one_part(s), {}, {});
  CHECK(faults_of(s, nets, {}) == none);
}

TEST_CASE("nothing to unfold gives nothing", "[unfold]") {
  const mesh::Surface empty;
  const Nets nets = unfold::unfold(empty, {}, {}, {}, {});
  CHECK(nets.pieces.empty());
}

TEST_CASE("a flat fan closes around its middle and a flat ring has a hole", "[unfold]") {
  const mesh::Surface cube = test::voxels({{0, 0, 0}}, 3);
  const Nets nets = unfold::unfold(cube, test::flat_panels(cube), test::one_part(cube), {}, {});
  CHECK(faults_of(cube, nets, {}) == none);
  CHECK(nets.pieces.size() == 1);
  CHECK(nets.joins.size() == 7 * 3);

  const mesh::Surface frame =
      test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}});
  const Nets ring = unfold::unfold(frame, test::flat_panels(frame), test::one_part(frame), {}, {});
  CHECK(faults_of(frame, ring, {}) == none);
  // The hole of a ring has room for one of the four inner walls, so one net of whole panels doesn't exist:
  // with two pieces both rings keep their holes.
  REQUIRE(ring.pieces.size() == 2);
  CHECK(ring.pieces[PieceId(0)].holes + ring.pieces[PieceId(1)].holes == 2);
  // One piece there is where a ring may be cut.
  unfold::Options fewest;
  fewest.panel_cuts = unfold::PanelCuts::before_pieces;
  const Nets cut = unfold::unfold(frame, test::flat_panels(frame), test::one_part(frame), fewest, {});
  CHECK(faults_of(frame, cut, {}) == none);
  REQUIRE(cut.pieces.size() == 1);
}

TEST_CASE("parts that aren't connected become pieces of their own", "[unfold]") {
  const mesh::Surface s = test::voxels({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}});
  const Nets nets = unfold::unfold(s, test::flat_panels(s), test::one_part(s), {}, {});
  CHECK(faults_of(s, nets, {}) == none);
  REQUIRE(nets.pieces.size() == 3);
  int components = 0;
  for (const auto& piece : nets.pieces) {
    components += piece.reason == PieceReason::component ? 1 : 0;
  }
  CHECK(components == 2);
}

TEST_CASE("a net larger than the sheet is split, as seldom as possible", "[unfold]") {
  const mesh::Surface cube = scaled(test::cube(), 60.0);
  Options options = on_sheet(200.0, 150.0);
  const Nets nets = unfold::unfold(cube, test::flat_panels(cube), test::one_part(cube), options, {});
  CHECK(faults_of(cube, nets, options) == none);
  CHECK(nets.pieces.size() == 2);
  int for_page = 0;
  for (const auto& piece : nets.pieces) {
    for_page += piece.reason == PieceReason::page ? 1 : 0;
  }
  CHECK(for_page == 1);
}

TEST_CASE("a face that no sheet holds is refused with its name", "[unfold]") {
  const mesh::Surface cube = scaled(test::cube(), 60.0);
  REQUIRE_THROWS_AS(
      unfold::unfold(cube, test::flat_panels(cube), test::one_part(cube), on_sheet(30.0, 30.0), {}), Error);
}

TEST_CASE("a stop request interrupts", "[unfold]") {
  const mesh::Surface s = test::sphere(16, 8);
  StopSource source;
  source.request_stop();
  Context context;
  context.stop = source.get_token();
  REQUIRE_THROWS_AS(unfold::unfold(s, test::no_panels(s), test::one_part(s), {}, context), Error);
}

TEST_CASE("a deadline that has passed still gives clean nets", "[unfold]") {
  const mesh::Surface s = scaled(test::sphere(20, 12), 75.0);
  Context context;
  context.deadline = Deadline::in(0.0);
  const Options options = on_sheet(190, 277);
  const auto joins_of = [&](const Nets& nets, unfold::NoTab reason) {
    return std::count_if(nets.joins.begin(), nets.joins.end(),
                         [&](const unfold::Join& join) { return join.no_tab == reason; });
  };
  const Nets nets = unfold::unfold(s, test::no_panels(s), test::one_part(s), options, context);
  CHECK(faults_of(s, nets, options) == none);
  CHECK(nets.tabs.empty());
  CHECK(joins_of(nets, unfold::NoTab::time_up) == static_cast<std::ptrdiff_t>(nets.joins.size()));
  // With a moment more everything is there that belongs to a finished net.
  context.grace_s = 3600.0;
  const Nets finished = unfold::unfold(s, test::no_panels(s), test::one_part(s), options, context);
  CHECK(faults_of(s, finished, options) == none);
  CHECK(finished.tabs.size() > finished.joins.size() / 2);
  CHECK(joins_of(finished, unfold::NoTab::time_up) == 0);
}

TEST_CASE("shapes of many kinds unfold cleanly, whole and on a sheet", "[unfold][slow]") {
  const std::vector<mesh::Surface> shapes{
      scaled(test::tetrahedron(), 50.0),
      scaled(test::sphere(16, 8), 75.0),
      scaled(test::revolve({{1, 0}, {1, 1}, {0.5, 2}}, 12), 40.0),                  // open tube
      scaled(test::revolve({{2, -1}, {3, 0}, {2, 1}, {1, 0}, {2, -1}}, 10), 25.0),  // torus
      scaled(test::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, 1, 1}}, 2), 40.0),
      scaled(
          test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {-1, 0, 0}, {0, 0, -1}}, 1),
          40.0),
  };
  for (const mesh::Surface& s : shapes) {
    for (const bool sheet : {false, true}) {
      for (const bool panels : {false, true}) {
        const Options options = sheet ? on_sheet(190, 277) : Options{};
        const Nets nets = unfold::unfold(s, panels ? test::flat_panels(s) : test::no_panels(s),
                                         test::one_part(s), options, {});
        CHECK(faults_of(s, nets, options) == none);
        if (!sheet) {
          CHECK(nets.pieces.size() == 1);
        }
      }
    }
  }
}

TEST_CASE("threads change nothing", "[threads][unfold][slow]") {
  const mesh::Surface s = scaled(test::sphere(24, 16), 75.0);
  IdVector<FaceId, PartId> part(s.face_count());
  for (const FaceId f : ids<FaceId>(s.face_count())) {
    part[f] = PartId(f.value() % 48 / 8);
  }
  Context one;
  Context two;
  two.threads = 2;
  const Nets a = unfold::unfold(s, test::no_panels(s), part, on_sheet(190, 277), one);
  const Nets b = unfold::unfold(s, test::no_panels(s), part, on_sheet(190, 277), two);
  CHECK(faults_of(s, a, on_sheet(190, 277)) == none);
  CHECK(same(a, b));
}

TEST_CASE("the shared models become one net each, and the one without a net becomes few pieces",
          "[unfold][models][slow]") {
  const auto models = test::shared_models();
  if (models.empty()) {
    WARN("../shared/models/unfold is missing: skipped");
    return;
  }
  for (const std::string& path : models) {
    DYNAMIC_SECTION(path) {
      const mesh::Surface read = test::read_off(path);
      const mesh::Surface s = scaled(read, 150.0 / test::whole_patch(read, test::no_panels(read)).extent);
      Options options;
      options.pieces = unfold::rules_of_single_parts();
      options.pieces.trials_per_face = 0.0;  // nothing is left to mend
      options.panel_cuts = unfold::PanelCuts::before_pieces;
      const Nets nets = unfold::unfold(s, test::flat_panels(s), test::one_part(s), options, {});
      CHECK(faults_of(s, nets, options) == none);
      const bool hopeless = path.find("ununfoldable") != std::string::npos;
      CHECK(nets.pieces.size() >= (hopeless ? 2U : 1U));
      CHECK(nets.pieces.size() <= (hopeless ? 3U : 1U));
    }
  }
}

TEST_CASE("tabs that stick out of the sheet are dropped, with the reason", "[unfold]") {
  const mesh::Surface cube = scaled(test::cube(), 60.0);
  const Options options = on_sheet(61.0, 61.0);
  const Nets nets = unfold::unfold(cube, test::flat_panels(cube), test::one_part(cube), options, {});
  CHECK(faults_of(cube, nets, options) == none);
  CHECK(nets.tabs.empty());
  for (const auto& join : nets.joins) {
    CHECK(join.no_tab == unfold::NoTab::beyond_sheet);
  }
}

TEST_CASE("tabs that stick out of the sheet go where there is room on it", "[unfold]") {
  // Each square has room for a tab on one of two opposite sides.
  const mesh::Surface cube = scaled(test::cube(), 60.0);
  const Options options = on_sheet(65.5, 65.5);
  const Nets nets = unfold::unfold(cube, test::flat_panels(cube), test::one_part(cube), options, {});
  CHECK(nets.pieces.size() == 6);
  CHECK(faults_of(cube, nets, options) == none);
  CHECK(nets.tabs.size() >= 8);
  for (const auto& join : nets.joins) {
    CHECK(join.no_tab == (join.tab.valid() ? unfold::NoTab::has_tab : unfold::NoTab::beyond_sheet));
  }
}

TEST_CASE("flat regions that are cut may lie in several pieces", "[unfold][slow]") {
  // Rings whose holes hold too few walls, on a sheet that they don't fit: panels are cut and pieces are
  // split.
  const mesh::Surface frame =
      scaled(test::voxels(
                 {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}}, 2),
             40.0);
  for (const double size : {60.0, 90.0, 130.0, 200.0, 300.0}) {
    const Options options = on_sheet(size, 1.4 * size);
    const Nets nets = unfold::unfold(frame, test::flat_panels(frame), test::one_part(frame), options, {});
    CHECK(faults_of(frame, nets, options) == none);
  }
}
