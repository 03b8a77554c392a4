// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs that hold without glue: arrows that are put through slits of the face beyond their edge.
//
//        ___________            tip
//       /           \.
//      /_           _\.         barbs: wider than the slit, they hold behind it
//        |         |   - - - -  the slit lies here once the arrow is folded over the edge
//        |         |            neck: lies on the printed side of the face beyond
//   -----+---------+-----       edge
//
// All in the frame of the side (shapes.hpp): the base runs along y = 0, the tab grows towards positive y.
// Laid flat over the edge, the face beyond covers the same ground, so the slit is told in the same frame.
#pragma once

#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"

namespace ridgecraft::unfold {

/// Measures of arrows and slits, mm. Paper and card are meant, up to 0.3 mm: these give way where they are
/// cut once, so a slit is a single cut, and barbs bend on their way through it.
struct ArrowMeasures {
  double slit_from_edge = 3.0;  ///< what remains between them is a strip that tears no more easily than a tab
  double slit_from_others = 3.0;           ///< distance kept from cuts and folds of the face beyond
  double slit_play = 0.4;                  ///< by which a slit is longer than its neck is wide
  double neck_play = 0.3;                  ///< by which the neck is longer than the way to the slit
  double root_from_end = 0.5;              ///< distance of the neck from the ends of the tab's ground
  double barb = 1.5;                       ///< by which the head is wider than the neck, at either side
  double head = slot_tab_height_mm - 3.3;  ///< height of the head
  double tip_inset = 1.0;                  ///< by which the tip is narrower than the neck, at either side
  double narrowest_neck = 4.0;
  double widest_neck = 20.0;  ///< a longer slit gapes
  double pitch = 40.0;        ///< on longer edges there are several arrows, this far from each other at most
  double between = 1.0;       ///< distance of their barbs

  [[nodiscard]] double height() const { return slit_from_edge + neck_play + head; }
};
inline constexpr ArrowMeasures arrow_measures;

/// One tab and the slit for it.
struct Arrow {
  /// Counterclockwise, the first two corners on the base; corners 2 and 7 are where the neck becomes the
  /// head.
  std::vector<Vec2> polygon;
  Span slit;  ///< x of its ends; its y is slit_from_edge
};

/// Arrows side by side within a convex ground and such that each slit lies in one of the stretches of the
/// slits' line that are free: as many as the pitch asks for, of one width; none where not even the narrowest
/// neck has room. O(stretches).
[[nodiscard]] std::vector<Arrow> arrows_within(const ConvexShape& ground, const std::vector<Span>& free);

// Tabs that are put into slits of the face beyond their edge instead of glued behind it.

/// Makes arrows of the tabs of those joins for which `asked`, by join, isn't 0, where the face
/// beyond has room for their slits: each keeps its distance from all cuts and folds of its piece, and what is
/// laid on or glued behind that face keeps clear of it. A long edge gets several; those beyond the first are
/// additional tabs of its join. All other tabs stay as they are. Returns, by join, where there are arrows.
/// About O(n log n). Throws Error(interrupted).
std::vector<std::uint8_t> put_into_slits(const mesh::Surface& surface, const prepare::Panels& panels,
                                         const std::vector<std::uint8_t>& asked, Nets& nets,
                                         const Context& context);

}  // namespace ridgecraft::unfold
