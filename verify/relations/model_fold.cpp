// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/relations/model_fold.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "base/elementary.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {

ModelFold model_fold(const File& file, const Relations& relations, Index model_side) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  const Model& model = file.model;
  const Index a = model.faces.face(model_side);
  const Index b = model.faces.face(model.twin[model_side]);
  const Vec3 along = model.points[model.faces.head(model_side)] - model.points[model.faces.tail(model_side)];
  const double sine = dot(cross(relations.normal[a], relations.normal[b]), normalized(along));
  ModelFold fold;
  fold.angle_deg = -elementary::atan2(sine, dot(relations.normal[a], relations.normal[b])) * degrees;
  // Faces without area have no normal: then every angle is within the tolerance.
  const double area = std::min(relations.area[a], relations.area[b]);
  fold.tolerance_deg = area > 0.0
                           ? angle_tolerance_deg + degrees * slender_share * model.size * length(along) / area
                           : std::numeric_limits<double>::infinity();
  return fold;
}

}  // namespace ridgecraft::verify
