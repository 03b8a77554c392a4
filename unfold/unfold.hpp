// SPDX-License-Identifier: GPL-3.0-or-later
// A surface in parts becomes pieces of paper: nets without overlap, with glue tabs. Read this header first;
// docs/unfolding.md has the method.
#pragma once

#include <optional>
#include <span>

#include "mesh/context.hpp"
#include "mesh/panels.hpp"
#include "mesh/surface.hpp"
#include "unfold/edge_wishes.hpp"
#include "unfold/nets.hpp"

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
  double smallest_top_mm = 2.0;   ///< but half of the edge where that is shorter than twice this, and ...
  double narrowest_top_mm = 1.0;  ///< ... never less than this
  double angle = 0.78539816339744831;          ///< side angle at the base, radians (45 degrees)
  double steepest_angle = 1.3089969389957472;  ///< where the edge is short (75 degrees)
  double clearance_mm = 0.2;                   ///< distance kept from everything but the tab's own edge
  /// Must a tab lie inside the flat region that it is glued behind? Without that it may show beyond it.
  bool inside_target = true;
  /// How long trees with room for more tabs are searched for, in trials per face; 0: not at all.
  double trials_per_face = 20.0;
};

/// What may be cut where a part has no single net with all its flat regions (panels) whole.
enum class PanelCuts {
  only_if_too_large,  ///< a piece is added before a panel is cut: what makers want
  before_pieces,      ///< a panel is cut before a piece is added: the fewest pieces
};

/// What makes pieces easy to build, in the worth of one edge to be glued; each term is a name that users can
/// weigh (unfold/objective.hpp).
struct Weights {
  double cut = 1.0;      ///< each 100 mm of cut edges
  double pieces = 6.0;   ///< each piece
  double parts = 8.0;    ///< each part beyond the first that a piece has faces of
  double compact = 4.0;  ///< each 100 cm2 of a piece's convex hull that are no paper
  double thin = 0.5;     ///< necks: width of what hangs on one over its length, beyond three times
  double small = 12.0;   ///< pieces less than 30 mm wide: by the share that is missing
  double panels = 8.0;   ///< square of a piece's flat regions over 80
};

/// How a user wants the pieces.
enum class PieceMode {
  few,    ///< as few as overlap and paper allow
  parts,  ///< the parts of the model; crumbs join their neighbours
  small,  ///< small ones for short evenings
};

/// What a mode means.
struct PieceRules {
  Weights weights;
  std::size_t max_panels = 0;  ///< flat regions that one piece may have; 0: any number
  bool merge = false;          ///< join neighbouring pieces, of several parts too, where that costs less
};
[[nodiscard]] PieceRules rules_of(PieceMode mode);

struct Options {
  std::optional<Sheet> sheet;  ///< none: a piece may be as large as it likes
  TabOptions tabs;
  PanelCuts panel_cuts = PanelCuts::only_if_too_large;
  PieceRules pieces;
  /// Per edge of the surface, or empty. Cuts are always made but inside flat regions; what is to be kept is a fold
  /// unless that would close a loop, overlap or fit no sheet (kept_edges.hpp); a note counts what couldn't be.
  EdgeWishes wishes;
};

/// Unfolds each part into one net where one exists, splits those that don't fit the sheet in as few pieces as
/// possible, and gives every cut edge that has room a tab. `part` gives each face its part (parts are
/// connected over edges or are treated as several); neighbouring pieces are merged as `pieces` says; panels
/// larger than the sheet are cut, others as `panel_cuts` says. The result has no overlap deeper than
/// overlap_tolerance_mm (unfold/tolerance.hpp): an all-pairs check of its own confirms it before it is
/// returned. Deterministic for one seed as long as the deadline isn't reached. Throws Error(no_nets),
/// Error(interrupted).
[[nodiscard]] Nets unfold(const mesh::Surface& surface, const mesh::Panels& panels,
                          const IdVector<FaceId, PartId>& part, const Options& options,
                          const Context& context);

}  // namespace ridgecraft::unfold
