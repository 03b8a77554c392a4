// SPDX-License-Identifier: GPL-3.0-or-later
// Fine models become foldable ones.
#include "prepare/simplify/simplify.hpp"

#include "mesh/mesh.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/collapses/collapse_sequence.hpp"
#include "prepare/common_models.hpp"
#include "prepare/prepare.hpp"
#include "prepare/walls/fold_figures.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::Prepared;
using prepare::SimplifyOptions;
using test::free_points;
using test::page;
using test::ring;

namespace {

Prepared simplified(const mesh::Surface& surface, const SimplifyOptions& options = {},
                    const prepare::SizeOptions& size = {}) {
  return prepare::prepare(test::repaired(test::soup_of(surface)), size, options, page, {});
}

/// Greatest distance of the points of a from b, by brute force.
double farthest(const mesh::Surface& a, const mesh::Surface& b) {
  double greatest = 0.0;
  for (const Vec3 p : a.points()) {
    double nearest = INFINITY;
    for (const FaceId f : ids<FaceId>(b.face_count())) {
      const auto [u, v, w] = b.vertices(f);
      nearest = std::min(nearest, mesh::squared_distance(b.point(u), b.point(v), b.point(w), p));
    }
    greatest = std::max(greatest, std::sqrt(nearest));
  }
  return greatest;
}

}  // namespace

TEST_CASE("a fine sphere is simplified until it can be folded, within the deviation", "[simplify]") {
  const mesh::Surface fine = test::sphere(120, 60);
  // A scale, so that both surfaces stay in one frame: for a size the simplified one is scaled and centred
  // anew.
  prepare::SizeOptions size;
  size.mm_per_unit = 75.0;
  const Prepared p = simplified(fine, {}, size);
  test::check_invariants(p.model.surface);
  CHECK(p.simplified.short_edges_before > 0.1);
  CHECK(p.simplified.short_edges_after <= 0.1);
  CHECK_FALSE(p.simplified.still_too_fine);
  CHECK(p.simplified.faces_after > 300);
  CHECK(p.simplified.faces_after < 4000);
  CHECK(p.simplified.deviation_mm <= 3.0);
  CHECK(test::border_edges(p.model.surface) == 0);
  CHECK(test::euler(p.model.surface) == 2);
  // What the report says is what brute force finds.
  SimplifyOptions keep;
  keep.mode = prepare::Simplification::keep;
  const Prepared whole = simplified(fine, keep, size);
  CHECK(farthest(p.model.surface, whole.model.surface) <= p.simplified.deviation_mm + 1e-9);
  CHECK(farthest(whole.model.surface, p.model.surface) <= p.simplified.deviation_mm + 1e-9);
  // No edge is folded shut.
  for (const EdgeId e : ids<EdgeId>(p.model.surface.edge_count())) {
    CHECK(std::abs(p.model.surface.fold_angle(e)) < 2.8);
  }
}

TEST_CASE("a simplified model has the size that was asked for", "[simplify]") {
  const Prepared p = simplified(test::sphere(120, 60));
  REQUIRE(p.simplified.faces_after < p.simplified.faces_before);
  const Vec3 size = p.model.surface.bounds().size();
  CHECK(std::max({size.x, size.y, size.z}) == Approx(150.0).margin(1e-9));
}

TEST_CASE("what can be folded stays as it is", "[simplify]") {
  const Prepared p = simplified(test::sphere(16, 8));
  CHECK(p.simplified.faces_after == 16 * 14);
  CHECK(p.simplified.deviation_mm == 0.0);
  const Prepared cube = simplified(test::voxels({{0, 0, 0}}, 40));
  CHECK(cube.simplified.faces_after == 12);
}

TEST_CASE("a count is kept to, and genus and borders stay", "[simplify]") {
  SimplifyOptions options;
  options.mode = prepare::Simplification::count;
  options.faces = 300;
  const Prepared torus = simplified(test::revolve(ring, 100), options);
  CHECK(torus.simplified.faces_after <= 300);
  CHECK(torus.simplified.faces_after >= 290);
  CHECK(test::euler(torus.model.surface) == 0);
  test::check_invariants(torus.model.surface);
  options.faces = 60;
  const Prepared tube = simplified(test::revolve({{1, 0}, {1.1, 0.5}, {1.05, 1}, {1, 1.5}}, 80), options);
  CHECK(test::euler(tube.model.surface) == 0);
  CHECK(test::border_edges(tube.model.surface) > 0);
  // Its rims stay where they are.
  const Vec3 size = tube.model.surface.bounds().size();
  CHECK(std::max({size.x, size.y, size.z}) == Approx(150.0).epsilon(0.02));
}

TEST_CASE("positions stay doubles on the way through CGAL and OpenMesh", "[simplify]") {
  const mesh::Surface fine = test::sphere(40, 20);
  const mesh::Model model = test::repaired(test::soup_of(fine));
  const mesh::LooseFaces loose = mesh::take_apart(model);
  const std::vector<prepare::Collapse> collapses =
      prepare::collapse_sequence(loose, free_points(loose), {}, 200, {}, {});
  REQUIRE(collapses.size() > 100);
  std::array<int, 3> doubles{};
  for (const prepare::Collapse& c : collapses) {
    const std::array<double, 3> p{c.place.x, c.place.y, c.place.z};
    for (std::size_t k = 0; k < 3; ++k) {
      doubles[k] += p[k] != static_cast<double>(static_cast<float>(p[k])) ? 1 : 0;
    }
  }
  for (const int count : doubles) {
    CHECK(count > 50);
  }
}

TEST_CASE("a sequence can be stopped anywhere", "[simplify]") {
  const mesh::Model model = test::repaired(test::soup_of(test::revolve(ring, 30)));
  const mesh::LooseFaces loose = mesh::take_apart(model);
  const std::vector<prepare::Collapse> collapses =
      prepare::collapse_sequence(loose, free_points(loose), {}, 0, {}, {});
  REQUIRE(collapses.size() > 100);
  for (std::size_t count = 0; count <= collapses.size(); count += 10) {
    const mesh::LooseFaces faces = prepare::replay(loose, std::span(collapses).first(count));
    CHECK(faces.faces.size() == (count == 0 ? loose.faces.size() : collapses[count - 1].faces));
    CHECK(mesh::is_surface(faces));
  }
}

TEST_CASE("short folds are counted at the size that was asked for", "[simplify]") {
  // The sphere loses its outermost points and is scaled anew: folds grow with it.
  const prepare::SimplifyOptions options;
  for (const double size_mm : {60.0, 100.0, 150.0}) {
    prepare::SizeOptions size;
    size.largest_extent_mm = size_mm;
    const Prepared p = simplified(test::sphere(120, 60), options, size);
    REQUIRE(p.simplified.faces_after < p.simplified.faces_before);
    CHECK(p.simplified.short_edges_after == prepare::fold_figures(p.model.surface, options).brief_share());
  }
}
