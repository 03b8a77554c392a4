// SPDX-License-Identifier: GPL-3.0-or-later
// What is seen, held against rays: at each place the region of the nearest face, and lines where nothing lies
// before them.
#include "export/view/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <catch2/catch.hpp>

#include "base/geometry.hpp"
#include "base/random.hpp"
#include "export/view/scene.hpp"
#include "prepare/prepared/panels.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using export_::Camera;
using export_::Scene;
using export_::View;
using mesh::Surface;

/// Every flat region by itself, every folded edge drawn.
Scene whole_scene(const Surface& surface) {
  Scene scene;
  scene.surface = &surface;
  const prepare::Panels panels = prepare::find_panels(surface);
  for (const PanelId panel : panels.panel) {
    scene.region.push_back(panel.value());
  }
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    scene.drawn.push_back(std::abs(surface.fold_angle(edge)) > 0.01);
  }
  return scene;
}

Camera random_camera(Random& random) {
  const double turn = 2.0 * std::numbers::pi * random.unit();
  const double tilt = (random.unit() - 0.5) * 2.6;
  return export_::look_from({{0.0, 0.0, 1.0}, {0.0, -1.0, 0.0}}, turn, tilt);
}

/// A face over a place: how near it is, and how far the place is from the face's border (negative outside).
struct Over {
  double depth = 0.0;
  double inside = 0.0;
};
Over face_over(const Surface& surface, const Camera& camera, FaceId face, Vec2 at) {
  std::array<Vec2, 3> p;
  std::array<double, 3> depth{};
  for (unsigned k = 0; k < 3; ++k) {
    const Vec3 corner = surface.point(surface.vertices(face)[k]);
    p[k] = camera(corner);
    depth[k] = camera.depth(corner);
  }
  const double whole = cross(p[1] - p[0], p[2] - p[0]);
  Over over{0.0, INFINITY};
  for (unsigned k = 0; k < 3; ++k) {
    const Vec2 a = p[(k + 1) % 3];
    const Vec2 b = p[(k + 2) % 3];
    const double share = cross(b - a, at - a) / whole;
    over.depth += share * depth[k];
    over.inside = std::min(over.inside, share * std::abs(whole) / length(b - a));
  }
  return over;
}

bool is_inside(const std::vector<Vec2>& polygon, Vec2 at) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  return inside;
}

/// Far enough from every border for rounding not to matter.
constexpr double clear_of_borders = 1e-4;

/// Whether a face seen on edge may be what is seen at a place.
bool near_box(const Surface& surface, const Camera& camera, FaceId face, Vec2 at) {
  Box2 box;
  for (const VertexId v : surface.vertices(face)) {
    box.add(camera(surface.point(v)));
  }
  return at.x > box.low.x - clear_of_borders && at.x < box.high.x + clear_of_borders &&
         at.y > box.low.y - clear_of_borders && at.y < box.high.y + clear_of_borders;
}

void check_areas(const Scene& scene, const Camera& camera, const View& view, Random& random) {
  const Surface& surface = *scene.surface;
  const Box2 box = export_::seen_box(scene, camera);
  for (int i = 0; i < 150; ++i) {
    const Vec2 at{box.low.x + random.unit() * box.size().x, box.low.y + random.unit() * box.size().y};
    std::optional<FaceId> nearest;
    double depth = 0.0;
    bool clear = true;
    for (const FaceId face : ids<FaceId>(surface.face_count())) {
      if (!scene.has(face)) {
        continue;
      }
      if (std::abs(dot(surface.normal(face), camera.toward)) < 1e-2) {
        clear = clear && !near_box(surface, camera, face, at);
        continue;
      }
      const Over over = face_over(surface, camera, face, at);
      clear = clear && std::abs(over.inside) > clear_of_borders;
      if (over.inside > 0.0 && (!nearest || over.depth > depth)) {
        nearest = face;
        depth = over.depth;
      }
    }
    if (!clear) {
      continue;
    }
    std::vector<std::uint32_t> regions;
    for (const export_::VisibleArea& area : view.areas) {
      for (const auto& outline : area.outlines) {
        if (is_inside(outline, at)) {
          regions.push_back(area.region);
        }
      }
    }
    CHECK(regions ==
          (nearest ? std::vector<std::uint32_t>{scene.region[*nearest]} : std::vector<std::uint32_t>{}));
  }
}

void check_lines(const Scene& scene, const Camera& camera, const View& view, Random& random) {
  const Surface& surface = *scene.surface;
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    const CornerId side = surface.sides(edge)[0];
    const Vec3 a = surface.point(surface.vertex(side));
    const Vec3 b = surface.point(surface.vertex(mesh::next(side)));
    const double share = 0.02 + 0.96 * random.unit();
    const Vec3 p = a + share * (b - a);
    const Vec2 at = camera(p);
    bool clear = true;
    bool hidden = false;
    for (const FaceId face : ids<FaceId>(surface.face_count())) {
      const auto vertices = surface.vertices(face);
      const auto has = [&](VertexId v) {
        return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
      };
      if (!scene.has(face) || (has(surface.vertex(side)) && has(surface.vertex(mesh::next(side))))) {
        continue;
      }
      if (std::abs(dot(surface.normal(face), camera.toward)) < 1e-2) {
        clear = false;
        continue;
      }
      const Over over = face_over(surface, camera, face, at);
      clear = clear && (std::abs(over.inside) > clear_of_borders || over.depth < camera.depth(p) - 1e-3);
      hidden = hidden || (over.inside > 0.0 && over.depth > camera.depth(p) + 1e-4);
    }
    const bool drawn =
        std::any_of(view.lines.begin(), view.lines.end(), [&](const export_::VisibleLine& line) {
          const double t = dot(at - line.a, line.b - line.a) / dot(line.b - line.a, line.b - line.a);
          return line.edge == edge && t > 0.0 && t < 1.0;
        });
    if (!clear) {
      continue;
    }
    if (hidden) {
      CHECK_FALSE(drawn);
    } else if (scene.drawn[edge]) {
      // An edge is seen where a face beside it is.
      const auto sides = surface.sides(edge);
      const bool beside_seen = std::any_of(sides.begin(), sides.end(), [&](CornerId c) {
        return c.valid() && scene.has(mesh::face_of(c)) &&
               dot(surface.normal(mesh::face_of(c)), camera.toward) > 0.0;
      });
      if (beside_seen) {
        CHECK(drawn);
      }
    }
  }
}

TEST_CASE("a cube shows three squares and nine edges", "[view]") {
  const Surface cube = test::cube();
  const Scene scene = whole_scene(cube);
  const View view = export_::look_at(scene, export_::look_from({}, 0.6, 0.5), 1e-3, {});
  CHECK(view.areas.size() == 3);
  CHECK(view.lines.size() == 9);
  CHECK(std::count_if(view.lines.begin(), view.lines.end(), [](const auto& line) { return line.outline; }) ==
        6);
  double area = 0.0;
  for (const auto& seen : view.areas) {
    REQUIRE(seen.outlines.size() == 1);
    CHECK(seen.outlines.front().size() == 4);
    area += 0.5 * doubled_area(seen.outlines.front());
  }
  const Camera camera = export_::look_from({}, 0.6, 0.5);
  CHECK(area == Approx(std::abs(camera.toward.x) + std::abs(camera.toward.y) + std::abs(camera.toward.z)));
}

TEST_CASE("what rays meet first is seen, and nothing else", "[view]") {
  Random random(11);
  const std::vector<Vec2> ring{{2.0, -0.5}, {3.0, -0.5}, {3.0, 0.5}, {2.0, 0.5}, {2.0, -0.5}};
  const std::vector<Vec2> cup{{1.0, 0.0}, {1.5, 2.0}};
  for (const Surface& shape :
       {test::cube(), test::sphere(9, 6), test::revolve(ring, 12), test::revolve(cup, 9),
        test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 1}, {2, 1, 1}})}) {
    const Scene scene = whole_scene(shape);
    for (int round = 0; round < 12; ++round) {
      const Camera camera = random_camera(random);
      const View view = export_::look_at(scene, camera, 1e-6, {});
      check_areas(scene, camera, view, random);
      check_lines(scene, camera, view, random);
    }
  }
}

TEST_CASE("where faces are left out, the eye sees inside", "[view]") {
  Random random(5);
  const Surface shape = test::sphere(10, 6);
  for (int round = 0; round < 10; ++round) {
    Scene scene = whole_scene(shape);
    for (std::uint32_t& region : scene.region) {
      region = random.below(3) == 0 ? Scene::hidden_region : region;
    }
    const Camera camera = random_camera(random);
    const View view = export_::look_at(scene, camera, 1e-6, {});
    check_areas(scene, camera, view, random);
    CHECK(std::any_of(view.areas.begin(), view.areas.end(), [](const auto& area) { return area.inside; }));
  }
}

TEST_CASE("a coarse view shows the same faces, and places well inside them", "[view]") {
  const Surface shape = test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const Scene scene = whole_scene(shape);
  const Camera camera = export_::look_from({}, 0.5, 0.4);
  const View view = export_::look_at(scene, camera, 1e-6, {});
  const export_::CoarseView coarse = export_::look_coarsely(scene, camera, 200);
  std::size_t count = 0;
  for (const std::uint32_t region : scene.region) {
    count = std::max<std::size_t>(count, region + 1);
  }
  const std::vector<double> areas =
      export_::seen_areas(coarse, count, [&](FaceId face) { return scene.region[face]; });
  const std::vector<export_::Anchor> anchors = export_::find_anchors(coarse, scene.region, count);
  std::vector<double> exact(count, 0.0);
  for (const export_::VisibleArea& area : view.areas) {
    bool holds_anchor = false;
    for (const auto& outline : area.outlines) {
      exact[area.region] += 0.5 * std::abs(doubled_area(outline));
      holds_anchor = holds_anchor || is_inside(outline, anchors[area.region].at);
    }
    CHECK(holds_anchor);
  }
  for (std::size_t region = 0; region < count; ++region) {
    CHECK(areas[region] == Approx(exact[region]).margin(0.03));
    CHECK(anchors[region].seen == (areas[region] > 0.0));
  }
  // Of a thing of several regions it is the place on the one with the most room.
  const IdVector<FaceId, std::uint32_t> one(shape.face_count(), 0);
  const export_::Anchor best = export_::find_anchors_on_faces(coarse, scene, one, 1).front();
  REQUIRE(best.seen);
  for (const export_::Anchor& anchor : anchors) {
    CHECK(anchor.room <= best.room);
  }
}

}  // namespace
}  // namespace ridgecraft
