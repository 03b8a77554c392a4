// SPDX-License-Identifier: GPL-3.0-or-later
// A surface in parts becomes pieces of paper: nets without overlap, with glue tabs. Read this header first;
// docs/unfolding.md has the method.
#pragma once

#include <optional>

#include "mesh/foundation/context.hpp"
#include "mesh/panels.hpp"
#include "mesh/surface.hpp"
#include "unfold/edge_wishes.hpp"
#include "unfold/nets.hpp"
#include "unfold/piece_rules.hpp"

namespace ridgecraft::unfold {

/// A rectangle, mm, that every piece must fit with its tabs after some rotation.
struct Sheet {
  double width = 0.0;
  double height = 0.0;
};

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
  /// How long trees with room for more tabs are searched for, in trials per face; 0: not at all.
  double trials_per_face = 10.0;
  /// May pieces be split until every edge that is wide enough has a usable tab (pieces/tab_split.hpp)?
  bool split_pieces = false;
};

/// What may be cut where a part has no single net with all its flat regions (panels) whole.
enum class PanelCuts {
  only_if_too_large,  ///< a piece is added before a panel is cut: what makers want
  before_pieces,      ///< a panel is cut before a piece is added: the fewest pieces
};

struct Options {
  std::optional<Sheet> sheet;  ///< none: a piece may be as large as it likes
  TabOptions tabs;
  PanelCuts panel_cuts = PanelCuts::only_if_too_large;
  PieceRules pieces;
  /// Per edge of the surface, or empty. Cuts are always made but inside flat regions; what is to be kept is a
  /// fold unless that would close a loop, overlap or fit no sheet (kept_edges.hpp); a note counts what
  /// couldn't be.
  EdgeWishes wishes;
};

/// Unfolds each part into one net where one exists, splits those that don't fit the sheet in as few pieces as
/// possible, and gives every cut edge that has room a tab; where tabs.split_pieces asks for it, splits them
/// further until every edge that is wide enough has a usable one. `part` gives each face its part (parts are
/// connected over edges or are treated as several); neighbouring pieces are merged as `pieces` says; panels
/// larger than the sheet are cut, others as `panel_cuts` says. The result has no overlap deeper than
/// overlap_tolerance_mm (unfold/tolerance.hpp): an all-pairs check of its own confirms it before it is
/// returned. Deterministic for one seed as long as the deadline isn't reached. Throws Error(no_nets),
/// Error(interrupted).
[[nodiscard]] Nets unfold(const mesh::Surface& surface, const mesh::Panels& panels,
                          const IdVector<FaceId, PartId>& part, const Options& options,
                          const Context& context);

}  // namespace ridgecraft::unfold
