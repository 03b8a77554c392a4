// SPDX-License-Identifier: GPL-3.0-or-later
// How parts become nets: values that users choose.
#pragma once

#include <cstdint>
#include <optional>

#include "base/geometry.hpp"
#include "base/id.hpp"
#include "prepare/prepared/twin_bodies.hpp"
#include "unfold/net/edge_wishes.hpp"
#include "unfold/net/piece_rules.hpp"

namespace ridgecraft::unfold {

/// What every piece must fit with its tabs after some rotation, mm.
using Sheet = Rectangle;

/// Measures of glue tabs.
struct TabOptions {
  bool wanted = true;
  double height_mm = 5.0;
  double smallest_height_mm = 1.5;  ///< lower ones are left out
  double smallest_top_mm = 2.0;     ///< but half of the edge where that is shorter than twice this, and ...
  double narrowest_top_mm = 1.0;    ///< ... never less than this
  double angle = 0.78539816339744831;          ///< side angle at the base, radians (45 degrees)
  double steepest_angle = 1.3089969389957472;  ///< where the edge is short (75 degrees)
  double clearance_mm = 0.2;                   ///< distance kept from everything but the tab's own edge
  /// Must a tab lie inside the flat region that it is glued behind? Without that it may show beyond it.
  bool inside_target = true;
  /// Do bodies that stand on others get tabs at their feet (foot_tabs.hpp)?
  bool at_feet = true;
  /// May pieces be split until every edge that is wide enough has a usable tab (pieces/tab_split.hpp)?
  bool split_pieces = false;
};

/// What may be cut where a part has no single net with all its flat regions (panels) whole.
enum class PanelCuts {
  only_if_too_large,  ///< a piece is added before a panel is cut: what makers want
  before_pieces,      ///< a panel is cut before a piece is added: the fewest pieces
};

/// What nets are wanted.
struct Options {
  std::optional<Sheet> sheet;  ///< none: a piece may be as large as it likes
  TabOptions tabs;
  PanelCuts panel_cuts = PanelCuts::only_if_too_large;
  PieceRules pieces;
  /// Per edge of the surface, or empty. Cuts are always made but inside flat regions; what is to be kept is a
  /// fold unless that would close a loop, overlap or fit no sheet (kept_edges.hpp); a note counts what
  /// couldn't be.
  EdgeWishes wishes;
  /// Per face, or empty: what its author set it apart by, such as its object and its material. A fold where
  /// two of them meet costs something (Weights::borders), so nets rather end there.
  IdVector<FaceId, std::uint32_t> labels = {};
  /// Bodies of the surface that get one net each, and copies of it (prepare::Prepared::twins).
  prepare::TwinBodies twins = {};
};

}  // namespace ridgecraft::unfold
