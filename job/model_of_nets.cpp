// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/model_of_nets.hpp"

#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "job/old_nets.hpp"
#include "job/same_place.hpp"
#include "mesh/mesh.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::job {
namespace {

/// Points of one model and of its nets that are one, as a share of the model's largest extent: FOLD files
/// keep all digits, so rounding alone lies between them.
constexpr double unchanged_share = 1e-6;
/// Flat regions are remeshed, so even nets of the model as it is lack some of its points, and have others
/// where a page cut a region.
constexpr double most_other_points = 0.1;

std::optional<prepare::SimplifyOptions> simplified_by(const verify::Settings& settings) {
  prepare::SimplifyOptions simplify;
  if (const std::optional<double> faces = settings.number("faces")) {
    simplify.mode = prepare::Simplification::count;
    simplify.faces = static_cast<std::size_t>(*faces);
    return simplify;
  }
  const verify::Setting* const word = settings.find("faces");
  const auto* const text = word == nullptr ? nullptr : std::get_if<std::string>(word);
  return text != nullptr && *text == "auto" ? std::optional(simplify) : std::nullopt;
}

/// Millimetres of the nets for 1 of the model's surface.
std::optional<double> scale_of(const verify::Settings& settings, const mesh::Model& model) {
  if (const auto factor = settings.number("mm_per_unit")) {
    return *factor * model.file_scale;
  }
  const auto size = settings.number("size_mm");
  return size ? std::optional(*size / model.surface.bounds().largest_extent()) : std::nullopt;
}

std::string as_off(const std::vector<Vec3>& points, const verify::FaceList& faces) {
  std::string text = fmt::format("OFF\n{} {} 0\n", points.size(), faces.faces());
  for (const Vec3 p : points) {
    text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  }
  for (verify::Index face = 0; face < faces.faces(); ++face) {
    text += fmt::format("{} {}\n", faces.size(face), fmt::join(faces.vertices(face), " "));
  }
  return text;
}

}  // namespace

std::optional<prepare::SimplifyOptions> simplified_by(const OldNets& old) {
  return is_fold_file(old) ? simplified_by(read_fold_file(old).settings) : std::nullopt;
}

std::optional<ModelOfNets> model_of_nets(const OldNets& old, const mesh::Model& model,
                                         const Context& context) {
  if (!is_fold_file(old)) {
    return std::nullopt;
  }
  const verify::File nets = read_fold_file(old);
  const auto simplify = simplified_by(nets.settings);
  const auto scale = scale_of(nets.settings, model);
  if (!simplify || !scale || nets.digest != model.digest || nets.model.points.empty()) {
    return std::nullopt;
  }
  // prepare() puts the middle of a model's box at the origin.
  const Vec3 middle = 0.5 * (model.surface.bounds().low + model.surface.bounds().high);
  std::vector<Vec3> points;
  for (const Vec3 p : nets.model.points) {
    points.push_back(p / *scale + middle);
  }
  if (PointSet(model.surface, unchanged_share).share_of(points) >= 1.0 - most_other_points) {
    return std::nullopt;
  }
  mesh::Model found = mesh::read({as_off(points, nets.model.faces), old.name, model.name, {}}, {}, context);
  found.digest = model.digest;
  found.frame = model.frame;
  found.format = model.format;
  found.repairs = model.repairs;
  found.polygon_count = model.polygon_count;
  found.file_scale = model.file_scale;
  found.file_points = model.file_points;
  return ModelOfNets{std::move(found), *simplify};
}

}  // namespace ridgecraft::job
