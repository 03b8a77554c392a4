// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/scaled_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/curve_order.hpp"
#include "base/elementary.hpp"
#include "base/error.hpp"
#include "segment/surface/enclosing_ball.hpp"
#include "segment/surface/exact_orientation.hpp"

namespace ridgecraft::segment {
namespace {

void scale_points(const mesh::Surface& surface, ScaledSurface& out) {
  // First by the box, so that huge or far-off coordinates lose nothing in the ball's arithmetic.
  const Box3& box = surface.bounds();
  const double diagonal = box.diagonal();
  const double first = diagonal > 0.0 && std::isfinite(diagonal) ? diagonal : 1.0;
  const Vec3 middle = box.empty() ? Vec3{} : box.low + 0.5 * box.size();
  out.points.reserve(surface.vertex_count());
  for (const Vec3 p : surface.points()) {
    out.points.push_back((p - middle) / first);
  }
  const Ball ball = smallest_enclosing_ball(out.points);
  const double radius = ball.radius > 0.0 ? ball.radius : 1.0;
  for (Vec3& p : out.points) {
    p = snap_to_grid((p - ball.center) / radius);
  }
  out.unit = first * radius;
}

/// Vertices in the order in which a space-filling curve meets them; facets by their smallest vertex.
void number_along_curve(const mesh::Surface& surface, ScaledSurface& out) {
  out.vertex_of = curve_order(out.points);
  std::vector<Vec3> points(out.points.size());
  std::vector<std::uint32_t> rank(out.points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    points[v] = out.points[out.vertex_of[v]];
    rank[out.vertex_of[v]] = v;
  }
  out.points = std::move(points);
  std::vector<std::uint32_t> first(out.points.size() + 1, 0);
  std::vector<std::uint32_t> smallest(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    smallest[f.value()] = std::min({rank[a.value()], rank[b.value()], rank[c.value()]});
    ++first[smallest[f.value()] + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  out.face_of.resize(surface.face_count());
  for (std::uint32_t f = 0; f < smallest.size(); ++f) {
    out.face_of[first[smallest[f]]++] = f;
  }
}

/// As copy_connections(), with the numbers of number_along_curve().
void renumber_connections(const mesh::Surface& surface, ScaledSurface& out) {
  const std::size_t facets = surface.face_count();
  std::vector<std::uint32_t> facet(facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    facet[out.face_of[f]] = f;
  }
  std::vector<std::uint32_t> vertex(surface.vertex_count());
  for (std::uint32_t v = 0; v < vertex.size(); ++v) {
    vertex[out.vertex_of[v]] = v;
  }
  out.corners.resize(facets);
  out.neighbors.resize(facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(FaceId(out.face_of[f]), k);
      const FaceId beyond = surface.neighbor(c);
      out.corners[f][k] = vertex[surface.vertex(c).value()];
      out.neighbors[f][k] = beyond.valid() ? facet[beyond.value()] : none;
    }
  }
}

void copy_connections(const mesh::Surface& surface, ScaledSurface& out) {
  const std::size_t facets = surface.face_count();
  out.corners.resize(facets);
  out.neighbors.resize(facets);
  for (std::uint32_t f = 0; f < facets; ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(FaceId(f), k);
      out.corners[f][k] = surface.vertex(c).value();
      out.neighbors[f][k] = surface.neighbor(c).value();
    }
  }
}

void index_vertices(ScaledSurface& s) {
  s.vertex_first.assign(s.vertex_count() + 1, 0);
  for (const auto& corners : s.corners) {
    for (const std::uint32_t v : corners) {
      ++s.vertex_first[v + 1];
    }
  }
  for (std::size_t v = 0; v < s.vertex_count(); ++v) {
    s.vertex_first[v + 1] += s.vertex_first[v];
  }
  std::vector<std::uint32_t> fill(s.vertex_first.begin(), s.vertex_first.end() - 1);
  s.vertex_facets.resize(3 * s.facet_count());
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (const std::uint32_t v : s.corners[f]) {
      s.vertex_facets[fill[v]++] = f;
    }
  }
}

void find_normals(ScaledSurface& s) {
  s.vertex_normals.assign(s.vertex_count(), Vec3{});
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    const auto& [a, b, c] = s.corners[f];
    const std::array<Vec3, 3> side{normalized(s.points[b] - s.points[a]),
                                   normalized(s.points[c] - s.points[b]),
                                   normalized(s.points[a] - s.points[c])};
    const Vec3 n = s.facet_normal(f);
    for (std::size_t k = 0; k < 3; ++k) {
      const double cosine = -dot(side[k], side[(k + 2) % 3]);
      s.vertex_normals[s.corners[f][k]] += elementary::acos(std::clamp(cosine, -1.0, 1.0)) * n;
    }
  }
  for (Vec3& n : s.vertex_normals) {
    n = normalized(n);
  }
}

/// Polygons can be torn into several pieces by repair; only what hangs together over edges can stay in one
/// part.
void find_groups(std::span<const std::uint32_t> polygon, ScaledSurface& s) {
  RIDGECRAFT_ASSERT(polygon.empty() || polygon.size() == s.facet_count());
  if (polygon.empty()) {
    return;
  }
  s.group.assign(s.facet_count(), none);
  std::vector<std::uint32_t> stack;
  std::uint32_t count = 0;
  for (std::uint32_t start = 0; start < s.facet_count(); ++start) {
    if (s.group[start] != none) {
      continue;
    }
    s.group_first.push_back(static_cast<std::uint32_t>(s.group_facets.size()));
    s.group[start] = count;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::uint32_t f = stack.back();
      stack.pop_back();
      s.group_facets.push_back(f);
      for (const std::uint32_t g : s.neighbors[f]) {
        // A face that repair made belongs to no polygon (none): it is its own.
        if (g != none && s.group[g] == none && polygon[g] == polygon[f] && polygon[f] != none) {
          s.group[g] = count;
          stack.push_back(g);
        }
      }
    }
    ++count;
  }
  s.group_first.push_back(static_cast<std::uint32_t>(s.group_facets.size()));
  if (count == s.facet_count()) {
    s.group.clear();
    s.group_first.clear();
    s.group_facets.clear();
  }
}

}  // namespace

void extend_groups(ScaledSurface& s, std::size_t facets_before) {
  if (s.group.empty()) {
    return;
  }
  for (std::size_t f = facets_before; f < s.facet_count(); ++f) {
    s.group.push_back(static_cast<std::uint32_t>(s.group_first.size() - 1));
    s.group_facets.push_back(static_cast<std::uint32_t>(f));
    s.group_first.push_back(static_cast<std::uint32_t>(s.group_facets.size()));
  }
}

void index_and_orient(ScaledSurface& surface) {
  index_vertices(surface);
  find_normals(surface);
}

ScaledSurface scale_surface(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                            Numbering numbering) {
  ScaledSurface scaled;
  scale_points(surface, scaled);
  std::vector<std::uint32_t> renumbered_polygon;
  if (numbering == Numbering::along_curve) {
    number_along_curve(surface, scaled);
    renumber_connections(surface, scaled);
    if (!polygon.empty()) {
      RIDGECRAFT_ASSERT(polygon.size() == scaled.facet_count());
      for (const std::uint32_t f : scaled.face_of) {
        renumbered_polygon.push_back(polygon[f]);
      }
      polygon = renumbered_polygon;
    }
  } else {
    copy_connections(surface, scaled);
  }
  index_and_orient(scaled);
  find_groups(polygon, scaled);
  return scaled;
}

}  // namespace ridgecraft::segment
