// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/size.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "prepare/prepared/largest_size.hpp"

namespace ridgecraft::prepare {
namespace {

/// A speck; nothing of it could be cut.
constexpr double smallest_size_mm = 0.1;

}  // namespace

Resized resize(mesh::Model& model, const SizeOptions& size) {
  const Box3& box = model.surface.bounds();
  const double largest = box.largest_extent();
  const double factor =
      size.mm_per_unit ? *size.mm_per_unit * model.file_scale : size.largest_extent_mm / largest;
  const double result = factor * largest;
  if (!std::isfinite(result) || result > largest_size_mm) {
    throw Error(ErrorKind::no_nets, "the model would be larger than 100 m; choose a smaller size or scale");
  }
  if (!(result >= smallest_size_mm)) {
    throw Error(ErrorKind::no_nets, "the model would be smaller than 0.1 mm; choose a larger size or scale");
  }
  const Vec3 centre = 0.5 * box.low + 0.5 * box.high;
  std::vector<Vec3> points(model.surface.points().begin(), model.surface.points().end());
  const auto move = [&](Vec3& p) { p = factor * (p - centre); };
  std::for_each(points.begin(), points.end(), move);
  std::for_each(model.file_points.begin(), model.file_points.end(), move);
  for (auto& line : model.lines) {
    std::for_each(line.begin(), line.end(), move);
  }
  std::vector<std::array<VertexId, 3>> faces;
  faces.reserve(model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    faces.push_back(model.surface.vertices(f));
  }
  model.surface = mesh::Surface(std::move(points), std::move(faces));
  const double mm_per_unit = size.mm_per_unit ? *size.mm_per_unit : factor / model.file_scale;
  model.file_scale = 1.0;
  return {mm_per_unit, factor, centre};
}

}  // namespace ridgecraft::prepare
