// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/delaunay.hpp"
#include "base/geometry.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

class LoopFinder {
 public:
  LoopFinder(const mesh::Surface& surface, const Walls& walls)
      : surface_(surface), walls_(walls), seen_(surface.corner_count(), false) {}

  /// All but the outline of each wall, which is the largest of its loops.
  std::vector<WallLoop> run() {
    std::map<std::uint32_t, std::vector<WallLoop>> of_wall;
    for (const CornerId c : ids<CornerId>(surface_.corner_count())) {
      if (wall_of(c) != Walls::none && ends_wall(c) && !seen_[c.value()]) {
        if (auto loop = follow(c)) {
          of_wall[loop->wall].push_back(std::move(*loop));
        }
      }
    }
    std::vector<WallLoop> all;
    for (auto& [wall, loops] : of_wall) {
      const auto outline = std::max_element(
          loops.begin(), loops.end(),
          [](const WallLoop& a, const WallLoop& b) { return a.box.diagonal() < b.box.diagonal(); });
      for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
        if (loop != outline) {
          loop->outline_extent = outline->box.largest_extent();
          loop->outline_area = outline->area;
          all.push_back(std::move(*loop));
        }
      }
    }
    return all;
  }

 private:
  [[nodiscard]] std::uint32_t wall_of(CornerId c) const { return walls_.wall(mesh::face_of(c).value()); }

  [[nodiscard]] bool ends_wall(CornerId c) const {
    const CornerId beyond = surface_.twin(c);
    return !beyond.valid() || wall_of(beyond) != wall_of(c);
  }

  /// None where the line runs into one that is known.
  std::optional<WallLoop> follow(CornerId start) {
    WallLoop loop;
    loop.wall = wall_of(start);
    const Vec3 origin = surface_.point(surface_.vertex(start));
    Vec3 doubled;
    CornerId c = start;
    do {
      seen_[c.value()] = true;
      loop.sides.push_back(c);
      loop.has_rims = loop.has_rims || !surface_.twin(c).valid();
      const Vec3 p = surface_.point(surface_.vertex(c));
      loop.box.add(p);
      doubled += cross(p - origin, surface_.point(surface_.vertex(mesh::next(c))) - origin);
      // On around the end of the side, within the wall.
      c = mesh::next(c);
      while (!ends_wall(c)) {
        c = mesh::next(surface_.twin(c));
      }
    } while (c != start && !seen_[c.value()]);
    loop.area = 0.5 * length(doubled);
    return c == start ? std::optional(std::move(loop)) : std::nullopt;
  }

  const mesh::Surface& surface_;
  const Walls& walls_;
  std::vector<bool> seen_;
};

}  // namespace

std::vector<WallLoop> loops_within(const mesh::Surface& surface, const Walls& walls) {
  return LoopFinder(surface, walls).run();
}

double distance(const Box3& box, Vec3 p) {
  return length(p - Vec3{std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y),
                         std::clamp(p.z, box.low.z, box.high.z)});
}

bool close_loop(const mesh::Surface& surface, const Walls& walls, const WallLoop& loop, Caps& caps) {
  const PlaneFrame frame(surface.point(surface.vertex(loop.sides.front())), walls.walls[loop.wall].normal);
  std::vector<std::uint32_t> vertices;
  std::vector<Vec2> flat;
  std::vector<std::array<std::uint32_t, 2>> sides;
  const auto count = static_cast<std::uint32_t>(loop.sides.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    // The other way round than the wall's faces run.
    const VertexId v = surface.vertex(loop.sides[count - 1 - i]);
    vertices.push_back(v.value());
    flat.push_back(frame.flat(surface.point(v)));
    sides.push_back({i, (i + 1) % count});
  }
  const auto triangles = triangulate_inside(flat, sides);
  if (!triangles || triangles->size() + 2 != count) {
    return false;
  }
  const std::size_t like = mesh::face_of(loop.sides.front()).value();
  for (const auto& [a, b, c] : *triangles) {
    caps.push_back({{vertices[a], vertices[b], vertices[c]}, like});
  }
  return true;
}

mesh::LooseFaces with_caps(const mesh::LooseFaces& all, const std::vector<bool>& gone, const Caps& caps) {
  mesh::LooseFaces result;
  result.points = all.points;
  for (std::size_t f = 0; f < gone.size(); ++f) {
    if (!gone[f]) {
      result.add(all, f, all.faces[f]);
    }
  }
  for (const auto& [face, like] : caps) {
    result.add(all, like, face);
    result.polygon.back() = mesh::Soup::none;
  }
  return result;
}

}  // namespace ridgecraft::prepare
