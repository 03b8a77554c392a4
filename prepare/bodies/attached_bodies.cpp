// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/bodies/attached_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/features/features.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {
namespace {

/// What stands on a face rises from it by so much at least, radians (30 degrees).
constexpr double rises = 0.5235987755982988;
/// Faces are parallel up to this (cosine of half a degree), ...
constexpr double parallel_cosine = 0.99996;
/// ... and in one plane up to this share of the model's extent.
constexpr double in_one_plane = 1e-5;

/// Each flat face as the wall that it is.
Walls walls_of_panels(const mesh::Surface& surface, const Panels& panels) {
  Walls walls;
  walls.of_face.resize(surface.face_count());
  for (const PanelId p : ids<PanelId>(panels.count())) {
    Vec3 normal;
    for (const FaceId f : panels.faces[p]) {
      normal += surface.area(f) * surface.normal(f);
      walls.of_face[f.value()] = static_cast<std::uint32_t>(walls.walls.size());
    }
    Wall wall;
    wall.normal = length(normal) > 0.0 ? normalized(normal) : Vec3{};
    wall.offset = dot(surface.point(surface.vertices(panels.faces[p].front())[0]), wall.normal);
    walls.walls.push_back(wall);
  }
  return walls;
}

/// Nobody glues anything with a smaller base, mm^2.
constexpr double least_base = 6.0;

/// Bases that differ by less than this share of their area are equal: all of them part, or none.
constexpr double equal_bases = 1e-3;

class StandingBodies {
 public:
  explicit StandingBodies(mesh::Model& model)
      : model_(model),
        surface_(model.surface),
        walls_(walls_of_panels(surface_, find_panels(surface_))),
        in_one_plane_(in_one_plane * surface_.bounds().largest_extent()) {}

  std::size_t part(const Context& context) {
    for (WallLoop& loop : loops_within(surface_, walls_)) {
      context.check();
      Caps caps;
      if (is_foot(loop) && close_loop(surface_, walls_, loop, caps)) {
        bases_.push_back({std::move(loop), std::move(caps)});
      }
    }
    drop_feet_that_hold(context);
    // Those that stand, and no more of them than there is room for; a pillar between two plates makes two
    // bodies more.
    std::size_t room = most_loose_bodies - std::min(most_loose_bodies, surface_.component_count());
    while (!bases_.empty() && component_count() > most_loose_bodies) {
      room = drop_largest_feet(room);
      drop_feet_that_hold(context);
    }
    return bases_.empty() ? 0 : make();
  }

 private:
  struct Base {
    WallLoop loop;
    Caps caps;
  };

  [[nodiscard]] FaceId attached_face(CornerId side) const { return surface_.neighbor(side); }

  [[nodiscard]] bool is_foot(const WallLoop& loop) const {
    if (loop.has_rims || loop.area < least_base || length(walls_.walls[loop.wall].normal) == 0.0) {
      return false;
    }
    std::set<std::uint32_t> seen;
    return std::ranges::all_of(loop.sides, [&](CornerId side) {
      return surface_.fold_angle(surface_.edge(side)) >= rises &&
             seen.insert(surface_.vertex(side).value()).second && sides_at(loop.wall, side) == 1;
    });
  }

  /// How many sides of its wall begin at the vertex where this one does.
  [[nodiscard]] std::size_t sides_at(std::uint32_t wall, CornerId side) const {
    const auto corners = surface_.corners_at(surface_.vertex(side));
    return static_cast<std::size_t>(std::count_if(corners.begin(), corners.end(), [&](CornerId c) {
      const FaceId beyond = surface_.neighbor(c);
      return walls_.wall(mesh::face_of(c).value()) == wall &&
             (!beyond.valid() || walls_.wall(beyond.value()) != wall);
    }));
  }

  /// The first face of each face's component when all bases part the surface.
  [[nodiscard]] std::vector<std::uint32_t> components() const {
    std::vector<bool> parts(surface_.edge_count(), false);
    for (const Base& base : bases_) {
      for (const CornerId side : base.loop.sides) {
        parts[surface_.edge(side).value()] = true;
      }
    }
    DisjointSets sets(surface_.face_count());
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      if (!surface_.is_border(e) && !parts[e.value()]) {
        const auto [a, b] = surface_.sides(e);
        sets.join(mesh::face_of(a).value(), mesh::face_of(b).value());
      }
    }
    std::vector<std::uint32_t> first(surface_.face_count());
    for (std::uint32_t f = 0; f < first.size(); ++f) {
      first[f] = sets.find(f);
    }
    return first;
  }

  /// A base that doesn't part the surface holds together what others would have parted.
  void drop_feet_that_hold(const Context& context) {
    while (!bases_.empty() && drop_some_that_hold()) {
      context.check();
    }
  }

  bool drop_some_that_hold() {
    const std::vector<std::uint32_t> component = components();
    std::map<std::uint32_t, std::vector<FaceId>> faces;
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      faces[component[f.value()]].push_back(f);
    }
    return std::erase_if(bases_, [&](const Base& base) {
             const std::uint32_t below = component[mesh::face_of(base.loop.sides.front()).value()];
             const std::uint32_t above = component[attached_face(base.loop.sides.front()).value()];
             return below == above ||
                    std::ranges::any_of(
                        base.loop.sides,
                        [&](CornerId side) { return component[attached_face(side).value()] != above; }) ||
                    has_floor(walls_.walls[base.loop.wall], faces[above]);
           }) > 0;
  }

  [[nodiscard]] std::size_t component_count() const {
    const std::vector<std::uint32_t> component = components();
    return std::set<std::uint32_t>(component.begin(), component.end()).size();
  }

  /// Leaves so many bodies standing, or less: a small hole is harder to glue into than a large one. Returns
  /// for how many there is room if these are still too many.
  std::size_t drop_largest_feet(std::size_t room) {
    const std::vector<std::uint32_t> component = components();
    const auto body = [&](const Base& base) {
      return component[attached_face(base.loop.sides.front()).value()];
    };
    std::map<std::uint32_t, double> area;  // of the bases of each body
    for (const Base& base : bases_) {
      area[body(base)] += base.loop.area;
    }
    std::vector<double> areas;
    for (const auto& [first, sum] : area) {
      areas.push_back(sum);
    }
    std::ranges::sort(areas);
    room = std::min(room, areas.size() - 1);
    const double smallest_dropped = areas[room];
    std::erase_if(
        bases_, [&](const Base& base) { return (1.0 + equal_bases) * area[body(base)] >= smallest_dropped; });
    return room;
  }

  /// Whether any of the faces lies in the wall's plane and looks as it does.
  [[nodiscard]] bool has_floor(const Wall& wall, const std::vector<FaceId>& faces) const {
    return std::ranges::any_of(faces, [&](FaceId f) {
      return dot(surface_.normal(f), wall.normal) >= parallel_cosine &&
             std::ranges::all_of(surface_.vertices(f), [&](VertexId v) {
               return std::abs(wall.height(surface_.point(v))) <= in_one_plane_;
             });
    });
  }

  std::size_t make() {
    const std::vector<std::uint32_t> component = components();
    mesh::LooseFaces loose = mesh::take_apart(model_);
    Caps caps;
    std::set<std::uint32_t> attached;
    for (const Base& base : bases_) {
      caps.insert(caps.end(), base.caps.begin(), base.caps.end());
      const std::uint32_t above = component[attached_face(base.loop.sides.front()).value()];
      attached.insert(above);
      for (const CornerId side : base.loop.sides) {
        give_own_point(surface_.vertex(side), above, component, loose);
      }
    }
    mesh::put_together(model_, with_caps(loose, std::vector<bool>(surface_.face_count(), false), caps));
    return attached.size();
  }

  /// To the faces of a component at a vertex.
  void give_own_point(VertexId v, std::uint32_t owner, const std::vector<std::uint32_t>& component,
                      mesh::LooseFaces& loose) const {
    const auto own = static_cast<std::uint32_t>(loose.points.size());
    loose.points.push_back(surface_.point(v));
    for (const CornerId c : surface_.corners_at(v)) {
      const FaceId f = mesh::face_of(c);
      if (component[f.value()] == owner) {
        std::array<std::uint32_t, 3>& corners = loose.faces[f.value()];
        std::replace(corners.begin(), corners.end(), v.value(), own);
      }
    }
  }

  mesh::Model& model_;
  const mesh::Surface& surface_;
  Walls walls_;
  double in_one_plane_;
  std::vector<Base> bases_;
};

}  // namespace

std::size_t part_attached_bodies(mesh::Model& model, const Context& context) {
  return StandingBodies(model).part(context);
}

}  // namespace ridgecraft::prepare
