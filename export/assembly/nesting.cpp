// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/assembly/nesting.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace ridgecraft::paper {
namespace {

/// A direction that runs along no side of a model drawn with axes in mind.
constexpr Vec3 ray_direction{0.2672612419124244, 0.5345224838248488, 0.8017837257372732};

struct GroupBody {
  Box3 box;
  std::vector<FaceId> faces;
  bool closed = true;
};

bool holds_box(const Box3& outer, const Box3& inner) {
  return outer.low.x < inner.low.x && outer.low.y < inner.low.y && outer.low.z < inner.low.z &&
         inner.high.x < outer.high.x && inner.high.y < outer.high.y && inner.high.z < outer.high.z;
}

/// Moeller and Trumbore: Fast, minimum storage ray/triangle intersection, 1997.
bool ray_meets(Vec3 start, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 p = cross(ray_direction, ac);
  const double det = dot(ab, p);
  if (det == 0.0) {
    return false;
  }
  const Vec3 s = start - a;
  const double u = dot(s, p) / det;
  const Vec3 q = cross(s, ab);
  const double v = dot(ray_direction, q) / det;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && dot(ac, q) / det > 0.0;
}

bool is_inside(const mesh::Surface& surface, Vec3 point, const GroupBody& body) {
  bool inside = false;
  for (const FaceId face : body.faces) {
    const auto [a, b, c] = surface.vertices(face);
    if (ray_meets(point, surface.point(a), surface.point(b), surface.point(c))) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace

std::vector<std::size_t> inner_groups_first(const mesh::Surface& surface, const unfold::Nets& nets,
                                            const SeamGraph& graph) {
  std::vector<GroupBody> bodies(graph.groups.size());
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    GroupBody& body = bodies[graph.nodes[nets.piece[face]].group];
    body.faces.push_back(face);
    for (const VertexId v : surface.vertices(face)) {
      body.box.add(surface.point(v));
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].closed = graph.border_of(i) == 0.0;
  }
  // In how many others each lies: what lies in a body lies in all that the body lies in, so the deepest
  // may come first.
  std::vector<std::size_t> depth(bodies.size(), 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t outer = 0; outer < bodies.size(); ++outer) {
      if (outer != i && bodies[outer].closed && !bodies[i].faces.empty() &&
          holds_box(bodies[outer].box, bodies[i].box) &&
          is_inside(surface, surface.point(surface.vertices(bodies[i].faces.front())[0]), bodies[outer])) {
        ++depth[i];
      }
    }
  }
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto area = [&](std::size_t group) {
    double sum = 0.0;
    for (const PieceId piece : graph.groups[group]) {
      sum += graph.nodes[piece].area_mm2;
    }
    // Equal bodies keep their order, whatever their sums are rounded to.
    constexpr double rounding_mm2 = 1e-3;
    return std::round(sum / rounding_mm2);
  };
  std::vector<double> areas;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    areas.push_back(area(i));
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(depth[a], areas[a]) > std::pair(depth[b], areas[b]);
  });
  return order;
}

}  // namespace ridgecraft::paper
