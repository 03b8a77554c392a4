// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/bodies/loose_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/squared_distance_3.h>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"

namespace ridgecraft::prepare {
namespace {

using mesh::Surface;
using Kernel = CGAL::Simple_cartesian<double>;

/// Bodies of a larger share of the area are missed: they stay, and a note says that they are loose.
constexpr double most_area = 0.05;
/// What can't be glued anywhere is left out where it has no more of the area, ...
constexpr double crumb_area = 0.005;
/// ... and all such bodies together no more than this: else the model is made of them.
constexpr double crumbs_area = 0.02;
/// Faces hold each other that are no steeper against each other than 75 degrees: the cosine.
constexpr double parallel = 0.26;
/// An opening is flat within this share of the distance at which bodies touch.
constexpr double flat_share = 1.0 / 6.0;
/// Pairs of faces between two questions whether to stop.
constexpr std::size_t pairs_per_check = 1U << 12U;

/// A face of a component, or a part of what closes one of its flat openings.
struct Side {
  std::array<Vec3, 3> corners;
  Vec3 normal;
  std::uint32_t component = 0;

  [[nodiscard]] Kernel::Triangle_3 triangle() const {
    const auto at = [](Vec3 p) { return Kernel::Point_3(p.x, p.y, p.z); };
    return {at(corners[0]), at(corners[1]), at(corners[2])};
  }
};

std::vector<Side> sides_of(const Surface& surface, double flat) {
  std::vector<Side> sides;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    if (surface.area(f) > 0.0) {
      sides.push_back({{surface.point(a), surface.point(b), surface.point(c)},
                       surface.normal(f),
                       surface.component(f).value()});
    }
  }
  for (const mesh::Opening& opening : mesh::flat_openings(surface, flat)) {
    const std::uint32_t component = surface.component(mesh::face_of(opening.sides.front())).value();
    for (const std::array<Vec3, 3>& corners : mesh::triangles_of(surface, opening)) {
      if (length(cross(corners[1] - corners[0], corners[2] - corners[0])) > 0.0) {
        sides.push_back({corners, opening.normal, component});
      }
    }
  }
  return sides;
}

/// What holds one body on another.
struct Hold {
  double touching = 0.0;  ///< faces no farther apart, ...
  double parallel = 0.0;  ///< ... and no steeper against each other: the cosine of their normals
};

/// Components that hold each other, as sets.
DisjointSets held_groups(const Surface& surface, const Hold& hold, const Context& context) {
  const std::vector<Side> sides = sides_of(surface, flat_share * hold.touching);
  std::vector<Box3> boxes;
  for (const Side& side : sides) {
    Box3 box;
    std::ranges::for_each(side.corners, [&](Vec3 p) { box.add(p); });
    boxes.push_back(grown(box, 0.5 * hold.touching));
  }
  DisjointSets groups(surface.component_count());
  std::size_t asked = 0;
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    const Side& one = sides[i];
    const Side& other = sides[j];
    if (groups.find(one.component) == groups.find(other.component) ||
        std::abs(dot(one.normal, other.normal)) < hold.parallel) {
      return;
    }
    if (++asked % pairs_per_check == 0) {
      context.check();
    }
    if (CGAL::squared_distance(one.triangle(), other.triangle()) <= hold.touching * hold.touching) {
      static_cast<void>(groups.join(one.component, other.component));
    }
  });
  return groups;
}

/// Components that hold each other.
struct Group {
  std::vector<FaceId> faces;  ///< ascending
  std::size_t components = 0;
  double area = 0.0;
  std::uint32_t before = 0;  ///< the group on the surface before that most of its corners lie on
};

std::vector<Group> groups_of(const Surface& surface, const Hold& hold, const Context& context) {
  DisjointSets sets = held_groups(surface, hold, context);
  std::map<std::uint32_t, Group> by_first;
  for (std::uint32_t c = 0; c < surface.component_count(); ++c) {
    ++by_first[sets.find(c)].components;
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    Group& group = by_first[sets.find(surface.component(f).value())];
    group.faces.push_back(f);
    group.area += surface.area(f);
  }
  std::vector<Group> groups;
  for (auto& [first, group] : by_first) {
    groups.push_back(std::move(group));
  }
  return groups;
}

void find_origins(std::vector<Group>& groups, const Surface& surface, const Surface& before, double touching,
                  const Context& context) {
  DisjointSets sets = held_groups(before, {touching}, context);
  const mesh::SurfaceTree tree(before, std::numeric_limits<double>::infinity());
  for (Group& group : groups) {
    std::map<std::uint32_t, std::size_t> corners;
    for (const FaceId f : group.faces) {
      FaceId near;
      static_cast<void>(tree.distance(surface.point(surface.vertices(f)[0]), 0.0, near));
      ++corners[sets.find(before.component(near).value())];
    }
    group.before = std::max_element(corners.begin(), corners.end(), [](const auto& a, const auto& b) {
                     return a.second < b.second;
                   })->first;
  }
}

/// The point of a face that is `distance` from p, which is none that is nearer.
Vec3 nearest_point(const Surface& surface, FaceId f, Vec3 p, double distance) {
  const auto [v0, v1, v2] = surface.vertices(f);
  const Vec3 a = surface.point(v0);
  const Vec3 b = surface.point(v1);
  const Vec3 c = surface.point(v2);
  const Vec3 normal = surface.normal(f);
  Vec3 best = p - dot(normal, p - a) * normal;
  for (const Vec3 q :
       {nearest_on_segment(p, a, b), nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)}) {
    // The foot in the plane is too near where it is beside the face.
    if (std::abs(length(p - q) - distance) < std::abs(length(p - best) - distance)) {
      best = q;
    }
  }
  return best;
}

/// The shortest way between a corner of one surface and the other surface, from the first one to the second;
/// none where that is longer than `most`.
std::optional<Vec3> way_between(const Surface& from, const Surface& to, double most) {
  std::optional<Vec3> way;
  const auto measure = [&](const Surface& corners, const Surface& faces, double sign) {
    const mesh::SurfaceTree tree(faces, std::numeric_limits<double>::infinity());
    for (const Vec3 p : corners.points()) {
      FaceId near;
      const double distance = tree.distance(p, 0.0, near);
      if (distance < most) {
        most = distance;
        way = sign * (nearest_point(faces, near, p, distance) - p);
      }
    }
  };
  measure(from, to, 1.0);
  measure(to, from, -1.0);
  return way;
}

bool is_larger(const Group& a, const Group& b) {
  return a.area != b.area ? a.area > b.area : a.faces.front() < b.faces.front();
}

/// What becomes of groups that lost their hold.
class Settling {
 public:
  Settling(mesh::Model& model, std::vector<Group> groups, const HoldRules& rules)
      : model_(model),
        groups_(std::move(groups)),
        rules_(rules),
        least_missed_(most_area * mesh::total_area(model.surface)) {}

  std::size_t run() {
    const Surface& surface = model_.surface;
    std::vector<Vec3> points(surface.points().begin(), surface.points().end());
    std::vector<bool> kept(surface.face_count(), true);
    std::size_t left_out = 0;
    for (const Group& group : groups_) {
      if (!lost_its_hold(group)) {
        continue;
      }
      if (const std::optional<Vec3> way = way_to_others(group)) {
        move(group, *way, points);
      } else if (group.area <= least_missed_) {
        left_out += group.components;
        for (const FaceId f : group.faces) {
          kept[f.value()] = false;
        }
      }
    }
    if (points != std::vector<Vec3>(surface.points().begin(), surface.points().end())) {
      mesh::LooseFaces faces = mesh::take_apart(model_);
      faces.points = std::move(points);
      mesh::put_together(model_, std::move(faces));
    }
    if (left_out > 0) {
      mesh::keep_faces(model_, kept);
    }
    return left_out;
  }

 private:
  [[nodiscard]] bool lost_its_hold(const Group& group) const {
    return std::any_of(groups_.begin(), groups_.end(), [&](const Group& other) {
      return other.before == group.before && is_larger(other, group);
    });
  }

  /// Onto those of which it was a part.
  [[nodiscard]] std::optional<Vec3> way_to_others(const Group& group) const {
    if (!(rules_.most_moved > 0.0)) {
      return std::nullopt;
    }
    std::vector<FaceId> others;
    for (const Group& other : groups_) {
      if (other.before == group.before && is_larger(other, group)) {
        others.insert(others.end(), other.faces.begin(), other.faces.end());
      }
    }
    return way_between(mesh::faces_alone(model_.surface, group.faces),
                       mesh::faces_alone(model_.surface, others), rules_.most_moved);
  }

  void move(const Group& group, Vec3 way, std::vector<Vec3>& points) const {
    std::vector<bool> moved(points.size(), false);
    for (const FaceId f : group.faces) {
      for (const VertexId v : model_.surface.vertices(f)) {
        if (!moved[v.value()]) {
          points[v.value()] = points[v.value()] + way;
          moved[v.value()] = true;
        }
      }
    }
  }

  mesh::Model& model_;
  std::vector<Group> groups_;
  const HoldRules& rules_;
  double least_missed_;
};

}  // namespace

std::size_t hold_again(mesh::Model& model, const Surface& before, const HoldRules& rules,
                       const Context& context) {
  if (model.surface.component_count() < 2) {
    return 0;
  }
  std::vector<Group> groups = groups_of(model.surface, {rules.touching}, context);
  if (groups.size() < 2) {
    return 0;
  }
  find_origins(groups, model.surface, before, rules.touching, context);
  return Settling(model, std::move(groups), rules).run();
}

std::size_t leave_out_crumbs(mesh::Model& model, double touching, const Context& context) {
  const Surface& surface = model.surface;
  if (surface.component_count() < 2) {
    return 0;
  }
  const std::vector<Group> groups = groups_of(surface, {touching, parallel}, context);
  const double whole = mesh::total_area(surface);
  std::vector<bool> kept(surface.face_count(), true);
  std::size_t left_out = 0;
  double area = 0.0;
  for (const Group& group : groups) {
    if (group.area <= crumb_area * whole) {
      left_out += group.components;
      area += group.area;
      for (const FaceId f : group.faces) {
        kept[f.value()] = false;
      }
    }
  }
  if (left_out == 0 || area > crumbs_area * whole) {
    return 0;
  }
  mesh::keep_faces(model, kept);
  return left_out;
}

}  // namespace ridgecraft::prepare
