// SPDX-License-Identifier: GPL-3.0-or-later
// The room that a piece has: a sheet of paper, a number of flat regions. What fits, and what can't.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

/// What a piece must keep to: the sheet, with a strip for tabs all round, and a number of panels. A single
/// panel may use the strip.
struct Room {
  std::optional<Sheet> sheet;
  double strip = 0.0;          ///< mm
  std::size_t max_panels = 0;  ///< flat regions in one piece; 0: as many as it likes

  /// `panels`: how many flat regions the piece has.
  [[nodiscard]] bool holds(std::span<const Vec2> hull, std::size_t panels) const;
};

/// How many flat regions a connected patch has: what its frozen sides leave apart.
[[nodiscard]] std::size_t panel_count(const Patch& patch);

/// How many flat regions the piece of these faces has.
[[nodiscard]] std::size_t panels_of(const Patch& patch, const Folds& folds,
                                    const std::vector<std::uint32_t>& faces);

/// Whether each tree of the forest fits.
[[nodiscard]] bool all_fit(const Patch& patch, const Folds& folds, const Room& room);

/// Pieces that no arrangement of a connected patch can do without: by its area, and by its flat regions.
[[nodiscard]] std::size_t least_pieces(const Patch& patch, const Room& room);

/// Whether what its frozen sides hold together makes one net of the patch without overlap (deeper than
/// `tolerance`, mm) that the room holds. `panels`: as how many flat regions it counts there.
[[nodiscard]] bool lies_as_one(const Patch& patch, std::size_t panels, const Room& room, double tolerance);

}  // namespace ridgecraft::unfold
