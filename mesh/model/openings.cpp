// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/openings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/constrained_delaunay.hpp"
#include "base/plane_frame.hpp"

namespace ridgecraft::mesh {
namespace {

std::vector<CornerId> border_from(const Surface& surface, CornerId first) {
  std::vector<CornerId> sides;
  CornerId c = first;
  do {
    sides.push_back(c);
    c = next(c);
    while (!surface.is_border(surface.edge(c))) {
      c = next(surface.twin(c));
    }
  } while (c != first);
  return sides;
}

Vec3 start_of(const Surface& surface, CornerId side) {
  return surface.point(surface.vertex(side));
}

Vec3 end_of(const Surface& surface, CornerId side) {
  return surface.point(surface.vertex(next(side)));
}

}  // namespace

std::vector<Opening> flat_openings(const Surface& surface, double flat_mm) {
  std::vector<Opening> openings;
  std::vector<bool> seen(surface.corner_count(), false);
  for (const CornerId first : ids<CornerId>(surface.corner_count())) {
    if (seen[first.value()] || !surface.is_border(surface.edge(first))) {
      continue;
    }
    Opening opening;
    opening.sides = border_from(surface, first);
    for (const CornerId c : opening.sides) {
      seen[c.value()] = true;
      opening.middle += start_of(surface, c) / static_cast<double>(opening.sides.size());
    }
    Vec3 normal;  // of what closes it: its sides run the other way than the faces beside it do
    for (const CornerId c : opening.sides) {
      normal += cross(end_of(surface, c) - opening.middle, start_of(surface, c) - opening.middle);
    }
    if (!(length(normal) > 0.0)) {
      continue;
    }
    opening.normal = normalized(normal);
    if (std::ranges::all_of(opening.sides, [&](CornerId c) {
          return std::abs(dot(start_of(surface, c) - opening.middle, opening.normal)) <= flat_mm;
        })) {
      openings.push_back(std::move(opening));
    }
  }
  return openings;
}

bool rises_at(const Surface& surface, const Opening& opening, CornerId side) {
  constexpr double cosine = 0.8660254037844386;
  return std::abs(dot(surface.normal(face_of(side)), opening.normal)) < cosine;
}

std::vector<std::array<Vec3, 3>> triangles_of(const Surface& surface, const Opening& opening) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (const CornerId c : opening.sides) {
    triangles.push_back({opening.middle, end_of(surface, c), start_of(surface, c)});
  }
  if (std::ranges::all_of(triangles, [&](const auto& t) {
        return dot(cross(t[1] - t[0], t[2] - t[0]), opening.normal) > 0.0;
      })) {
    return triangles;
  }
  triangles.clear();
  const PlaneFrame frame(opening.middle, opening.normal);
  const auto count = static_cast<std::uint32_t>(opening.sides.size());
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (std::uint32_t i = 0; i < count; ++i) {
    points.push_back(frame.flat(start_of(surface, opening.sides[i])));
    sides.push_back({i, (i + 1) % count});
  }
  if (const auto inside = triangulate_inside(points, sides)) {
    for (const auto& [a, b, c] : *inside) {
      triangles.push_back({start_of(surface, opening.sides[a]), start_of(surface, opening.sides[b]),
                           start_of(surface, opening.sides[c])});
    }
  }
  return triangles;
}

}  // namespace ridgecraft::mesh
