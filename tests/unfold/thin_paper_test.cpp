// SPDX-License-Identifier: GPL-3.0-or-later
// Needles stay with a neighbour, and tabs hang on paper.
#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/energy/piece_cost.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/pieces/kept_edges.hpp"
#include "unfold/tabs/place/sites.hpp"

using namespace ridgecraft;
using unfold::EdgeUse;
using unfold::EdgeWish;
using unfold::EdgeWishes;
using unfold::Nets;

namespace {

/// A box of 40 by 30 mm and this height, its squares divided, each face in its flat region.
mesh::Surface plate(double height) {
  std::vector<Vec3> points;
  const mesh::Surface cube = test::cube();
  for (const Vec3 p : cube.points()) {
    points.push_back({40.0 * p.x, 30.0 * p.y, height * p.z});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(cube.face_count())) {
    faces.push_back(cube.vertices(f));
  }
  return mesh::Surface(std::move(points), std::move(faces));
}

Nets nets_of(const mesh::Surface& surface, const prepare::Panels& panels) {
  return unfold::unfold(surface, panels, test::one_part(surface), test::on_sheet(200.0, 200.0), Context());
}

}  // namespace

TEST_CASE("a flat region too narrow to cut out keeps its longest edge", "[unfold]") {
  const mesh::Surface surface = plate(0.6);
  const prepare::Panels panels = test::flat_panels(surface);
  const EdgeWishes wishes = unfold::with_needles_kept(surface, panels, {});
  std::size_t kept = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (wishes[e] == EdgeWish::needle) {
      ++kept;
      CHECK(surface.length(e) >= 30.0);
    }
  }
  CHECK(kept == 4);
  const Nets nets = nets_of(surface, panels);
  CHECK(test::faults_of(surface, nets, test::on_sheet(200.0, 200.0)).empty());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    CHECK((wishes[e] != EdgeWish::needle || nets.use[e] == EdgeUse::fold));
  }
}

TEST_CASE("nothing hangs on a thread of paper", "[unfold]") {
  // A strip along which two flaps hang, one at either end, and a third all along its other side.
  for (const double width : {0.02, 0.5, 3.0}) {
    const std::vector<Vec3> points{{0, 0, 0},      {10, 0, 0},    {75, 0, 0},     {86, 0, 0},
                                   {86, width, 0}, {0, width, 0}, {0, 0, -20},    {10, 0, -20},
                                   {75, 0, -20},   {86, 0, -20},  {0, width, 30}, {86, width, 30}};
    std::vector<std::array<VertexId, 3>> faces;
    for (const auto& [a, b, c] : std::vector<std::array<std::uint32_t, 3>>{{0, 1, 5},
                                                                           {1, 2, 5},
                                                                           {2, 4, 5},
                                                                           {2, 3, 4},
                                                                           {1, 0, 6},
                                                                           {1, 6, 7},
                                                                           {3, 2, 8},
                                                                           {3, 8, 9},
                                                                           {5, 4, 10},
                                                                           {4, 11, 10}}) {
      faces.push_back({VertexId(a), VertexId(b), VertexId(c)});
    }
    const mesh::Surface surface(points, faces);
    const EdgeWishes wishes = unfold::with_needles_kept(surface, test::flat_panels(surface), {});
    CAPTURE(width);
    if (width > 1.0) {
      CHECK(wishes.empty());
      continue;
    }
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      const double mm = surface.length(e);
      const bool flap = !surface.is_border(e) && (std::abs(mm - 10.0) < 1e-9 || std::abs(mm - 11.0) < 1e-9);
      const bool wall = !surface.is_border(e) && std::abs(mm - 86.0) < 1e-9;
      // The flaps lie across from the long flap that the strip stays with: all three fold as at one edge.
      CHECK((!wall || wishes[e] == EdgeWish::needle));
      CHECK((!flap || wishes[e] == EdgeWish::none));
    }
    // Without that one the strip stays with the larger flap, and the other is cut off it.
    faces.resize(faces.size() - 2);
    const mesh::Surface two({points.begin(), points.end() - 2}, faces);
    const EdgeWishes apart = unfold::with_needles_kept(two, test::flat_panels(two), {});
    for (const EdgeId e : ids<EdgeId>(two.edge_count())) {
      if (!two.is_border(e) && std::abs(two.length(e) - 10.0) < 1e-9) {
        CHECK(apart[e] == EdgeWish::cut);
      }
      if (!two.is_border(e) && std::abs(two.length(e) - 11.0) < 1e-9) {
        CHECK(apart[e] == EdgeWish::needle);
      }
    }
  }
}

TEST_CASE("a branch that hangs by a thread is dear in every search", "[energy]") {
  CHECK(unfold::neck_cost(0.9, 30.0) > unfold::thread_cost);
  CHECK(unfold::neck_cost(0.9, 20.0) < unfold::thread_cost);
  CHECK(unfold::neck_cost(1.1, 30.0) < unfold::thread_cost);
  CHECK(unfold::neck_cost(10.0, 30.0) == 0.0);
  unfold::Weights thin;
  for (const std::string_view term : unfold::term_names()) {
    *unfold::weight_named(thin, term) = term == "thin" ? 1.0 : 0.0;
  }
  // A face between two others whose outer side comes near the corner where all three meet.
  for (const double width : {0.5, 1.5}) {
    const std::vector<Vec3> points{{0, 0, 0}, {15, width, 0}, {-15, width, 0}, {10, -15, 0}, {-10, -15, 0}};
    const std::vector<std::array<VertexId, 3>> faces{{VertexId(0), VertexId(1), VertexId(2)},
                                                     {VertexId(1), VertexId(0), VertexId(3)},
                                                     {VertexId(0), VertexId(2), VertexId(4)}};
    const mesh::Surface surface(points, faces);
    const unfold::Patch patch = unfold::make_patch(surface, test::no_panels(surface),
                                                   std::vector<FaceId>{FaceId(0), FaceId(1), FaceId(2)});
    unfold::Folds folds(patch.twin.size());
    for (std::uint32_t side = 0; side < folds.size(); ++side) {
      folds[side] = patch.twin[side] != unfold::nothing ? 1 : 0;
    }
    const double dear = width < unfold::thread_mm ? unfold::thread_cost : 0.0;
    CHECK(unfold::cost_of_piece(patch, folds, unfold::one_part, thin) == Approx(dear));
    unfold::RootedNet net(patch);
    net.set_tree(folds);
    const unfold::Room room{};
    unfold::PieceShape shape(patch, room, thin);
    for (std::uint32_t root = 0; root < 3; ++root) {
      CHECK(shape.measure(net, folds, root, nullptr, {}).cost == Approx(dear));
    }
  }
}

TEST_CASE("what is wide enough, or wished for, isn't kept as a needle", "[unfold]") {
  const mesh::Surface thick = plate(1.5);
  CHECK(unfold::with_needles_kept(thick, test::flat_panels(thick), {}).empty());
  const mesh::Surface thin = plate(0.6);
  const EdgeWishes all_cut(thin.edge_count(), EdgeWish::cut);
  const EdgeWishes wishes = unfold::with_needles_kept(thin, test::flat_panels(thin), all_cut);
  CHECK(std::all_of(wishes.begin(), wishes.end(), [](EdgeWish wish) { return wish == EdgeWish::cut; }));
}

TEST_CASE("paper behind a cut is measured over folds, up to the next cut", "[unfold]") {
  for (const double height : {1.5, 2.5}) {
    const mesh::Surface surface = plate(height);
    const Nets nets = nets_of(surface, test::flat_panels(surface));
    std::size_t thin = 0;
    for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
      for (const CornerId side : surface.sides(e)) {
        thin += nets.use[e] == EdgeUse::cut && !unfold::enough_paper_behind(surface, nets, side) ? 1U : 0U;
      }
    }
    // A wall hangs on a large square or ends at a cut on its other side, too; nothing else is thin.
    CAPTURE(height);
    CHECK((height > 2.0 ? thin == 0 : thin <= 8));
  }
}

TEST_CASE("every tab hangs on paper", "[unfold]") {
  Random random(3);
  for (int round = 0; round < 6; ++round) {
    const mesh::Surface surface = test::scaled(test::sphere(8 + round, 5), 4.0 + 4.0 * random.unit());
    const prepare::Panels panels = test::no_panels(surface);
    const Nets nets = nets_of(surface, panels);
    for (const unfold::Tab& tab : nets.tabs) {
      CHECK(unfold::enough_paper_behind(surface, nets, tab.side));
    }
  }
}
