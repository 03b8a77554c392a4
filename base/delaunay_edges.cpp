// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/delaunay_edges.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

namespace ridgecraft {

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
