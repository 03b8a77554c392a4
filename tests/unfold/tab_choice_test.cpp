// SPDX-License-Identifier: GPL-3.0-or-later
// Which joins get a tab, on which side, and why others get none.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <catch2/catch.hpp>

#include "mesh/mesh.hpp"
#include "support/flat_panels.hpp"
#include "support/shapes.hpp"
#include "unfold/tabs_checks.hpp"
#include "unfold/tree_nets.hpp"
#include "unfold/unfold.hpp"

using namespace ridgecraft;
using mesh::Surface;
using prepare::Panels;
using test::check_tabs;
using test::flat_panels;
using test::panels_first;
using test::with_tabs;
using unfold::Nets;
using unfold::NoTab;
using unfold::Tab;
using unfold::TabOptions;

TEST_CASE("nothing is glued behind a face without area", "[tabs]") {
  // A tetrahedron with a sliver between two of its faces.
  const double height = GENERATE(0.0, 1e-9, 1e-6);
  const std::vector<Vec3> points{{0, 0, 0}, {60, 0, 0}, {30, 50, 0}, {30, 20, 45}, {30, -height, 0}};
  const auto v = [](int i) { return VertexId(i); };
  const Surface shape(points, {{v(0), v(2), v(1)},
                               {v(1), v(2), v(3)},
                               {v(2), v(0), v(3)},
                               {v(0), v(4), v(3)},
                               {v(4), v(1), v(3)},
                               {v(0), v(1), v(4)}});
  // Every face its own panel, so the sliver stands alone.
  Panels panels;
  panels.panel = IdVector<FaceId, PanelId>(shape.face_count());
  for (const FaceId f : ids<FaceId>(shape.face_count())) {
    panels.panel[f] = panels.faces.push_back({f});
  }
  std::size_t cut_around_sliver = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Nets nets = with_tabs(shape, panels, test::lay_out(shape, test::random_order(shape, seed)));
    for (const Tab& tab : nets.tabs) {
      CHECK(shape.neighbor(tab.side) != FaceId(5));
    }
    for (unsigned k = 0; k < 3; ++k) {
      const bool is_fold = nets.use[shape.edge(mesh::corner(FaceId(5), k))] == unfold::EdgeUse::fold;
      cut_around_sliver += is_fold ? 0U : 1U;
    }
  }
  CHECK(cut_around_sliver >= 12);
}

TEST_CASE("panels that are cut between pieces are folded nowhere else", "[tabs][slow]") {
  const std::filesystem::path file =
      std::string(RIDGECRAFT_SHARED_DIR) + "/models/unfold/frame_genus5_240.off";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: " << file << " is missing");
    return;
  }
  const Surface frame = [&] {
    const Surface read = mesh::read(file, {}, Context()).surface;
    const Vec3 size = read.bounds().size();
    return test::scaled(read, 150.0 / std::max({size.x, size.y, size.z}));
  }();
  unfold::Options options;
  options.sheet = unfold::Sheet{190.0, 277.0};
  const Nets nets =
      unfold::unfold(frame, prepare::find_panels(frame),
                     IdVector<FaceId, PartId>(frame.face_count(), PartId(0)), options, Context());
  for (const EdgeId e : ids<EdgeId>(frame.edge_count())) {
    const auto [a, b] = frame.sides(e);
    if (nets.use[e] == unfold::EdgeUse::fold) {
      CHECK(nets.piece[mesh::face_of(a)] == nets.piece[mesh::face_of(b)]);
    }
  }
  check_tabs(frame, prepare::find_panels(frame), nets, {});
}

TEST_CASE("what is left without a tab says why", "[tabs]") {
  SECTION("tabs switched off") {
    const Surface cube = test::scaled(test::cube(), 40.0);
    TabOptions off;
    off.wanted = false;
    const Nets nets = with_tabs(cube, flat_panels(cube), test::lay_out(cube, test::breadth_first(cube)), off);
    CHECK(nets.tabs.empty());
    for (const unfold::Join& join : nets.joins) {
      CHECK(join.no_tab == NoTab::not_wanted);
    }
  }
  SECTION("edges of 0.9 mm") {
    const Surface cube = test::scaled(test::cube(), 0.9);
    const Nets nets = with_tabs(cube, flat_panels(cube), test::lay_out(cube, test::breadth_first(cube)));
    for (const unfold::Join& join : nets.joins) {
      CHECK((join.tab.valid() || join.no_tab != NoTab::has_tab));
      if (cube.length(join.edge) < 1.0) {
        CHECK(join.no_tab == NoTab::edge_too_short);
      }
    }
  }
  SECTION("a ridge 60 mm long between strips of 1 mm") {
    const std::vector<Vec3> points{{0, 0, 0}, {60, 0, 0}, {60, 1, 0}, {0, 1, 0}, {30, 0.5, 0.3}};
    const auto v = [](int i) { return VertexId(i); };
    const Surface lens(points, {{v(0), v(2), v(1)},
                                {v(0), v(3), v(2)},
                                {v(0), v(1), v(4)},
                                {v(1), v(2), v(4)},
                                {v(2), v(3), v(4)},
                                {v(3), v(0), v(4)}});
    const Nets nets = with_tabs(lens, flat_panels(lens), test::lay_out(lens, test::random_order(lens, 3)));
    for (const unfold::Join& join : nets.joins) {
      if (lens.length(join.edge) > 20.0) {
        CHECK((join.no_tab == NoTab::target_too_small || join.no_tab == NoTab::too_little_paper));
      }
    }
  }
  SECTION("a flat slit") {
    const Surface grid = test::scaled(test::flat_grid(3), 30.0);
    const Nets nets = with_tabs(grid, flat_panels(grid), test::lay_out(grid, test::random_order(grid, 2)));
    for (const unfold::Join& join : nets.joins) {
      CHECK(join.no_tab == NoTab::no_room);
    }
  }
}

TEST_CASE("the smaller face gives the tab, the larger receives it", "[tabs]") {
  // A tall box without a lid: its bottom is smaller than its walls.
  const Surface box = [] {
    const Surface cube = test::cube();
    std::vector<Vec3> points(cube.points().begin(), cube.points().end());
    for (Vec3& p : points) {
      p = {30.0 * p.x, 30.0 * p.y, 70.0 * p.z};
    }
    std::vector<std::array<VertexId, 3>> faces;
    for (const FaceId f : ids<FaceId>(cube.face_count())) {
      if (cube.normal(f).z < 0.5) {
        faces.push_back(cube.vertices(f));
      }
    }
    // Vertices of the lid are still those of the walls.
    return Surface(points, faces);
  }();
  const Panels panels = flat_panels(box);
  CHECK(panels.count() == 5);
  const Nets nets = with_tabs(box, panels, test::lay_out(box, panels_first(box)));
  check_tabs(box, panels, nets, {});
  CHECK(nets.tabs.size() == nets.joins.size());
  for (const Tab& tab : nets.tabs) {
    const bool bottom_gives = box.normal(mesh::face_of(tab.side)).z < -0.5;
    const bool bottom_receives = box.normal(box.neighbor(tab.side)).z < -0.5;
    CHECK((bottom_gives || !bottom_receives));
  }
}
