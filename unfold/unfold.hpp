// SPDX-License-Identifier: GPL-3.0-or-later
// A surface in parts becomes pieces of paper: nets without overlap, with glue tabs. Read this header first;
// docs/unfolding.md has the method.
#pragma once

#include <optional>
#include <span>

#include "mesh/context.hpp"
#include "mesh/panels.hpp"
#include "mesh/surface.hpp"
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
  double smallest_top_mm = 2.0;
  double angle = 0.78539816339744831;          ///< side angle at the base, radians (45 degrees)
  double steepest_angle = 1.3089969389957472;  ///< where the edge is short (75 degrees)
  double clearance_mm = 0.2;                   ///< distance kept from everything but the tab's own edge
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
  std::size_t max_panels = 0;  ///< flat regions that one piece may have; 0: any number
};

/// Unfolds each part into one net where one exists, splits those that don't fit the sheet in as few pieces as
/// possible, and gives every cut edge that has room a tab. `part` gives each face its part (parts are
/// connected over edges or are treated as several); panels larger than the sheet are cut, others as
/// `panel_cuts` says. The result has no overlap deeper than overlap_tolerance_mm (unfold/tolerance.hpp): an
/// all-pairs check of its own confirms it before it is returned. Deterministic for one seed as long as the
/// deadline isn't reached. Throws Error(no_nets), Error(interrupted).
[[nodiscard]] Nets unfold(const mesh::Surface& surface, const mesh::Panels& panels,
                          const IdVector<FaceId, PartId>& part, const Options& options,
                          const Context& context);

}  // namespace ridgecraft::unfold
