// SPDX-License-Identifier: GPL-3.0-or-later
// What several tests of preparation start from: a page, a profile to turn, models of surfaces.
#pragma once

#include <vector>

#include "base/no_index.hpp"
#include "mesh/mesh.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/options.hpp"
#include "support/soups.hpp"

namespace ridgecraft::test {

/// A4 with margins, as much as panels get; nothing is kept free for tabs.
inline constexpr prepare::PanelRoom page{{190.0, 270.0}};

/// The profile of a ring, to be turned about the axis: eight corners around (2, 0).
inline const std::vector<Vec2> ring{{2, -0.5},  {2.3, -0.4}, {2.5, 0},    {2.3, 0.4}, {2, 0.5},
                                    {1.7, 0.4}, {1.5, 0},    {1.7, -0.4}, {2, -0.5}};

/// Faces of which each stands for itself, for collapses.
[[nodiscard]] inline prepare::FundamentalDomain free_domain(const mesh::LooseFaces& loose) {
  prepare::FundamentalDomain domain;
  domain.faces = loose;
  domain.points.plane.assign(loose.points.size(), no_index);
  domain.points.copies.assign(loose.points.size(), 1);
  return domain;
}

/// The model that a file of the surface would become.
[[nodiscard]] inline mesh::Model model_of(const mesh::Surface& surface) {
  return repaired(soup_of(surface));
}

/// The same with flat regions that have nothing but their corners.
[[nodiscard]] inline mesh::Model flat_model_of(const mesh::Surface& surface) {
  mesh::Model model = model_of(surface);
  prepare::remesh_panels(model, {});
  return model;
}

}  // namespace ridgecraft::test
