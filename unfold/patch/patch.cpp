// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/patch/patch.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace ridgecraft::unfold {
namespace {

std::uint32_t local_number(std::span<const FaceId> faces, FaceId f) {
  const auto at = std::lower_bound(faces.begin(), faces.end(), f);
  return at != faces.end() && *at == f ? static_cast<std::uint32_t>(at - faces.begin()) : no_index;
}

EdgeConstraint constraint_at(std::span<const EdgeConstraint> constraints, EdgeId e) {
  return constraints.empty() ? EdgeConstraint::none : constraints[e.value()];
}

}  // namespace

Triangle flat_shape(Vec3 a, Vec3 b, Vec3 c) {
  const std::array<Vec3, 3> p{a, b, c};
  unsigned base = 0;  // the longest side: then the third corner has the smallest error, slivers included
  for (unsigned k = 1; k < 3; ++k) {
    if (length(p[(k + 1) % 3] - p[k]) > length(p[(base + 1) % 3] - p[base])) {
      base = k;
    }
  }
  const Vec3 along = p[(base + 1) % 3] - p[base];
  const Vec3 up = p[(base + 2) % 3] - p[base];
  const double size = length(along);
  Triangle flat{};
  if (size > 0.0) {
    flat[(base + 1) % 3] = {size, 0.0};
    flat[(base + 2) % 3] = {dot(up, along) / size, length(cross(along, up)) / size};
  }
  // Around its own middle: the frame's rounding errors are then as small as the face allows.
  const Vec2 middle = (flat[0] + flat[1] + flat[2]) / 3.0;
  for (Vec2& q : flat) {
    q -= middle;
  }
  return flat;
}

Patch make_patch(const mesh::Surface& surface, const prepare::Panels& panels, std::span<const FaceId> faces,
                 std::span<const EdgeConstraint> constraints, std::span<const std::uint32_t> labels) {
  Patch patch;
  patch.face.assign(faces.begin(), faces.end());
  const std::size_t sides = 3 * faces.size();
  patch.twin.assign(sides, no_index);
  patch.frozen.assign(sides, 0);
  patch.labels_meet.assign(sides, 0);
  patch.across.resize(sides);
  patch.length.resize(sides);
  patch.fold_angle.resize(sides);
  patch.shape.reserve(faces.size());
  const Vec3 size = surface.bounds().size();
  patch.extent = std::max({size.x, size.y, size.z});
  for (const FaceId f : faces) {
    const auto [a, b, c] = surface.vertices(f);
    patch.shape.push_back(flat_shape(surface.point(a), surface.point(b), surface.point(c)));
  }
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t side = 3 * f + k;
      const CornerId c = mesh::corner(patch.face[f], k);
      patch.length[side] = surface.length(surface.edge(c));
      patch.fold_angle[side] = surface.fold_angle(surface.edge(c));
      const CornerId t = surface.twin(c);
      if (!labels.empty() && t.valid()) {
        patch.labels_meet[side] = labels[patch.face[f].value()] != labels[mesh::face_of(t).value()] ? 1 : 0;
      }
      const EdgeConstraint constraint = constraint_at(constraints, surface.edge(c));
      const std::uint32_t g =
          t.valid() && constraint != EdgeConstraint::cut ? local_number(faces, mesh::face_of(t)) : no_index;
      if (g == no_index) {
        continue;
      }
      const std::uint32_t j = t.value() % 3;
      patch.twin[side] = 3 * g + j;
      const bool within = panels.panel[patch.face[f]] == panels.panel[patch.face[g]];
      patch.frozen[side] = within || constraint == EdgeConstraint::keep ? frozen_in_panel
                           : constraint == EdgeConstraint::band         ? frozen_in_band
                                                                        : 0;
      const Triangle& here = patch.shape[f];
      const Triangle& there = patch.shape[g];
      patch.across[side] = lay_across(here[k], here[(k + 1) % 3], there[j], there[(j + 1) % 3]);
    }
  }
  return patch;
}

DisjointSets connected_faces(const Patch& patch, std::span<const PartId> part) {
  DisjointSets sets(patch.size());
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != no_index && (part.empty() || part[side / 3] == part[twin / 3])) {
      sets.join(side / 3, twin / 3);
    }
  }
  return sets;
}

double area_of(const Patch& patch, std::span<const std::uint32_t> faces) {
  double area = 0.0;
  for (const std::uint32_t f : faces) {
    area += area_of(patch.shape[f]);
  }
  return area;
}

double area_of(const Patch& patch) {
  double area = 0.0;
  for (const Triangle& t : patch.shape) {
    area += area_of(t);
  }
  return area;
}

std::vector<std::vector<FaceId>> connected(const mesh::Surface& surface, std::span<const FaceId> faces,
                                           std::span<const EdgeConstraint> constraints) {
  std::vector<std::vector<FaceId>> components;
  std::vector<std::uint8_t> seen(faces.size(), 0);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t start = 0; start < faces.size(); ++start) {
    if (seen[start] != 0) {
      continue;
    }
    std::vector<FaceId>& component = components.emplace_back();
    seen[start] = 1;
    stack.push_back(start);
    while (!stack.empty()) {
      const FaceId f = faces[stack.back()];
      stack.pop_back();
      component.push_back(f);
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(f, k);
        const FaceId g = surface.neighbor(c);
        const bool cut = constraint_at(constraints, surface.edge(c)) == EdgeConstraint::cut;
        const std::uint32_t at = g.valid() && !cut ? local_number(faces, g) : no_index;
        if (at != no_index && seen[at] == 0) {
          seen[at] = 1;
          stack.push_back(at);
        }
      }
    }
    std::sort(component.begin(), component.end());
  }
  return components;
}

namespace {

/// Number of a face among ascending ones; nothing where it isn't there.
std::uint32_t place_among(std::span<const std::uint32_t> faces, std::uint32_t f) {
  const auto at = std::lower_bound(faces.begin(), faces.end(), f);
  return at != faces.end() && *at == f ? static_cast<std::uint32_t>(at - faces.begin()) : no_index;
}

}  // namespace

Patch sub_patch(const Patch& patch, std::span<const std::uint32_t> faces) {
  Patch sub;
  sub.extent = patch.extent;
  const std::size_t n = faces.size();
  sub.face.reserve(n);
  sub.shape.reserve(n);
  sub.twin.reserve(3 * n);
  sub.frozen.reserve(3 * n);
  sub.across.reserve(3 * n);
  sub.length.reserve(3 * n);
  sub.fold_angle.reserve(3 * n);
  sub.labels_meet.reserve(3 * n);
  for (const std::uint32_t f : faces) {
    sub.face.push_back(patch.face[f]);
    sub.shape.push_back(patch.shape[f]);
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      const std::uint32_t twin = patch.twin[side];
      const std::uint32_t g = twin == no_index ? no_index : place_among(faces, twin / 3);
      sub.twin.push_back(g == no_index ? no_index : 3 * g + twin % 3);
      sub.frozen.push_back(g == no_index ? std::uint8_t{0} : patch.frozen[side]);
      sub.across.push_back(patch.across[side]);
      sub.length.push_back(patch.length[side]);
      sub.fold_angle.push_back(patch.fold_angle[side]);
      sub.labels_meet.push_back(patch.labels_meet[side]);
    }
  }
  return sub;
}

Folds sub_folds(const Patch& patch, const Folds& folds, std::span<const std::uint32_t> faces) {
  Folds sub(3 * faces.size(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t side = 3 * faces[i] + k;
      if (folds[side] != 0 && place_among(faces, patch.twin[side] / 3) != no_index) {
        sub[3 * i + k] = 1;
      }
    }
  }
  return sub;
}

void put_back(const Patch& patch, std::span<const std::uint32_t> faces, const Folds& sub, Folds& folds) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t side = 3 * faces[i] + k;
      if (patch.twin[side] != no_index && place_among(faces, patch.twin[side] / 3) != no_index) {
        folds[side] = sub[3 * i + k];
      }
    }
  }
}

}  // namespace ridgecraft::unfold
