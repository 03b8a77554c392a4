// SPDX-License-Identifier: GPL-3.0-or-later
// Fine models become foldable ones.
#include "prepare/simplify/simplify.hpp"

#include <cmath>

#include "mesh/mesh.hpp"
#include "mesh/model/surface_distance.hpp"
#include "prepare/collapses/collapse_sequence.hpp"
#include "prepare/collapses/quick_collapses.hpp"
#include "prepare/common_models.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/simplify/body.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "prepare/walls/walls.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"
#include "support/soups.hpp"

using namespace ridgecraft;
using prepare::Prepared;
using prepare::SimplifyOptions;
using test::free_domain;
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
  CHECK(prepare::can_be_folded(p));
  CHECK(prepare::minutes_of(p.work) <= 1.05 * 240.0);
  CHECK(p.simplified.faces_after > 150);
  CHECK(p.simplified.faces_after < 400);
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
      prepare::collapse_sequence(free_domain(loose), {}, {.faces = 200}, {});
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
  const std::vector<prepare::Collapse> collapses = prepare::collapse_sequence(free_domain(loose), {}, {}, {});
  REQUIRE(collapses.size() > 100);
  for (std::size_t count = 0; count <= collapses.size(); count += 10) {
    const mesh::LooseFaces faces = prepare::replay(loose, std::span(collapses).first(count));
    CHECK(faces.faces.size() == (count == 0 ? loose.faces.size() : collapses[count - 1].faces));
    CHECK(mesh::is_surface(faces));
  }
}

TEST_CASE("work is counted at the size that was asked for", "[simplify]") {
  // The sphere loses its outermost points and is scaled anew: folds grow with it.
  const prepare::SimplifyOptions options;
  for (const double size_mm : {60.0, 100.0, 150.0}) {
    prepare::SizeOptions size;
    size.largest_extent_mm = size_mm;
    const Prepared p = simplified(test::sphere(120, 60), options, size);
    REQUIRE(p.simplified.faces_after < p.simplified.faces_before);
    const prepare::Work again =
        prepare::expected_work(p.model.surface, p.panels, p.rolls, options.hidden_fold_angle);
    CHECK(prepare::minutes_of(p.work) == prepare::minutes_of(again));
  }
}

// Models of very many faces.

namespace {

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

TEST_CASE("a model of very many faces keeps its shape, its foot and its symmetry", "[simplify]") {
  mesh::Model model = lump();
  const mesh::Surface before = model.surface;
  REQUIRE(before.face_count() > 100000);
  const SimplifyOptions options;
  static_cast<void>(prepare::simplify(model, options, {}));
  CHECK(test::euler(model.surface) == 2);
  CHECK(model.surface.face_count() <= 400);
  const auto foot = [](const mesh::Surface& surface) {
    double area = 0.0;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      area += surface.normal(f).z < -0.999 ? surface.area(f) : 0.0;
    }
    return area;
  };
  CHECK(foot(model.surface) == Approx(foot(before)).epsilon(0.05));
  CHECK(greatest_distance(mesh::SurfaceTree(model.surface, 0.5), mesh::SurfaceTree(before, 0.5), INFINITY,
                          {}) < options.largest_deviation * before.bounds().largest_extent());
  const auto mirrors = prepare::find_mirrors(model.surface, 1);
  REQUIRE(mirrors.size() == 1);
  CHECK(mirrors[0].exact);
  CHECK(std::abs(mirrors[0].plane.normal.x) == Approx(1.0));
}

// The first collapses of models of very many faces.

namespace {

mesh::LooseFaces fine(const mesh::Surface& surface) {
  return mesh::take_apart(test::repaired(test::soup_of(surface)));
}

mesh::Surface surface_of(const mesh::LooseFaces& loose) {
  mesh::Model model;
  mesh::put_together(model, loose);
  return model.surface;
}

double distance(const mesh::LooseFaces& a, const mesh::LooseFaces& b) {
  const mesh::Surface of_a = surface_of(a);
  const mesh::Surface of_b = surface_of(b);
  return greatest_distance(mesh::SurfaceTree(of_a, 0.05), mesh::SurfaceTree(of_b, 0.05), INFINITY, {});
}

}  // namespace

TEST_CASE("quick collapses leave a surface near the one before, wherever they end", "[quick_collapses]") {
  const mesh::LooseFaces loose = fine(test::sphere(160, 80));
  const auto collapses = prepare::quick_collapses(free_domain(loose), {}, 2000, INFINITY, {});
  REQUIRE(collapses.size() > 10000);
  CHECK(collapses.back().faces <= 2000);
  CHECK(collapses.back().faces >= 1998);
  for (std::size_t count = 1000; count <= collapses.size(); count += 1000) {
    const mesh::LooseFaces faces = prepare::replay(loose, std::span(collapses).first(count));
    CHECK(faces.faces.size() == collapses[count - 1].faces);
    CHECK(mesh::is_surface(faces));
    CHECK(test::euler(surface_of(faces)) == 2);
  }
  // Of a sphere with so many even faces the sides are 0.08 long, and the arrows over them 0.001.
  CHECK(distance(loose, prepare::replay(loose, collapses)) < 0.005);
}

TEST_CASE("quick collapses keep borders, walls and points of a plane", "[quick_collapses]") {
  const mesh::LooseFaces tube = fine(test::revolve({{1, 0}, {1.1, 0.5}, {1.05, 1}, {1, 1.5}}, 80));
  // Two rings are borders, so nothing but the two between can go.
  const auto of_tube = prepare::quick_collapses(free_domain(tube), {}, 0, INFINITY, {});
  for (const prepare::Collapse& c : of_tube) {
    const double height = tube.points[c.gone].z;
    CHECK(height > 0.1);
    CHECK(height < 1.4);
  }
  const mesh::LooseFaces torus = fine(test::revolve(ring, 100));
  prepare::FundamentalDomain domain = free_domain(torus);
  prepare::PointRules& points = domain.points;
  prepare::Walls walls;
  walls.walls.push_back({{0, 0, 1}, 0.5});
  walls.of_face.assign(torus.faces.size(), prepare::Walls::none);
  std::vector<bool> bound(torus.points.size(), false);
  for (std::size_t v = 0; v < torus.points.size(); ++v) {
    if (torus.points[v].x < -2.0) {
      points.plane[v] = 0;
      bound[v] = true;
    }
  }
  points.planes.push_back({{1, 0, 0}, -2.0});
  for (std::size_t f = 0; f < torus.faces.size(); f += 50) {
    walls.of_face[f] = 0;
    for (const std::uint32_t v : torus.faces[f]) {
      bound[v] = true;
    }
  }
  const auto collapses = prepare::quick_collapses(domain, walls, 0, INFINITY, {});
  REQUIRE(collapses.size() > 50);
  for (const prepare::Collapse& c : collapses) {
    CHECK_FALSE(bound[c.gone]);
    CHECK_FALSE(bound[c.stays]);
  }
  const mesh::LooseFaces left = prepare::replay(torus, collapses);
  CHECK(mesh::is_surface(left));
  CHECK(test::euler(surface_of(left)) == 0);
}

TEST_CASE("quick collapses end where nothing is left to be done", "[quick_collapses]") {
  const mesh::LooseFaces cube = fine(test::voxels({{0, 0, 0}}, 1));
  CHECK(prepare::quick_collapses(free_domain(cube), {}, 0, INFINITY, {}).size() <= 4);
  const mesh::LooseFaces nothing =
      prepare::replay(cube, prepare::quick_collapses(free_domain(cube), {}, 0, INFINITY, {}));
  CHECK(mesh::is_surface(nothing));
}
