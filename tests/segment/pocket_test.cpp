// SPDX-License-Identifier: GPL-3.0-or-later
// Cups: what --pockets promises, checked by code of its own (lattice, winding by solid angles, hull planes by
// trying triples of vertices), and the promise's building blocks.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/random.hpp"
#include "segment/evaluate.hpp"
#include "segment/hull/pockets.hpp"
#include "segment/segment.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "segmented.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using test::tolerance;

struct Plane {
  Vec3 normal;
  double offset;
};

/// Planes of the hull of a few points, by trying all triples: O(n^4).
std::vector<Plane> hull_planes(const std::vector<Vec3>& points) {
  std::vector<Plane> planes;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        Vec3 normal = cross(points[j] - points[i], points[k] - points[i]);
        if (length(normal) < 1e-9) {
          continue;
        }
        normal = normalized(normal);
        for (const Vec3 side : {normal, -1.0 * normal}) {
          const double offset = dot(side, points[i]);
          if (std::all_of(points.begin(), points.end(),
                          [&](Vec3 p) { return dot(side, p) <= offset + 1e-9; })) {
            planes.push_back({side, offset});
          }
        }
      }
    }
  }
  return planes;
}

/// Solid angle of all faces over 4 pi: 1 inside, 0 outside.
double winding(const std::vector<Vec3>& points, const mesh::Surface& surface, Vec3 q) {
  double sum = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [i, j, k] = surface.vertices(f);
    const Vec3 a = points[i.value()] - q;
    const Vec3 b = points[j.value()] - q;
    const Vec3 c = points[k.value()] - q;
    const double x = length(a);
    const double y = length(b);
    const double z = length(c);
    sum += 2.0 * std::atan2(dot(a, cross(b, c)), x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y);
  }
  return sum / (4.0 * std::numbers::pi);
}

/// Depth of the deepest point of air under a part's hull among those of a lattice; 0 when there is none.
double deepest_air(const mesh::Surface& surface, const segment::Part& part) {
  const auto ball = segment::smallest_enclosing_ball(surface.points());
  std::vector<Vec3> points;
  for (const Vec3 p : surface.points()) {
    points.push_back((p - ball.center) / ball.radius);
  }
  std::set<VertexId> used;
  for (const FaceId f : part.faces) {
    for (const VertexId v : surface.vertices(f)) {
      used.insert(v);
    }
  }
  // Points that are alone in being farthest in some direction are enough, and few.
  std::set<std::uint32_t> extreme;
  Random random(5);
  for (int n = 0; n < 150; ++n) {
    const Vec3 u = normalized(Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5});
    extreme.insert(std::max_element(used.begin(), used.end(), [&](VertexId a, VertexId b) {
                     return dot(u, points[a.value()]) < dot(u, points[b.value()]);
                   })->value());
  }
  std::vector<Vec3> corners;
  Box3 box;
  for (const std::uint32_t v : extreme) {
    corners.push_back(points[v]);
    box.add(points[v]);
  }
  // A hull of fewer points is smaller: depths come out too small, never too great.
  const std::vector<Plane> planes = hull_planes(corners);
  constexpr int steps = 14;
  double deepest = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      for (int k = 0; k < steps; ++k) {
        const Vec3 size = box.size();
        const Vec3 q = box.low + Vec3{(i + 0.5) / steps * size.x, (j + 0.5) / steps * size.y,
                                      (k + 0.5) / steps * size.z};
        double depth = INFINITY;
        for (const Plane& plane : planes) {
          depth = std::min(depth, plane.offset - dot(plane.normal, q));
        }
        if (std::isfinite(depth) && depth > deepest && std::abs(winding(points, surface, q)) < 0.5) {
          deepest = depth;
        }
      }
    }
  }
  return deepest;
}

mesh::Surface cup() {
  return test::turned({{0, 0}, {1, 0}, {1, 2}, {0.9, 2}, {0.9, 0.1}, {0, 0.1}}, 32);
}

mesh::Surface bowl() {
  std::vector<Vec2> profile;
  for (int k = 0; k <= 12; ++k) {
    const double angle = std::numbers::pi / 2 * k / 12;
    profile.push_back({k == 0 ? 0.0 : std::sin(angle), -std::cos(angle)});
  }
  for (int k = 12; k >= 0; --k) {
    const double angle = std::numbers::pi / 2 * k / 12;
    profile.push_back({k == 0 ? 0.0 : 0.93 * std::sin(angle), -0.93 * std::cos(angle)});
  }
  return test::revolve(profile, 40);
}

mesh::Surface open_box(int x_size, int y_size, int z_size) {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < x_size; ++x) {
    for (int y = 0; y < y_size; ++y) {
      for (int z = 0; z < z_size; ++z) {
        if (x == 0 || x == x_size - 1 || y == 0 || y == y_size - 1 || z == 0) {
          cells.push_back({x, y, z});
        }
      }
    }
  }
  return test::voxels(cells, 2);
}

segment::Segmentation without_pockets(const mesh::Surface& surface, int effort, double volume_weight) {
  segment::Options options;
  options.concavity = tolerance;
  options.effort = effort;
  options.volume_weight = volume_weight;
  options.planes = volume_weight > 0.0;
  options.pockets = true;
  return segment::segment(surface, {}, options, Context{});
}

double ratio(const mesh::Surface& surface, const segment::Segmentation& s) {
  std::vector<std::uint32_t> labels;
  for (const PartId p : s.part) {
    labels.push_back(p.value());
  }
  return segment::hull_volume_ratio(surface, labels, 128, Context{});
}

}  // namespace

TEST_CASE("Cups, bowls and boxes become sectors without pockets", "[slow]") {
  struct Shape {
    const char* name;
    mesh::Surface surface;
    std::size_t most_parts;
    double most_ratio;
  };
  const std::vector<Shape> shapes{{"cup", cup(), 16, 2.2},
                                  {"bowl", bowl(), 24, 2.2},
                                  {"bathtub", open_box(14, 7, 6), 8, 1.3},
                                  {"box without lid", open_box(8, 8, 8), 8, 1.3}};
  for (const Shape& shape : shapes) {
    CAPTURE(shape.name);
    const auto whole = segment::segment(shape.surface, {}, {tolerance}, Context{});
    const auto s = without_pockets(shape.surface, 2, 6.0);
    CHECK(s.parts.size() > whole.parts.size());
    CHECK(s.parts.size() <= shape.most_parts);
    CHECK(s.max_concavity() <= tolerance);
    CHECK(ratio(shape.surface, s) < shape.most_ratio);
    CHECK(ratio(shape.surface, s) < ratio(shape.surface, whole));
    double air = 0.0;
    for (const segment::Part& part : s.parts) {
      air = std::max(air, deepest_air(shape.surface, part));
    }
    CHECK(air <= tolerance);
    // The check can fail: the whole vessel has a pocket.
    CHECK(deepest_air(shape.surface, whole.parts[PartId(0)]) > tolerance);
  }
}

TEST_CASE("Pockets are avoided at every effort, and cost nothing where there are none") {
  for (const int effort : {1, 2}) {
    const auto s = without_pockets(cup(), effort, 0.0);
    for (const segment::Part& part : s.parts) {
      CHECK(deepest_air(cup(), part) <= tolerance);
    }
  }
  CHECK(without_pockets(test::voxels({{0, 0, 0}}, 6), 1, 0.0).parts.size() == 1);
  CHECK(without_pockets(test::sphere(32, 16), 1, 0.0).parts.size() == 1);
  CHECK(without_pockets(test::dumbbell(), 1, 0.0).parts.size() == 3);
}

TEST_CASE("A surface with a hole encloses nothing that could have pockets") {
  const mesh::Surface whole = cup();
  std::vector<std::array<VertexId, 3>> corners;
  for (std::uint32_t f = 1; f < whole.face_count(); ++f) {
    corners.push_back(whole.vertices(FaceId(f)));
  }
  const mesh::Surface open({whole.points().begin(), whole.points().end()}, std::move(corners));
  CHECK_THROWS_AS(without_pockets(open, 1, 0.0), Error);
}

TEST_CASE("The deepest point of a body is the centre of its largest ball") {
  const std::vector<segment::HalfSpace> box{{{1, 0, 0}, 1.0},   {{-1, 0, 0}, 0.0}, {{0, 1, 0}, 0.75},
                                            {{0, -1, 0}, 0.25}, {{0, 0, 1}, 0.5},  {{0, 0, -1}, 0.1}};
  const auto deepest = segment::deepest_point(box);
  REQUIRE(deepest);
  CHECK(deepest->depth == Approx(0.3));
  CHECK(deepest->point.z == Approx(0.2));
  CHECK_FALSE(segment::deepest_point(std::vector<segment::HalfSpace>{{{1, 0, 0}, -0.1}, {{-1, 0, 0}, -0.1}}));
  // Random bodies: the depth found is that of the point, and no point of many is deeper.
  Random random(11);
  const auto unit = [&] {
    return normalized(Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5});
  };
  for (int n = 0; n < 30; ++n) {
    std::vector<segment::HalfSpace> planes;
    for (int i = 0; i < 60; ++i) {
      planes.push_back({unit(), 0.3 + 0.7 * random.unit()});
    }
    const auto depth_of = [&](Vec3 p) {
      double depth = INFINITY;
      for (const auto& h : planes) {
        depth = std::min(depth, h.offset - dot(h.normal, p));
      }
      return depth;
    };
    const auto found = segment::deepest_point(planes);
    REQUIRE(found);
    CHECK(depth_of(found->point) == Approx(found->depth).margin(1e-9));
    for (int i = 0; i < 2000; ++i) {
      const Vec3 near_by = found->point + 0.3 * random.unit() * unit();
      CHECK(depth_of(near_by) <= found->depth + 1e-9);
    }
  }
}

}  // namespace ridgecraft
