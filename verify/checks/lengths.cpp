// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 1: every net face is congruent to its model face, and model polygons are plane.
#include <cmath>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/polygon.hpp"

namespace ridgecraft::verify {
namespace {

struct Difference {
  double worst = 0.0;  ///< mm, of all sides and diagonals
  bool tolerable = true;
};

Difference compare(std::span<const Vec2> net, std::span<const Vec3> model, const Context& context) {
  Difference result;
  for (std::size_t i = 0; i < net.size(); ++i) {
    context.check();
    for (std::size_t j = i + 1; j < net.size(); ++j) {
      const double truth = length(model[j] - model[i]);
      const double error = std::abs(length(net[j] - net[i]) - truth);
      result.worst = std::fmax(result.worst, error);
      result.tolerable = result.tolerable && error <= length_tolerance_mm + length_tolerance_share * truth;
    }
  }
  return result;
}

void check_congruence(const Case& given, Index face, const Polygon& polygon, Findings& findings) {
  const File& file = given.file;
  const Relations& relations = given.relations;
  const Context& context = given.context;
  const Index model_face = file.face_model[face];
  if (!relations.corners_match[face]) {
    findings.add(Promise::lengths, {{"face", face}, {"model_face", model_face}}, [&] {
      return fmt::format("{} has {} corners, its model face {} has {}", face_name(file, face), polygon.size(),
                         model_face, file.model.faces.size(model_face));
    });
    return;
  }
  std::vector<Vec3> corners;
  for (const Index v : file.model.faces.vertices(model_face)) {
    corners.push_back(file.model.points[v]);
  }
  const Difference difference = compare(polygon, corners, context);
  double& worst = findings.figures().max_length_error_mm;
  worst = std::fmax(worst, difference.worst);
  if (!difference.tolerable) {
    findings.add(Promise::lengths, {{"face", face}, {"model_face", model_face}}, [&] {
      return fmt::format("{} differs from its model face {} by {:.4g} mm in a length", face_name(file, face),
                         model_face, difference.worst);
    });
  }
}

void check_shape(const Case& given, Index face, const Polygon& polygon, Findings& findings) {
  if (!(doubled_area(polygon) > 0.0)) {
    findings.add(Promise::lengths, {{"face", face}}, [&] {
      return fmt::format("{} is not counterclockwise: it is mirrored or has no area",
                         face_name(given.file, face));
    });
  } else if (!is_convex(polygon) && !is_simple(polygon, given.context)) {
    findings.add(Promise::lengths, {{"face", face}}, [&] {
      return fmt::format("the outline of {} crosses or touches itself", face_name(given.file, face));
    });
  }
}

void check_plane(const Case& given, Index model_face, Findings& findings) {
  const Model& model = given.file.model;
  const std::span<const Index> corners = model.faces.vertices(model_face);
  if (corners.size() == 3) {
    return;
  }
  Vec3 mean;
  for (const Index v : corners) {
    mean += model.points[v] / static_cast<double>(corners.size());
  }
  double worst = 0.0;
  for (const Index v : corners) {
    worst = std::fmax(worst, std::abs(dot(model.points[v] - mean, given.relations.normal[model_face])));
  }
  if (worst > plane_tolerance_share * model.size) {
    findings.add(Promise::lengths, {{"model_face", model_face}}, [&] {
      return fmt::format("model face {} is not plane: a corner is {:.4g} mm beside its plane", model_face,
                         worst);
    });
  }
}

}  // namespace

void check_lengths(const Case& given, Findings& findings) {
  for (Index face = 0; face < given.file.faces.faces(); ++face) {
    given.context.check();
    const Polygon polygon = given.file.polygon(face);
    check_congruence(given, face, polygon, findings);
    check_shape(given, face, polygon, findings);
  }
  for (Index face = 0; face < given.file.model.faces.faces(); ++face) {
    check_plane(given, face, findings);
  }
}

}  // namespace ridgecraft::verify
