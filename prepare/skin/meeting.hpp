// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that are near each other become one skin. Private to prepare/.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "prepare/skin/facets.hpp"

namespace ridgecraft::prepare {

/// Bodies with their caps.
struct CappedBodies {
  BodySoup soup;
  std::vector<FaceId> face;             ///< of each triangle: of the model's surface; none for those of caps
  std::vector<std::uint32_t> cap;       ///< of each triangle: which cap it is of, or no_cap
  std::vector<std::uint8_t> on_ground;  ///< of each cap: the model stands on it
  std::vector<std::uint8_t> bent;       ///< of each cap: a guess that must not be seen
};

/// Points of bodies that change are laid on a grid of about this share of the model's diagonal: what is meant
/// to lie on each other does so then, and no plane is tilted by more than a panel may be.
inline constexpr double snapped = 1e-6;

/// A face of the skin: a piece of a triangle of the soup.
struct SkinFacet {
  std::array<std::uint32_t, 3> corners;
  std::uint32_t triangle;  ///< or none for one of a cap that stays
};

struct UnitedSkin {
  /// Bodies with caps that mustn't be taken for solids: one can look into them, or sees a guess. Where there
  /// are any, nothing else is told.
  std::vector<std::uint32_t> not_solid;
  std::vector<Vec3> points;
  std::vector<SkinFacet> facets;      ///< of bodies that changed; none where no body did
  std::vector<std::uint8_t> changed;  ///< of each body: something of it is hidden, or shown with another's
  std::vector<std::uint8_t> around;   ///< of each body: something of others is hidden in it
  std::size_t faces_hidden = 0;       ///< triangles that nothing is left of, caps not counted
  std::size_t rims_closed = 0;        ///< caps that stay

  [[nodiscard]] bool any_change() const {
    return std::find(changed.begin(), changed.end(), 1) != changed.end();
  }
};

/// What is seen of the bodies from outside, where they touch or run into each other (unite_bodies, skin.hpp).
/// None where no sound skin was found. `diagonal`: of the whole model.
[[nodiscard]] std::optional<UnitedSkin> meet(const CappedBodies& bodies, double diagonal,
                                             const Context& context);

}  // namespace ridgecraft::prepare
