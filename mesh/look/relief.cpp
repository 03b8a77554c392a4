// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/look/relief.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "base/rays.hpp"

namespace ridgecraft::mesh {
namespace {

Box3 box_of(std::span<const Vec3> points) {
  Box3 box;
  for (const Vec3 p : points) {
    box.add(p);
  }
  return box;
}

ReliefParts moved(ReliefParts parts, double factor, Vec3 shift) {
  for (std::array<Vec3, 3>& face : parts.faces) {
    for (Vec3& p : face) {
      p = factor * p + shift;
    }
  }
  for (Crease& crease : parts.creases) {
    for (Vec3& p : crease.ends) {
      p = factor * p + shift;
    }
  }
  return parts;
}

}  // namespace

std::optional<ReliefParts> relief_of(const Surface& surface) {
  ReliefParts parts;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (!surface.is_border(e) && std::abs(surface.fold_angle(e)) < crease_angle) {
      continue;
    }
    const auto [one, other] = surface.sides(e);
    const Vec3 normal = surface.normal(face_of(one));
    parts.creases.push_back({{surface.point(surface.vertex(one)), surface.point(surface.vertex(next(one)))},
                             {normal, other.valid() ? surface.normal(face_of(other)) : normal}});
  }
  if (parts.creases.empty()) {
    return std::nullopt;
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (surface.normal(f) != Vec3{}) {
      const auto [a, b, c] = surface.vertices(f);
      parts.faces.push_back({surface.point(a), surface.point(b), surface.point(c)});
    }
  }
  return parts;
}

Relief::Relief(ReliefParts parts, double factor, Vec3 shift)
    : parts_(moved(std::move(parts), factor, shift)),
      face_tree_(
          parts_.faces.size(), [&](std::uint32_t f) { return box_of(parts_.faces[f]); },
          [&](std::uint32_t f) { return centre(box_of(parts_.faces[f])); }),
      crease_tree_(
          parts_.creases.size(), [&](std::uint32_t i) { return box_of(parts_.creases[i].ends); },
          [&](std::uint32_t i) { return centre(box_of(parts_.creases[i].ends)); }) {}

bool Relief::hides(Vec3 from, Vec3 way) const {
  bool hidden = false;
  face_tree_.search(
      [&](std::uint32_t node) { return !hidden && comes_near(from, way, face_tree_.box(node)); },
      [&](std::uint32_t place) {
        hidden = hidden || meets_at(from, way, parts_.faces[face_tree_.order()[place]]) <= 1.0;
      });
  return hidden;
}

}  // namespace ridgecraft::mesh
