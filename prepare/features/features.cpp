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
#include "base/no_index.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

class LoopFinder {
 public:
  LoopFinder(const mesh::Surface& surface, const Walls& walls)
      : surface_(surface), walls_(walls), seen_(surface.corner_count(), false) {}

  /// Of each wall that has any: its loops, and which of them is its outline.
  struct OfWall {
    std::vector<WallLoop> loops;
    std::size_t outline = 0;
  };

  std::vector<OfWall> run() {
    std::map<std::uint32_t, std::vector<WallLoop>> of_wall;
    for (const CornerId c : ids<CornerId>(surface_.corner_count())) {
      if (wall_of(c) != Walls::none && ends_wall(c) && !seen_[c.value()]) {
        if (auto loop = follow(c)) {
          of_wall[loop->wall].push_back(std::move(*loop));
        }
      }
    }
    std::vector<OfWall> all;
    for (auto& [wall, loops] : of_wall) {
      const auto outline = std::max_element(
          loops.begin(), loops.end(),
          [](const WallLoop& a, const WallLoop& b) { return a.box.diagonal() < b.box.diagonal(); });
      const auto at = static_cast<std::size_t>(outline - loops.begin());
      all.push_back({std::move(loops), at});
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
  std::vector<WallLoop> all;
  for (auto& [loops, outline] : LoopFinder(surface, walls).run()) {
    const double extent = loops[outline].box.largest_extent();
    const double area = loops[outline].area;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      if (l != outline) {
        loops[l].outline_extent = extent;
        loops[l].outline_area = area;
        all.push_back(std::move(loops[l]));
      }
    }
  }
  return all;
}

std::vector<WallLoop> outlines(const mesh::Surface& surface, const Walls& walls) {
  std::vector<WallLoop> all;
  for (auto& [loops, outline] : LoopFinder(surface, walls).run()) {
    all.push_back(std::move(loops[outline]));
  }
  return all;
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

namespace {

class FeatureRemover {
 public:
  FeatureRemover(const mesh::Model& model, const SimplifyOptions& options, double largest_mm)
      : surface_(model.surface),
        all_(mesh::take_apart(model)),
        walls_(find_walls(surface_, find_panels(surface_), options.short_edge_mm, Slats::are_none)),
        largest_loop_(options.short_edge_mm),
        largest_mm_(largest_mm),
        loop_at_(surface_.corner_count(), no_index),
        gone_(surface_.face_count(), false) {}

  std::size_t run(mesh::Model& model) {
    find_loops();
    std::size_t count = 0;
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
      count += is_small(loops_[l]) && close(l) ? 1U : 0U;
    }
    if (count == 0) {
      return 0;
    }
    mesh::LooseFaces result = with_caps(all_, gone_, caps_);
    if (!mesh::is_surface(result)) {
      return 0;
    }
    mesh::put_together(model, std::move(result));
    return count;
  }

 private:
  [[nodiscard]] bool is_small(const WallLoop& loop) const {
    return loop.box.largest_extent() <= largest_loop_;
  }

  void find_loops() {
    for (WallLoop& loop : loops_within(surface_, walls_)) {
      if (!loop.has_rims && (is_small(loop) || loop.leaves_wall())) {
        for (const CornerId c : loop.sides) {
          loop_at_[c.value()] = static_cast<std::uint32_t>(loops_.size());
        }
        loops_.push_back(std::move(loop));
      }
    }
  }

  /// Takes out what is behind a loop, with all its other loops.
  bool close(std::uint32_t first) {
    const FaceId start = surface_.neighbor(loops_[first].sides.front());
    if (gone_[start.value()]) {
      return false;
    }
    std::vector<FaceId> inside{start};
    std::vector<std::uint32_t> ends;
    std::map<std::uint32_t, bool> is_inside{{start.value(), true}};
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (!is_near(inside[i], loops_[first])) {
        return false;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId beyond = surface_.twin(mesh::corner(inside[i], k));
        if (!beyond.valid()) {
          return false;
        }
        const FaceId next = mesh::face_of(beyond);
        if (loop_at_[beyond.value()] != no_index) {
          ends.push_back(loop_at_[beyond.value()]);
        } else if (is_inside.emplace(next.value(), true).second) {
          inside.push_back(next);
        }
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    Caps caps;
    for (const std::uint32_t l : ends) {
      if (!close_loop(surface_, walls_, loops_[l], caps)) {
        return false;
      }
    }
    if (!stays_near(inside, ends)) {
      return false;
    }
    for (const FaceId f : inside) {
      gone_[f.value()] = true;
    }
    caps_.insert(caps_.end(), caps.begin(), caps.end());
    return true;
  }

  /// Whatever hangs together behind a loop and is small enough is as near to its middle.
  [[nodiscard]] bool is_near(FaceId f, const WallLoop& loop) const {
    const Vec3 middle = 0.5 * (loop.box.low + loop.box.high);
    const double reach = 2.0 * (largest_loop_ + largest_mm_);
    const auto corners = surface_.vertices(f);
    return std::all_of(corners.begin(), corners.end(),
                       [&](VertexId v) { return length(surface_.point(v) - middle) <= reach; });
  }

  /// Whether nothing is farther from the walls that close it than the surface may move, nor these from it.
  [[nodiscard]] bool stays_near(const std::vector<FaceId>& inside,
                                const std::vector<std::uint32_t>& ends) const {
    const bool narrow = std::all_of(ends.begin(), ends.end(), [&](std::uint32_t l) {
      const Vec3 size = loops_[l].box.size();
      const double smallest = std::min({size.x, size.y, size.z});
      const double largest = std::max({size.x, size.y, size.z});
      return size.x + size.y + size.z - smallest - largest <= 2.0 * largest_mm_;
    });
    return narrow && std::all_of(inside.begin(), inside.end(), [&](FaceId f) {
             const auto [a, b, c] = surface_.vertices(f);
             const std::array<Vec3, 3> p{surface_.point(a), surface_.point(b), surface_.point(c)};
             const std::array<Vec3, 7> places{p[0],
                                              p[1],
                                              p[2],
                                              0.5 * (p[0] + p[1]),
                                              0.5 * (p[1] + p[2]),
                                              0.5 * (p[2] + p[0]),
                                              (p[0] + p[1] + p[2]) / 3.0};
             return std::all_of(places.begin(), places.end(), [&](Vec3 q) {
               return std::any_of(ends.begin(), ends.end(),
                                  [&](std::uint32_t l) { return distance(loops_[l].box, q) <= largest_mm_; });
             });
           });
  }

  const mesh::Surface& surface_;
  mesh::LooseFaces all_;
  Walls walls_;
  double largest_loop_;
  double largest_mm_;
  std::vector<WallLoop> loops_;
  std::vector<std::uint32_t> loop_at_;  ///< of each side of a wall: the small loop that it is part of
  std::vector<bool> gone_;              ///< faces
  Caps caps_;
};

}  // namespace

std::size_t remove_features(mesh::Model& model, const SimplifyOptions& options, double largest_mm) {
  FeatureRemover remover(model, options, largest_mm);
  return remover.run(model);
}

}  // namespace ridgecraft::prepare
