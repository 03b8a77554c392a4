// SPDX-License-Identifier: GPL-3.0-or-later
// One skin of two bodies against CGAL's own boolean, with exact points.
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "prepare/skin/skin.hpp"
#include "support/soups.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// A prism over a star, an L, a comb or a polygon, turned at random: most aren't convex.
mesh::Model random_body(Random& random) {
  std::vector<Vec2> outline;
  switch (random.below(4)) {
    case 0: {
      const std::uint32_t rays = 3 + random.below(4);
      for (std::uint32_t i = 0; i < 2 * rays; ++i) {
        const double r = i % 2 == 0 ? 1.5 : 0.6;
        const double t = std::numbers::pi * i / rays;
        outline.push_back({r * std::cos(t), r * std::sin(t)});
      }
      break;
    }
    case 1:
      outline = {{0, 0}, {2, 0}, {2, 0.7}, {0.7, 0.7}, {0.7, 2}, {0, 2}};
      break;
    case 2:
      outline = {{0, 0},   {3, 0},   {3, 2},     {2.4, 2},   {2.4, 0.6}, {1.8, 0.6},
                 {1.8, 2}, {1.2, 2}, {1.2, 0.6}, {0.6, 0.6}, {0.6, 2},   {0, 2}};
      break;
    default:
      for (std::uint32_t i = 0; i < 7; ++i) {
        const double t = 2.0 * std::numbers::pi * i / 7.0;
        outline.push_back({1.2 * std::cos(t), 1.2 * std::sin(t)});
      }
  }
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces(2);
  const double height = 0.5 + random.unit();
  for (const double z : {-height, height}) {
    for (const Vec2 p : outline) {
      points.push_back({p.x, p.y, z});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    faces[0].push_back(n - 1 - i);
    faces[1].push_back(n + i);
    faces.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  const double a = 7.0 * random.unit();
  const double b = 7.0 * random.unit();
  const Vec3 shift{random.unit(), random.unit(), random.unit()};
  for (Vec3& p : points) {
    p = {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
    p = Vec3{p.x, p.y * std::cos(b) - p.z * std::sin(b), p.y * std::sin(b) + p.z * std::cos(b)} + shift;
  }
  return test::repaired(test::soup(points, faces));
}

ExactMesh exact(const mesh::Surface& surface) {
  ExactMesh result;
  for (const Vec3 p : surface.points()) {
    result.add_vertex({p.x, p.y, p.z});
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    result.add_face(ExactMesh::Vertex_index(a.value()), ExactMesh::Vertex_index(b.value()),
                    ExactMesh::Vertex_index(c.value()));
  }
  return result;
}

struct Measures {
  double area = 0.0;
  double volume = 0.0;
};

/// Of what can be seen from outside: a cavity between two bodies is a part of CGAL's union, and of no use on
/// paper.
Measures outer_measures(ExactMesh& mesh) {
  const auto component = mesh.add_property_map<ExactMesh::Face_index, std::size_t>("f:component").first;
  std::vector<Measures> of(CGAL::Polygon_mesh_processing::connected_components(mesh, component));
  for (const auto f : mesh.faces()) {
    std::vector<Vec3> corners;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      const Kernel::Point_3& p = mesh.point(v);
      corners.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
    of[component[f]].area += 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
    of[component[f]].volume += dot(corners[0], cross(corners[1], corners[2])) / 6.0;
  }
  Measures sum;
  for (const Measures& one : of) {
    if (one.volume > 0.0) {
      sum.area += one.area;
      sum.volume += one.volume;
    }
  }
  return sum;
}

/// Both in one model, as bodies of their own.
mesh::Model side_by_side(const mesh::Surface& first, const mesh::Surface& second) {
  mesh::Soup together = test::soup_of(first);
  const mesh::Soup other = test::soup_of(second);
  const auto offset = static_cast<std::uint32_t>(together.points.size());
  together.points.insert(together.points.end(), other.points.begin(), other.points.end());
  for (const std::uint32_t p : other.corner_point) {
    together.corner_point.push_back(offset + p);
  }
  while (together.first_corner.back() < together.corner_point.size()) {
    together.first_corner.push_back(together.first_corner.back() + 3);
  }
  return test::repaired(std::move(together));
}

/// The components of a model that are closed and don't run into themselves.
std::vector<mesh::Surface> sound_bodies(const mesh::Surface& surface) {
  std::vector<std::vector<std::array<VertexId, 3>>> faces(surface.component_count());
  std::vector<bool> closed(surface.component_count(), true);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const std::size_t component = surface.component(f).value();
    faces[component].push_back(surface.vertices(f));
    for (unsigned k = 0; k < 3; ++k) {
      closed[component] = closed[component] && surface.twin(mesh::corner(f, k)).valid();
    }
  }
  std::vector<mesh::Surface> bodies;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (!closed[i]) {
      continue;
    }
    std::map<VertexId, VertexId> number;
    std::vector<Vec3> points;
    for (std::array<VertexId, 3>& face : faces[i]) {
      for (VertexId& v : face) {
        const auto [entry, is_new] = number.try_emplace(v, VertexId(points.size()));
        if (is_new) {
          points.push_back(surface.point(v));
        }
        v = entry->second;
      }
    }
    mesh::Surface body(std::move(points), std::move(faces[i]));
    const ExactMesh mesh = exact(body);
    if (!CGAL::Polygon_mesh_processing::does_self_intersect(mesh) && test::volume(body) > 0.0) {
      bodies.push_back(std::move(body));
    }
  }
  return bodies;
}

bool boxes_meet(const Box3& a, const Box3& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y &&
         a.low.z < b.high.z && b.low.z < a.high.z;
}

/// CGAL's union of two bodies; nothing where its corefinement refuses: their union would touch itself.
std::optional<ExactMesh> union_by_cgal(const mesh::Surface& first, const mesh::Surface& second) {
  ExactMesh a = exact(first);
  ExactMesh b = exact(second);
  ExactMesh both;
  if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(a, b, both)) {
    return std::nullopt;
  }
  return both;
}

/// Whether ours of the same two is of one piece, and then of CGAL's volume and area.
bool agrees(const mesh::Surface& first, const mesh::Surface& second, ExactMesh& both) {
  mesh::Model model = side_by_side(first, second);
  const prepare::SkinReport report = prepare::unite_bodies(model, {});
  test::check_invariants(model.surface);
  if (report.united != 2 || report.united_into != 1) {
    return false;
  }
  const Measures wanted = outer_measures(both);
  CHECK(test::area(model.surface) == Approx(wanted.area).epsilon(1e-4));
  CHECK(test::volume(model.surface) == Approx(wanted.volume).epsilon(1e-4));
  return true;
}

}  // namespace

TEST_CASE("volume and surface of twenty unions are those of CGAL's boolean", "[skin]") {
  Random random(20);
  int united = 0;
  for (int pair = 0; pair < 20; ++pair) {
    INFO("pair " << pair);
    const mesh::Model first = random_body(random);
    const mesh::Model second = random_body(random);
    std::optional<ExactMesh> both = union_by_cgal(first.surface, second.surface);
    REQUIRE(both);
    united += agrees(first.surface, second.surface, *both) ? 1 : 0;
  }
  CHECK(united >= 15);
}

TEST_CASE("volume and surface of twenty unions of people's bodies are those of CGAL's boolean", "[skin]") {
  const auto archive = std::filesystem::path(RIDGECRAFT_SHARED_DIR) / "models" / "wild.tar.xz";
  if (!std::filesystem::exists(archive)) {
    WARN("skipped: no models at " << archive.string());
    return;
  }
  const test::TemporaryFolder folder;
  REQUIRE(std::system(("tar xJf '" + archive.string() + "' -C '" + folder.path().string() + "'").c_str()) ==
          0);
  constexpr int most_of_one_model = 6;
  int compared = 0;
  for (const char* const name :
       {"KayKit_Med__building_castle_blue.obj", "KayKit_Med__building_tavern_green.obj",
        "KayKit_Med__building_home_B_red.obj", "KayKit_Med__building_archeryrange_green.obj",
        "KayKit_Cit__car_police.obj", "KayKit_Dun__candle_triple.obj", "KayKit_Dun__pillar_decorated.obj",
        "KayKit_Dun__table_medium_decorated_A.obj"}) {
    const mesh::Model model = mesh::read(folder.path() / "wild" / name, {}, {});
    const std::vector<mesh::Surface> bodies = sound_bodies(model.surface);
    int of_this = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t k = 0; k < i && of_this < most_of_one_model; ++k) {
        INFO(name << ", bodies " << k << " and " << i);
        if (!boxes_meet(bodies[i].bounds(), bodies[k].bounds())) {
          continue;
        }
        std::optional<ExactMesh> both = union_by_cgal(bodies[i], bodies[k]);
        if (both && agrees(bodies[i], bodies[k], *both)) {
          ++of_this;
        }
      }
    }
    compared += of_this;
  }
  INFO(compared << " pairs");
  CHECK(compared >= 20);
}
