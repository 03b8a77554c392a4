// SPDX-License-Identifier: GPL-3.0-or-later
// Simplified models are as symmetric as they were.
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "prepare/collapses/collapse_sequence.hpp"
#include "prepare/common_models.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/domains/find_domain.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepare.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "prepare/symmetry/twins.hpp"
#include "support/symmetric_shapes.hpp"

using namespace ridgecraft;
using prepare::FundamentalDomain;
using test::model_of;

namespace {

constexpr prepare::PanelRoom page_with_tabs{{190.0, 270.0}, 8.0};

prepare::Prepared prepared(const mesh::Model& model, std::size_t faces = 0) {
  prepare::SimplifyOptions options;
  if (faces > 0) {
    options.mode = prepare::Simplification::count;
    options.faces = faces;
  }
  return prepare::prepare(model, {}, options, page_with_tabs, {});
}

/// The surface has a plane at which all corners have images, to rounding.
void check_symmetric(const mesh::Surface& surface) {
  prepare::SymmetryTolerance tolerance;
  tolerance.exact = 1e-9;
  const std::vector<prepare::Mirror> found = prepare::find_mirrors(surface, 16, tolerance);
  REQUIRE_FALSE(found.empty());
  CHECK(found[0].exact);
}

/// The largest share of corners that have an image, over planes across the axes: found without the code that
/// is tested.
double share_with_image(const mesh::Surface& surface, double tolerance) {
  const auto mirrored = [](Vec3 p, Vec3 c, int axis) {
    (axis == 0   ? p.x
     : axis == 1 ? p.y
                 : p.z) = axis == 0   ? 2.0 * c.x - p.x
                          : axis == 1 ? 2.0 * c.y - p.y
                                      : 2.0 * c.z - p.z;
    return p;
  };
  const Vec3 centre = 0.5 * (surface.bounds().low + surface.bounds().high);
  double best = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::size_t count = 0;
    for (const Vec3 p : surface.points()) {
      const Vec3 image = mirrored(p, centre, axis);
      count += std::any_of(surface.points().begin(), surface.points().end(),
                           [&](Vec3 q) { return length(q - image) <= tolerance; })
                   ? 1U
                   : 0U;
    }
    best = std::max(best, static_cast<double>(count) / static_cast<double>(surface.vertex_count()));
  }
  return best;
}

/// Radians; pi where the surface is folded shut.
double sharpest_fold(const mesh::Surface& surface) {
  double sharpest = 0.0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    sharpest = std::max(sharpest, std::abs(surface.fold_angle(e)));
  }
  return sharpest;
}

double shortest_edge(const mesh::Surface& surface) {
  double shortest = INFINITY;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    shortest = std::min(shortest, surface.length(e));
  }
  return shortest;
}

}  // namespace

TEST_CASE("a fine symmetric body is simplified symmetrically", "[simplify][symmetry][slow]") {
  const mesh::Surface fine = test::one_plane(120);
  const auto turned = [](Vec3 p) {
    return Vec3{0.6 * p.x - 0.8 * p.y + 3.0, 0.8 * p.x + 0.6 * p.y - 1.0, p.z};
  };
  for (const mesh::Surface& s : {fine, test::mapped(test::shuffled(fine, 3), turned)}) {
    const prepare::Prepared p = prepared(model_of(s));
    REQUIRE(p.simplified.faces_after < p.simplified.faces_before);
    test::check_invariants(p.model.surface);
    check_symmetric(p.model.surface);
    CHECK(p.simplified.deviation_mm <= 3.0);
    CHECK(test::euler(p.model.surface) == 2);
    const prepare::Prepared counted = prepared(model_of(s), 200);
    CHECK(counted.simplified.faces_after <= 200);
    CHECK(counted.simplified.faces_after >= 180);
    check_symmetric(counted.model.surface);
  }
}

TEST_CASE("after any number of collapses the whole is a surface and its own mirror image",
          "[simplify][symmetry]") {
  // Shifted, so that the plane cuts faces, and whole, so that it runs along edges.
  for (const int longitudes : {18, 20}) {
    const mesh::Model model = model_of(test::mapped(test::sphere(longitudes, 12), [](Vec3 p) {
      return Vec3{p.x, 1.7 * p.y + 0.3 * p.z * p.z, p.z + 0.2 * p.y * p.y};
    }));
    const mesh::LooseFaces all = mesh::take_apart(model);
    const FundamentalDomain domain = prepare::fundamental_domain(model, 0.003, {});
    REQUIRE(domain.symmetric());
    const auto collapses = prepare::collapse_sequence(domain, {}, {}, {});
    REQUIRE(collapses.size() > 50);
    for (std::size_t count = 0; count <= collapses.size(); count += 3) {
      const mesh::LooseFaces faces =
          prepare::expand(prepare::collapsed(domain, std::span(collapses).first(count)), all);
      REQUIRE(mesh::is_surface(faces));
      mesh::Model result;
      mesh::put_together(result, faces);
      CHECK(test::euler(result.surface) == 2);
      CHECK(share_with_image(result.surface, 2e-3) == 1.0);
      CHECK(sharpest_fold(result.surface) < 3.0);
      CHECK(shortest_edge(result.surface) > 1e-6);
    }
  }
}

TEST_CASE("flat walls across the plane stay whole", "[simplify][symmetry]") {
  for (mesh::Model model :
       {model_of(test::cube()), model_of(test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}))}) {
    prepare::remesh_panels(model, {});
    const FundamentalDomain domain = prepare::fundamental_domain(model, 0.003, {});
    REQUIRE(domain.symmetric());
    mesh::Model result;
    mesh::put_together(result, prepare::expand(domain, mesh::take_apart(model)));
    CHECK(result.surface.vertex_count() == model.surface.vertex_count());
    CHECK(result.surface.face_count() == model.surface.face_count());
  }
}

TEST_CASE("each side keeps its materials", "[simplify][symmetry]") {
  mesh::Model model = model_of(test::one_plane(80));
  model.materials.resize(2);
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    double x = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
      x += model.surface.point(model.surface.vertex(mesh::corner(f, k))).x;
    }
    model.material.push_back(x > 0.0 ? 0U : 1U);
  }
  const mesh::LooseFaces all = mesh::take_apart(model);
  const FundamentalDomain domain = prepare::fundamental_domain(model, 0.003, {});
  REQUIRE(domain.symmetric());
  const auto check = [&](const mesh::LooseFaces& faces) {
    REQUIRE(faces.material.size() == faces.faces.size());
    for (std::size_t f = 0; f < faces.faces.size(); ++f) {
      double x = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        x += faces.points[faces.faces[f][k]].x;
      }
      CHECK(faces.material[f] == (x > 0.0 ? 0U : 1U));
    }
  };
  check(prepare::expand(domain, all));
  const auto collapses = prepare::collapse_sequence(domain, {}, {.faces = 1000}, {});
  check(prepare::expand(prepare::collapsed(domain, collapses), all));
}

TEST_CASE("what is symmetric by hand becomes exactly symmetric, what is lopsided stays so",
          "[simplify][symmetry][slow]") {
  const auto noisy = [](double size) {
    Random random(9);
    return test::mapped(test::one_plane(120), [&](Vec3 p) {
      const auto noise = [&] { return size * (random.unit() - 0.5); };
      return p + Vec3{noise(), noise(), noise()};
    });
  };
  check_symmetric(prepared(model_of(noisy(0.002))).model.surface);
  const mesh::Surface rough = prepared(model_of(noisy(0.08))).model.surface;
  CHECK(share_with_image(rough, 0.01) < 0.5);
}

TEST_CASE("twins stay twins, and their copies count", "[simplify][symmetry][slow]") {
  const mesh::Surface wheel = test::revolve({{0, 0}, {0.8, 0}, {1, 0.1}, {1, 0.3}, {0.8, 0.4}, {0, 0.4}}, 60);
  const auto at = [&](double angle, Vec3 shift) {
    return test::mapped(wheel, [&](Vec3 p) {
      return Vec3{std::cos(angle) * p.x - std::sin(angle) * p.z, p.y,
                  std::sin(angle) * p.x + std::cos(angle) * p.z} +
             shift;
    });
  };
  // A body with a plane, and wheels on both sides of it; then without a plane.
  const mesh::Surface body = test::one_plane(60);
  const std::vector<mesh::Surface> models{
      test::together(
          {body, at(0.4, {3, 0, 0}), at(-0.4, {-3, 0, 0}), at(0.4, {3, 3, 0}), at(-0.4, {-3, 3, 0})}),
      test::together({body, at(0.4, {3, 0, 0}), at(1.4, {-4, 0, 3}), at(2.2, {3, 5, 1})})};
  for (const mesh::Surface& s : models) {
    const std::size_t wheels = s.component_count() - 1;
    for (const prepare::Prepared& p : {prepared(model_of(s)), prepared(model_of(s), 400)}) {
      REQUIRE(p.simplified.faces_after < p.simplified.faces_before);
      const mesh::Surface& after = p.model.surface;
      test::check_invariants(after);
      CHECK(after.component_count() == s.component_count());
      const auto twins = prepare::find_twins(after, prepare::components(after), {}, 1e-9);
      std::size_t most = 0;
      for (const auto& group : twins) {
        most = std::max(most, group.size());
      }
      CHECK(most == wheels);
    }
    CHECK(prepared(model_of(s), 400).simplified.faces_after <= 400);
    CHECK(prepared(model_of(s), 400).simplified.faces_after >= 360);
  }
}

TEST_CASE("pictures leave a model's shape as it would be without them", "[simplify][symmetry]") {
  const mesh::Surface wheel = test::revolve({{0, 0}, {0.8, 0}, {1, 0.1}, {1, 0.3}, {0.8, 0.4}, {0, 0.4}}, 60);
  const auto at = [&](Vec3 shift) { return test::mapped(wheel, [&](Vec3 p) { return p + shift; }); };
  const mesh::Model plain = model_of(test::together({test::one_plane(60), at({3, 0, 0}), at({-3, 0, 0})}));
  mesh::Model pictured = plain;
  Random random(3);
  for (std::size_t f = 0; f < plain.surface.face_count(); ++f) {
    std::array<Vec2, 3> places;
    for (Vec2& place : places) {
      place = {random.unit(), random.unit()};
    }
    pictured.texture.push_back(places);
  }
  for (const std::size_t faces : {std::size_t{0}, std::size_t{400}}) {
    const prepare::Prepared without = prepared(plain, faces);
    const prepare::Prepared with = prepared(pictured, faces);
    CHECK(without.simplified.faces_after < without.simplified.faces_before);
    CHECK(with.twins.size() == without.twins.size());
    REQUIRE(with.model.surface.vertex_count() == without.model.surface.vertex_count());
    REQUIRE(with.model.surface.face_count() == without.model.surface.face_count());
    CHECK(std::ranges::equal(with.model.surface.points(), without.model.surface.points()));
  }
}

TEST_CASE("a sheet in the mirror plane is kept once", "[simplify][symmetry]") {
  const std::vector<Vec3> corners{{0, 3, 0}, {0, 4, 0}, {0, 4, 1}};
  const mesh::Surface sheet(corners, {{VertexId(0), VertexId(1), VertexId(2)}});
  const mesh::Model model = model_of(test::together({test::one_plane(60), sheet}));
  const FundamentalDomain domain = prepare::fundamental_domain(model, 0.003, {});
  REQUIRE(domain.symmetric());
  mesh::Model result;
  mesh::put_together(result, prepare::expand(domain, mesh::take_apart(model)));
  CHECK(result.surface.component_count() == 2);
  CHECK(result.surface.face_count() == model.surface.face_count());
}

TEST_CASE("models of makers keep every corner's image", "[simplify][symmetry]") {
  namespace fs = std::filesystem;
  const fs::path shared(RIDGECRAFT_SHARED_DIR);
  std::vector<fs::path> folders{fs::path(RIDGECRAFT_SOURCE_DIR) / "samples"};
  if (fs::exists(shared / "models/makers")) {
    folders.push_back(shared / "models/makers");
  } else {
    WARN("skipped the models that aren't ours to ship");
  }
  for (const fs::path& folder : folders) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string suffix = entry.path().extension().string();
      if (suffix != ".obj" && suffix != ".stl" && suffix != ".off" && suffix != ".ply") {
        continue;
      }
      const mesh::Model model = mesh::read(entry.path(), {}, {});
      const double half_mm = 0.5 / 150.0 * model.surface.bounds().largest_extent();
      if (share_with_image(model.surface, half_mm) == 1.0) {
        INFO(entry.path().filename().string());
        const mesh::Surface surface = prepared(model).model.surface;
        CHECK(share_with_image(surface, 0.5) == 1.0);
        CHECK(shortest_edge(surface) > 1e-3);
      }
    }
  }
}
