// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing hangs on a thread of paper, and tabs hang on paper.
#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "support/shapes.hpp"
#include "unfold/energy/tree_shape.hpp"
#include "unfold/nets_checks.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/tabs/place/sites.hpp"

using namespace ridgecraft;
using unfold::EdgeUse;
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
      folds[side] = patch.twin[side] != no_index ? 1 : 0;
    }
    const double dear = width < unfold::thread_mm ? unfold::thread_cost : 0.0;
    unfold::Forest forest(patch);
    forest.set_folds(folds);
    const unfold::Room room{};
    unfold::TreeShape shape(patch, {}, room, thin);
    for (std::uint32_t root = 0; root < 3; ++root) {
      CHECK(shape.measure(forest, folds, root, nullptr).cost == Approx(dear));
    }
  }
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
