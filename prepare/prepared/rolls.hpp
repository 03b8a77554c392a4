// SPDX-License-Identifier: GPL-3.0-or-later
// Bands of a surface that are rolled round a pen instead of folded line by line.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// Which bands are rolled: those that are less work so, none, or all that can be.
enum class Rolled { automatic, never, always };

/// Tighter than this paper of 0.2 mm cracks or kinks, mm; board bends as much less as it is thicker.
inline constexpr double least_paper_radius_mm = 3.0;
inline constexpr double least_radius_to_thickness = 15.0;

/// A fold of more, radians, is a crease that the eye sees and the hand makes: 35 degrees.
inline constexpr double most_roll_bend = 0.6108652381980153;

/// What is rolled of a model.
struct RollRules {
  Rolled which = Rolled::automatic;
  double least_radius_mm = least_paper_radius_mm;  ///< of what the model is built of
};

/// A band: flat regions in a row, each of which meets the next along a whole straight edge, a ruling. It is a
/// piece of a cylinder, of a cone, or bent as one that changes slowly.
struct Roll {
  std::vector<EdgeId> rulings;       ///< at least three, in order; all bend one way, by less than 35 degrees
  std::vector<PanelId> panels;       ///< ruling i lies between panels i and i + 1, or the first one again
  bool closed = false;               ///< it goes all the way round
  std::array<double, 2> radii_mm{};  ///< of bending along either rim, the smaller one first; 0 at a tip
};

/// All bands of a surface. A flat region is in one band at most.
struct Rolls {
  IdVector<RollId, Roll> rolls;
  IdVector<EdgeId, RollId> of_edge;  ///< of each ruling its band; empty where there is none
  std::size_t too_tight = 0;         ///< rulings that paper bends at and this board doesn't

  /// Whether the paper is bent there and not folded.
  [[nodiscard]] bool bends(EdgeId e) const { return !of_edge.empty() && of_edge[e].valid(); }
};

/// Each flat region hands on what comes over one ruling to that across from it: of its edges the two that are
/// longest beside their distance. Rulings in a row turn slowly, and where they run together they go on doing
/// so; a band with two ends has creases along its rims; the round surface is nowhere farther from the flat
/// regions than simplification may move it. Less work (Rolled::automatic) is a band whose folds take more
/// time than it costs that it stays one strip: where its rulings are short, flaps on a neighbour have shorter
/// seams, and a strip with two ends is in the way of others. A straight fold between two panels must be one
/// edge (remesh_panels). `mm`: unit of the surface. O(n log n).
[[nodiscard]] Rolls find_rolls(const mesh::Surface& surface, const Panels& panels, const RollRules& rules,
                               double mm = 1.0);

}  // namespace ridgecraft::prepare
