// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/assembly/seam_graph.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::export_ {
namespace {

void number_groups(SeamGraph& graph) {
  std::vector<bool> seen(graph.nodes.size(), false);
  for (const PieceId first : ids<PieceId>(graph.nodes.size())) {
    if (seen[first.value()]) {
      continue;
    }
    std::vector<PieceId> group{first};
    seen[first.value()] = true;
    for (std::size_t i = 0; i < group.size(); ++i) {
      SeamGraph::Node& node = graph.nodes[group[i]];
      node.group = static_cast<std::uint32_t>(graph.groups.size());
      for (const SeamGraph::Seam& seam : node.seams) {
        if (!seen[seam.other.value()]) {
          seen[seam.other.value()] = true;
          group.push_back(seam.other);
        }
      }
    }
    std::sort(group.begin(), group.end());
    graph.groups.push_back(std::move(group));
  }
}

}  // namespace

double SeamGraph::seam_between(PieceId a, PieceId b) const {
  const auto& seams = nodes[a].seams;
  const auto found = std::lower_bound(seams.begin(), seams.end(), b,
                                      [](const Seam& seam, PieceId piece) { return seam.other < piece; });
  return found != seams.end() && found->other == b ? found->length_mm : 0.0;
}

double SeamGraph::border_of(std::size_t group) const {
  double sum = 0.0;
  for (const PieceId piece : groups[group]) {
    sum += nodes[piece].border_mm;
  }
  return sum;
}

SeamGraph seam_graph(const mesh::Surface& surface, const unfold::Nets& nets) {
  SeamGraph graph;
  graph.nodes.resize(nets.pieces.size());
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    SeamGraph::Node& node = graph.nodes[nets.piece[face]];
    node.area_mm2 += surface.area(face);
    for (const unsigned k : {0U, 1U, 2U}) {
      const EdgeId edge = surface.edge(mesh::corner(face, k));
      node.border_mm += surface.is_border(edge) ? surface.length(edge) : 0.0;
    }
  }
  std::map<std::pair<PieceId, PieceId>, SeamGraph::Seam> seams;
  for (const unfold::Join& join : nets.joins) {
    const auto [c, d] = surface.sides(join.edge);
    const PieceId a = nets.piece[mesh::face_of(c)];
    const PieceId b = nets.piece[mesh::face_of(d)];
    const double length = surface.length(join.edge);
    if (a == b) {
      graph.nodes[a].own_mm += length;
      ++graph.nodes[a].own_joins;
      continue;
    }
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      SeamGraph::Seam& seam = seams[{from, to}];
      seam.other = to;
      seam.length_mm += length;
      graph.nodes[from].seam_mm += length;
      ++graph.nodes[from].joins;
    }
  }
  for (const auto& [ends, seam] : seams) {
    graph.nodes[ends.first].seams.push_back(seam);
  }
  number_groups(graph);
  return graph;
}

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

/// The corners of a body that lie farthest along the axes and their diagonals, both ways: what stands out of
/// another body does so with one of these, but for what no direction of these meets first.
std::vector<Vec3> farthest_corners(const mesh::Surface& surface, const GroupBody& body) {
  std::vector<Vec3> corners;
  constexpr int ways = 27;  // each component -1, 0 or 1
  for (int code = 0; code < ways; ++code) {
    if (code == ways / 2) {
      continue;  // no direction
    }
    const Vec3 way{static_cast<double>(code % 3 - 1), static_cast<double>(code / 3 % 3 - 1),
                   static_cast<double>(code / 9 - 1)};
    double most = -INFINITY;
    Vec3 farthest;
    for (const FaceId face : body.faces) {
      for (const VertexId v : surface.vertices(face)) {
        if (const double reach = dot(way, surface.point(v)); reach > most) {
          most = reach;
          farthest = surface.point(v);
        }
      }
    }
    corners.push_back(farthest);
  }
  return corners;
}

/// What lies nearer to a body than this lies on it, mm: simplification leaves sheets a hair behind walls.
constexpr double on_body_mm = 1.0;

enum class Side { outside, on, inside };

/// By how often the body winds around the point, either way round: no edge or corner has to be missed, as
/// with a ray.
Side side_of(const mesh::Surface& surface, Vec3 point, const GroupBody& body) {
  double angle = 0.0;
  double nearest = INFINITY;
  for (const FaceId face : body.faces) {
    const auto [u, v, w] = surface.vertices(face);
    const Vec3 a = surface.point(u);
    const Vec3 b = surface.point(v);
    const Vec3 c = surface.point(w);
    angle += solid_angle(a - point, b - point, c - point);
    nearest = std::min(nearest, mesh::squared_distance(a, b, c, point));
  }
  if (nearest < on_body_mm * on_body_mm) {
    return Side::on;
  }
  return std::abs(angle) > 2.0 * std::numbers::pi ? Side::inside : Side::outside;  // half of once around
}

/// What only begins in another body, as a dormer in a roof, or lies on it, isn't inside.
bool is_whole_inside(const mesh::Surface& surface, const GroupBody& inner, const GroupBody& outer) {
  bool inside = false;
  for (const Vec3 corner : farthest_corners(surface, inner)) {
    const Side side = side_of(surface, corner, outer);
    if (side == Side::outside) {
      return false;
    }
    inside = inside || side == Side::inside;
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
  std::vector<Box3> boxes;
  for (const GroupBody& body : bodies) {
    boxes.push_back(body.faces.empty() ? Box3{{}, {}} : body.box);
  }
  const auto compare = [&](std::size_t inner, std::size_t outer) {
    if (bodies[outer].closed && !bodies[inner].faces.empty() &&
        holds_box(bodies[outer].box, bodies[inner].box) &&
        is_whole_inside(surface, bodies[inner], bodies[outer])) {
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

}  // namespace ridgecraft::export_
