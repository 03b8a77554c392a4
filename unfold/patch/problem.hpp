// SPDX-License-Identifier: GPL-3.0-or-later
// What every search over the pieces of a surface has to know, and what a piece has to fit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

// The room that a piece has: a sheet of paper, a number of flat regions. What fits, and what can't.

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

/// Whether what its frozen sides hold together makes one net of the patch without overlap (deeper than
/// `tolerance`, mm) that the room holds. `panels`: as how many flat regions it counts there.
[[nodiscard]] bool lies_as_one(const Patch& patch, std::size_t panels, const Room& room, double tolerance);

// What every search over the pieces of a surface has to know.

/// A surface whose faces are to become pieces. It refers to what it was made of, which must outlive it.
struct NetProblem {
  const mesh::Surface& surface;
  const prepare::Panels& panels;  ///< flat regions that a search keeps whole
  const Patch& patch;             ///< all faces of the surface, each with its own number
  std::span<const PartId> part;   ///< of each face
  const Options& options;
  const Room& room;  ///< that every piece has to fit

  [[nodiscard]] const Weights& weights() const { return options.pieces.weights; }
  /// How deep faces of one piece may overlap, mm.
  [[nodiscard]] double tolerance() const { return net_tolerance(patch.extent); }
};

}  // namespace ridgecraft::unfold
