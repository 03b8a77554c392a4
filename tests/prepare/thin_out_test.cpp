// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth models of very many faces, of which most go before anything else is done.
#include "prepare/simplify/thin_out.hpp"

#include <cmath>

#include "mesh/model/surface_distance.hpp"
#include "prepare/common_models.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/simplify/many_faces.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;

namespace {

constexpr double symmetric_within = 0.004;

/// A lump of 60 mm with the same bumps on both sides of x = 0, which stands on a flat foot.
mesh::Model lump() {
  const mesh::Surface round = test::sphere(330, 170);
  std::vector<Vec3> points;
  for (const Vec3 p : round.points()) {
    const double bump =
        1.0 + 0.08 * std::cos(5.0 * p.x) * std::sin(4.0 * p.y + 1.0) + 0.05 * std::sin(7.0 * p.z + 3.0 * p.y);
    points.push_back({30.0 * bump * p.x, 30.0 * bump * p.y, std::max(-18.0, 30.0 * bump * p.z)});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(round.face_count())) {
    faces.push_back(round.vertices(f));
  }
  return test::model_of(mesh::Surface(std::move(points), std::move(faces)));
}

}  // namespace

TEST_CASE("a dense smooth model keeps its shape, its foot and its symmetry with far fewer faces",
          "[thin_out]") {
  mesh::Model model = lump();
  const mesh::Surface before = model.surface;
  REQUIRE(prepare::is_dense(before, {}));
  const auto dense = prepare::thin_out(model, symmetric_within, {}, {});
  REQUIRE(dense);
  CHECK(dense->before.face_count() == before.face_count());
  CHECK(test::euler(model.surface) == 2);
  // What is left of the foot is its outline with all that is within it.
  double foot = 0.0;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    foot += model.surface.normal(f).z < -0.9999 ? model.surface.area(f) : 0.0;
  }
  double foot_before = 0.0;
  std::size_t of_foot = 0;
  for (const FaceId f : ids<FaceId>(before.face_count())) {
    foot_before += before.normal(f).z < -0.9999 ? before.area(f) : 0.0;
    of_foot += before.normal(f).z < -0.9999 ? 1U : 0U;
  }
  CHECK(foot == Approx(foot_before).epsilon(1e-3));
  CHECK(model.surface.face_count() <
        prepare::quick * prepare::careless_faces(before, prepare::SimplifyOptions{}.short_edge_mm) + of_foot +
            2000);
  // A tenth of what it may move in the mean of squares; at the worst place it's more.
  const double may_move = prepare::SimplifyOptions{}.largest_deviation * before.bounds().largest_extent();
  CHECK(greatest_distance(mesh::SurfaceTree(model.surface, 0.5), mesh::SurfaceTree(before, 0.5), INFINITY,
                          {}) < 0.5 * may_move);
  const auto mirrors = prepare::find_mirrors(model.surface, 1);
  REQUIRE(mirrors.size() == 1);
  CHECK(mirrors[0].exact);
  CHECK(std::abs(mirrors[0].plane.normal.x) == Approx(1.0));
}

TEST_CASE("what has walls isn't thinned out", "[thin_out]") {
  const mesh::Surface surface = test::scaled(test::voxels({{0, 0, 0}}, 100), 30.0);
  mesh::Model model = test::model_of(surface);
  CHECK(prepare::is_dense(model.surface, {}));
  CHECK_FALSE(prepare::thin_out(model, symmetric_within, {}, {}));
  CHECK(model.surface.face_count() == surface.face_count());
}

TEST_CASE("a model that is no finer than its folds can be long isn't dense", "[thin_out]") {
  CHECK_FALSE(prepare::is_dense(test::scaled(test::sphere(40, 20), 30.0), {}));
  CHECK_FALSE(prepare::is_dense(test::scaled(test::sphere(330, 170), 300.0), {}));
}
