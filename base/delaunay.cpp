// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/delaunay.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "base/no_index.hpp"

namespace ridgecraft {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct PointNumber {
  std::uint32_t value = no_index;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<PointNumber, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;
using Segment = std::array<std::uint32_t, 2>;

Segment ascending(std::uint32_t a, std::uint32_t b) {
  return a < b ? Segment{a, b} : Segment{b, a};
}

std::vector<Segment> sorted_segments(std::span<const Segment> segments) {
  std::vector<Segment> sorted;
  for (const Segment& s : segments) {
    sorted.push_back(ascending(s[0], s[1]));
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// The segments that bound something: those that are there an odd number of times. Sorted.
std::vector<Segment> odd_segments(const std::vector<Segment>& sorted) {
  std::vector<Segment> odd;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t j = i;
    while (j < sorted.size() && sorted[j] == sorted[i]) {
      ++j;
    }
    if ((j - i) % 2 == 1) {
      odd.push_back(sorted[i]);
    }
    i = j;
  }
  return odd;
}

bool insert(Delaunay& delaunay, std::span<const Vec2> points, std::span<const Segment> segments) {
  std::vector<Delaunay::Vertex_handle> vertices(points.size());
  std::vector<bool> used(points.size(), false);
  for (const Segment& s : segments) {
    used[s[0]] = used[s[1]] = true;
  }
  Delaunay::Face_handle near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) {
      vertices[i] = delaunay.insert(Kernel::Point_2(points[i].x, points[i].y), near);
      if (vertices[i]->info().value != no_index) {
        return false;
      }
      vertices[i]->info().value = static_cast<std::uint32_t>(i);
      near = vertices[i]->face();
    }
  }
  for (const Segment& s : segments) {
    delaunay.insert_constraint(vertices[s[0]], vertices[s[1]]);
    if (!delaunay.is_edge(vertices[s[0]], vertices[s[1]])) {
      return false;
    }
  }
  return true;
}

/// Marks the faces that are reached from outside over an odd number of odd segments.
std::vector<std::array<std::uint32_t, 3>> inside(const Delaunay& delaunay, const std::vector<Segment>& odd) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  CGAL::Unique_hash_map<Delaunay::Face_handle, int> depth(-1);
  std::vector<Delaunay::Face_handle> stack{delaunay.infinite_face()};
  depth[delaunay.infinite_face()] = 0;
  while (!stack.empty()) {
    const Delaunay::Face_handle face = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Delaunay::Face_handle other = face->neighbor(k);
      if (depth[other] >= 0) {
        continue;
      }
      bool border = false;
      if (face->is_constrained(k)) {
        const Segment s = ascending(face->vertex(Delaunay::cw(k))->info().value,
                                    face->vertex(Delaunay::ccw(k))->info().value);
        border = std::binary_search(odd.begin(), odd.end(), s);
      }
      depth[other] = border ? 1 - depth[face] : depth[face];
      stack.push_back(other);
    }
  }
  for (const Delaunay::Face_handle face : delaunay.finite_face_handles()) {
    if (depth[face] == 1) {
      triangles.push_back(
          {face->vertex(0)->info().value, face->vertex(1)->info().value, face->vertex(2)->info().value});
    }
  }
  return triangles;
}

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate_inside(
    std::span<const Vec2> points, std::span<const Segment> segments) {
  Delaunay delaunay;
  const std::vector<Segment> sorted = sorted_segments(segments);
  std::vector<Segment> once = sorted;
  once.erase(std::unique(once.begin(), once.end()), once.end());
  try {
    if (!insert(delaunay, points, once)) {
      return std::nullopt;
    }
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    return std::nullopt;
  }
  if (delaunay.dimension() < 2) {
    return std::nullopt;
  }
  return inside(delaunay, odd_segments(sorted));
}

std::vector<std::array<std::uint32_t, 2>> delaunay_edges(std::span<const Vec3> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex>>;
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t p) { return std::tie(points[p].x, points[p].y, points[p].z); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    return place(p) != place(q) ? place(p) < place(q) : p < q;
  });
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> places;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec3& p = points[order[i]];
    if (i > 0 && place(order[i - 1]) == place(order[i])) {
      edges.push_back({order[i - 1], order[i]});
    } else {
      places.emplace_back(Kernel::Point_3(p.x, p.y, p.z), order[i]);
    }
  }
  const Delaunay delaunay(places.begin(), places.end());
  for (const auto& edge : delaunay.finite_edges()) {
    const std::uint32_t p = edge.first->vertex(edge.second)->info();
    const std::uint32_t q = edge.first->vertex(edge.third)->info();
    edges.push_back({std::min(p, q), std::max(p, q)});
  }
  return edges;
}

}  // namespace ridgecraft
