// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/loose_faces.hpp"

#include <utility>

#include "mesh/repair/orient.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {

void LooseFaces::add(const LooseFaces& from, std::size_t i, const std::array<std::uint32_t, 3>& corners) {
  faces.push_back(corners);
  polygon.push_back(from.polygon[i]);
  if (!from.material.empty()) {
    material.push_back(from.material[i]);
  }
  if (!from.object.empty()) {
    object.push_back(from.object[i]);
  }
}

LooseFaces take_apart(const Model& model) {
  LooseFaces loose;
  loose.points.assign(model.surface.points().begin(), model.surface.points().end());
  loose.faces.reserve(model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const auto [a, b, c] = model.surface.vertices(f);
    loose.faces.push_back({a.value(), b.value(), c.value()});
  }
  loose.polygon = model.polygon.items();
  loose.material = model.material.items();
  loose.object = model.object.items();
  return loose;
}

bool is_surface(const LooseFaces& loose) {
  TriangleList list;
  list.points = loose.points;
  list.triangles.reserve(loose.faces.size());
  for (const auto& face : loose.faces) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) {
      return false;
    }
    list.triangles.push_back({face, {}, 0});
  }
  return is_manifold(list);
}

void make_surface(LooseFaces& loose, const Context& context) {
  TriangleList list;
  list.points = std::move(loose.points);
  list.triangles.reserve(loose.faces.size());
  for (std::uint32_t i = 0; i < loose.faces.size(); ++i) {
    list.triangles.push_back({loose.faces[i], {0, 1, 2}, i});
  }
  std::vector<EdgeUse> uses = edge_uses(list.triangles);
  RepairReport untold;
  make_manifold(list, uses, untold, context);
  for (std::size_t i = 0; i < loose.faces.size(); ++i) {
    loose.faces[i] = list.triangles[i].points;
  }
  loose.points = std::move(list.points);
}

void put_together(Model& model, LooseFaces loose) {
  model.surface = surface_of(loose.points, loose.faces);
  model.polygon = IdVector<FaceId, std::uint32_t>(std::move(loose.polygon));
  model.material = IdVector<FaceId, std::uint32_t>(std::move(loose.material));
  model.object = IdVector<FaceId, std::uint32_t>(std::move(loose.object));
  model.texture = {};
}

void keep_faces(Model& model, const std::vector<bool>& kept) {
  const LooseFaces all = take_apart(model);
  LooseFaces left;
  left.points = all.points;
  for (std::size_t f = 0; f < all.faces.size(); ++f) {
    if (kept[f]) {
      left.add(all, f, all.faces[f]);
    }
  }
  put_together(model, std::move(left));
}

}  // namespace ridgecraft::mesh
