// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/model.hpp"

#include <array>
#include <utility>

namespace ridgecraft::mesh {

void to_file_numbers(std::vector<Vec3>& points, double file_scale) {
  if (file_scale == 1.0) {
    return;
  }
  for (Vec3& p : points) {
    p = file_scale * p;
  }
}

Surface surface_in_file_numbers(const Model& model) {
  if (model.file_scale == 1.0) {
    return model.surface;
  }
  std::vector<Vec3> points(model.surface.points().begin(), model.surface.points().end());
  to_file_numbers(points, model.file_scale);
  std::vector<std::array<VertexId, 3>> faces;
  faces.reserve(model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    faces.push_back(model.surface.vertices(f));
  }
  return {std::move(points), std::move(faces)};
}

}  // namespace ridgecraft::mesh
