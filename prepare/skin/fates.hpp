// SPDX-License-Identifier: GPL-3.0-or-later
// Which facets of an arrangement of bodies are seen from outside. Private to prepare/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "base/no_index.hpp"
#include "base/vector.hpp"
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

enum class Fate : std::uint8_t { hidden, kept, turned };

/// What becomes of each facet while some bodies are solid. Facets and triangles are named by number.
struct Fates {
  struct VisibleCaps {
    std::vector<std::uint8_t> opens;  ///< of each facet: 1 where it is of a cap that goes again
    std::size_t stay = 0;             ///< caps
  };
  const CappedBodies& bodies;
  BodySoup soup;
  Arrangement arranged;
  std::vector<std::uint8_t> solid;  ///< of each body: not looked into
  std::vector<Fate> fate;           ///< of each facet

  [[nodiscard]] std::span<const Source> sources(const Facet& facet) const {
    return std::span(arranged.sources).subspan(facet.first_source, facet.last_source - facet.first_source);
  }
  [[nodiscard]] bool is_cap(std::uint32_t triangle) const { return bodies.cap[triangle] != no_index; }

  [[nodiscard]] bool inside(const std::vector<Winding>& windings,
                            const std::vector<std::uint8_t>& solids) const;
  /// With these bodies solid: has a facet no solid behind it, whichever side one looks from?
  [[nodiscard]] bool is_loose(const Facet& facet, const std::vector<std::uint8_t>& solids) const;
  /// Of a facet, with these bodies solid.
  [[nodiscard]] Fate fate_with(const Facet& facet, const std::vector<std::uint8_t>& solids) const;
  void decide();
  /// The triangle that a kept facet shows: one that faces as it does, and no cap if there is another.
  [[nodiscard]] std::uint32_t shown(std::uint32_t f) const;
  /// Is all that faces out here a cap? Then so is the facet, whatever it has behind it.
  [[nodiscard]] bool shows_cap(std::uint32_t f) const;
  [[nodiscard]] Vec3 normal_of(const Facet& facet) const;
  [[nodiscard]] bool only_caps(const Facet& facet) const;
  /// Does it show, or hide, more than one triangle? A cap that lies on a face of its own body doesn't count.
  [[nodiscard]] bool is_shared(const Facet& facet) const;
  /// Caps that can be seen go again, unless something but their own body and other caps is glued to them.
  [[nodiscard]] VisibleCaps visible_caps() const;
};

}  // namespace ridgecraft::prepare
