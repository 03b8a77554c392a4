// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/symmetric_share.hpp"

#include <cstdint>
#include <optional>
#include <utility>

#include "mesh/repair/loose_faces.hpp"
#include "prepare/shares/halve.hpp"
#include "prepare/shares/share_twins.hpp"
#include "prepare/shares/whole.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {
namespace {

/// Corners so near to the plane, as a share of the extent, lie on it: cutting beside them would leave
/// splinters.
constexpr double on_plane = 1e-5;
/// Planes that are tried: one may be no use since a face lies in it.
constexpr std::size_t most_planes = 3;

/// All faces, each for itself.
SymmetricShare all_of(const mesh::LooseFaces& model) {
  SymmetricShare share;
  share.faces = model;
  share.faces.material.clear();
  share.faces.object.clear();
  for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
    share.faces.material.push_back(f);
    share.origins.push_back({f, PointRules::none});
  }
  share.points.plane.assign(model.points.size(), PointRules::none);
  share.points.copies.assign(model.points.size(), 1);
  return share;
}

/// One side of the model at the best plane that divides it well.
std::optional<SymmetricShare> half_of(const mesh::Model& model, const mesh::LooseFaces& all,
                                      double largest_deviation) {
  const double extent = model.surface.bounds().largest_extent();
  SymmetryTolerance tolerance;
  tolerance.near = largest_deviation;
  std::optional<SymmetricShare> result;
  for_mirrors(model.surface, most_planes, tolerance, [&](const Mirror& mirror) {
    // Corners that should lie on the plane may be off it as far as others are off their partners; but a body
    // that is thinner than that has sides all the same.
    for (const double on : {on_plane * extent + 2.0 * mirror.deviation, on_plane * extent}) {
      auto half = halved(model.surface, all, mirror, on);
      if (half && mesh::is_surface(half->faces) && mesh::is_surface(whole(*half, all))) {
        result = std::move(half);
        return true;
      }
    }
    return false;
  });
  return result;
}

}  // namespace

SymmetricShare symmetric_share(const mesh::Model& model, double largest_deviation, const Context& context) {
  const mesh::LooseFaces all = mesh::take_apart(model);
  std::optional<SymmetricShare> half = half_of(model, all, largest_deviation);
  context.check();
  SymmetricShare share = half ? std::move(*half) : all_of(all);
  share_twins(share, model.surface, context);
  return share;
}

}  // namespace ridgecraft::prepare
