// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/assembly/nesting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/near_boxes.hpp"
#include "base/solid_angle.hpp"

namespace ridgecraft::paper {
namespace {

struct GroupBody {
  Box3 box;
  std::vector<FaceId> faces;
  bool closed = true;
};

bool holds_box(const Box3& outer, const Box3& inner) {
  return outer.low.x < inner.low.x && outer.low.y < inner.low.y && outer.low.z < inner.low.z &&
         inner.high.x < outer.high.x && inner.high.y < outer.high.y && inner.high.z < outer.high.z;
}

/// By how often the body winds around the point, either way round: no edge or corner has to be missed, as
/// with a ray.
bool is_inside(const mesh::Surface& surface, Vec3 point, const GroupBody& body) {
  double angle = 0.0;
  for (const FaceId face : body.faces) {
    const auto [u, v, w] = surface.vertices(face);
    angle += solid_angle(surface.point(u) - point, surface.point(v) - point, surface.point(w) - point);
  }
  return std::abs(angle) > 2.0 * std::numbers::pi;  // half of once around
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
  std::vector<Box3> boxes;
  for (const GroupBody& body : bodies) {
    boxes.push_back(body.faces.empty() ? Box3{{}, {}} : body.box);
  }
  const auto compare = [&](std::size_t inner, std::size_t outer) {
    if (bodies[outer].closed && !bodies[inner].faces.empty() &&
        holds_box(bodies[outer].box, bodies[inner].box) &&
        is_inside(surface, surface.point(surface.vertices(bodies[inner].faces.front())[0]), bodies[outer])) {
      ++depth[inner];
    }
  };
  NearBoxes(boxes).for_pairs([&](std::size_t a, std::size_t b) {
    compare(a, b);
    compare(b, a);
  });
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
