// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/features/features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/constrained_delaunay.hpp"
#include "base/plane_frame.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// A closed line of sides between a wall and what opens in it, as the wall's faces run.
struct Loop {
  std::uint32_t wall = 0;
  std::vector<CornerId> sides;
  Box3 box;
  bool wide = false;  ///< larger than a fold is long: only what is shallow goes
};

/// What is shallow may be as large as this share of its wall: more would be all that there is to see of it.
constexpr double wide_share = 0.5;

class FeatureRemover {
 public:
  FeatureRemover(const mesh::Model& model, const SimplifyOptions& options, double largest_mm)
      : surface_(model.surface),
        all_(mesh::take_apart(model)),
        walls_(find_walls(surface_, find_panels(surface_), options.short_edge_mm, Slats::are_none)),
        largest_loop_(options.short_edge_mm),
        shallow_(std::min(largest_mm, options.tiny_edge_mm)),
        largest_mm_(largest_mm),
        loop_at_(surface_.corner_count(), none),
        gone_(surface_.face_count(), false) {}

  std::size_t run(mesh::Model& model) {
    find_loops();
    std::size_t count = 0;
    for (std::uint32_t l = 0; l < loops_.size(); ++l) {
      count += close(l) ? 1U : 0U;
    }
    if (count == 0) {
      return 0;
    }
    mesh::LooseFaces result;
    result.points = all_.points;
    for (std::size_t f = 0; f < gone_.size(); ++f) {
      if (!gone_[f]) {
        result.add(all_, f, all_.faces[f]);
      }
    }
    for (const auto& [face, like] : caps_) {
      result.add(all_, like, face);
      result.polygon.back() = mesh::Soup::none;
    }
    if (!mesh::is_surface(result)) {
      return 0;
    }
    mesh::put_together(model, std::move(result));
    return count;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  [[nodiscard]] std::uint32_t wall_of(CornerId c) const { return walls_.wall(mesh::face_of(c).value()); }

  [[nodiscard]] bool ends_wall(CornerId c) const {
    const CornerId beyond = surface_.twin(c);
    return beyond.valid() && wall_of(beyond) != wall_of(c);
  }

  /// The loops of each wall that are small, but for the largest: that is its outline.
  void find_loops() {
    std::map<std::uint32_t, std::vector<Loop>> of_wall;
    std::vector<bool> seen(surface_.corner_count(), false);
    for (const CornerId c : ids<CornerId>(surface_.corner_count())) {
      if (wall_of(c) != Walls::none && ends_wall(c) && !seen[c.value()]) {
        if (auto loop = follow(c, seen)) {
          of_wall[loop->wall].push_back(std::move(*loop));
        }
      }
    }
    for (auto& [wall, loops] : of_wall) {
      const auto outline = std::max_element(loops.begin(), loops.end(), [](const Loop& a, const Loop& b) {
        return a.box.diagonal() < b.box.diagonal();
      });
      for (Loop& loop : loops) {
        loop.wide = loop.box.largest_extent() > largest_loop_;
        if (&loop != &*outline &&
            (!loop.wide || loop.box.largest_extent() <= wide_share * outline->box.largest_extent())) {
          for (const CornerId c : loop.sides) {
            loop_at_[c.value()] = static_cast<std::uint32_t>(loops_.size());
          }
          loops_.push_back(std::move(loop));
        }
      }
    }
  }

  /// None where the line ends at a border.
  std::optional<Loop> follow(CornerId start, std::vector<bool>& seen) const {
    Loop loop;
    loop.wall = wall_of(start);
    CornerId c = start;
    do {
      seen[c.value()] = true;
      loop.sides.push_back(c);
      loop.box.add(surface_.point(surface_.vertex(c)));
      // On around the end of the side, within the wall.
      c = mesh::next(c);
      while (c.valid() && !ends_wall(c)) {
        const CornerId twin = surface_.twin(c);
        c = twin.valid() ? mesh::next(twin) : CornerId();
      }
    } while (c.valid() && c != start && !seen[c.value()]);
    return c == start ? std::optional(std::move(loop)) : std::nullopt;
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
    const bool wide = loops_[first].wide;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (!(wide ? is_shallow(inside[i], loops_[first]) : is_near(inside[i], loops_[first]))) {
        return false;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId beyond = surface_.twin(mesh::corner(inside[i], k));
        if (!beyond.valid()) {
          return false;
        }
        const FaceId next = mesh::face_of(beyond);
        if (loop_at_[beyond.value()] != none) {
          ends.push_back(loop_at_[beyond.value()]);
        } else if (is_inside.emplace(next.value(), true).second) {
          inside.push_back(next);
        }
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    if (wide && ends.size() > 1) {
      return false;
    }
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t>> caps;
    for (const std::uint32_t l : ends) {
      if (!cap(loops_[l], caps)) {
        return false;
      }
    }
    if (!wide && !stays_near(inside, ends)) {
      return false;
    }
    for (const FaceId f : inside) {
      gone_[f.value()] = true;
    }
    caps_.insert(caps_.end(), caps.begin(), caps.end());
    return true;
  }

  /// Whatever hangs together behind a loop and is small enough is as near to its middle.
  [[nodiscard]] bool is_near(FaceId f, const Loop& loop) const {
    const Vec3 middle = 0.5 * (loop.box.low + loop.box.high);
    const double reach = 2.0 * (largest_loop_ + largest_mm_);
    const auto corners = surface_.vertices(f);
    return std::all_of(corners.begin(), corners.end(),
                       [&](VertexId v) { return length(surface_.point(v) - middle) <= reach; });
  }

  /// What closes a loop and is nowhere farther from its wall than this covers the wall there, so neither is
  /// the wall farther from it.
  [[nodiscard]] bool is_shallow(FaceId f, const Loop& loop) const {
    const auto corners = surface_.vertices(f);
    return std::all_of(corners.begin(), corners.end(), [&](VertexId v) {
      const Vec3 p = surface_.point(v);
      return std::abs(walls_.walls[loop.wall].height(p)) <= shallow_ && distance(loop.box, p) <= shallow_;
    });
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

  static double distance(const Box3& box, Vec3 p) {
    return length(p - Vec3{std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y),
                           std::clamp(p.z, box.low.z, box.high.z)});
  }

  bool cap(const Loop& loop, std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t>>& caps) const {
    const PlaneFrame frame(surface_.point(surface_.vertex(loop.sides.front())),
                           walls_.walls[loop.wall].normal);
    std::vector<std::uint32_t> vertices;
    std::vector<Vec2> flat;
    std::vector<std::array<std::uint32_t, 2>> sides;
    const auto count = static_cast<std::uint32_t>(loop.sides.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      // The other way round than the wall's faces run.
      const VertexId v = surface_.vertex(loop.sides[count - 1 - i]);
      vertices.push_back(v.value());
      flat.push_back(frame.flat(surface_.point(v)));
      sides.push_back({i, (i + 1) % count});
    }
    const auto triangles = triangulate_inside(flat, sides);
    if (!triangles || triangles->size() + 2 != count) {
      return false;
    }
    for (const auto& [a, b, c] : *triangles) {
      caps.push_back({{vertices[a], vertices[b], vertices[c]}, mesh::face_of(loop.sides.front()).value()});
    }
    return true;
  }

  const mesh::Surface& surface_;
  mesh::LooseFaces all_;
  Walls walls_;
  double largest_loop_;
  double shallow_;
  double largest_mm_;
  std::vector<Loop> loops_;
  std::vector<std::uint32_t> loop_at_;  ///< of each side of a wall: the small loop that it is part of
  std::vector<bool> gone_;              ///< faces
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t>> caps_;  ///< and the face each is like
};

}  // namespace

std::size_t remove_features(mesh::Model& model, const SimplifyOptions& options, double largest_mm) {
  FeatureRemover remover(model, options, largest_mm);
  return remover.run(model);
}

}  // namespace ridgecraft::prepare
