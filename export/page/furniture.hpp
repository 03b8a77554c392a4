// SPDX-License-Identifier: GPL-3.0-or-later
// What stands at the foot of every page, and what is printed on its back: the model's name, the page's
// number, the scale bar and the legend; numbers where these are wanted on the back.
#pragma once

#include <string_view>
#include <vector>

#include "export/page/piece_drawing.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

/// Kinds of line and area that a legend explains.
struct LineKinds {
  bool cut = false;
  bool mountain = false;
  bool valley = false;
  bool tab = false;
  bool flat_tab = false;  ///< dotted bases of tabs that aren't folded
  bool glue = false;      ///< outlines of what is glued on
  bool leader = false;    ///< lines from numbers and names to their edges
  bool detail = false;    ///< edges of the model that aren't folded
};

/// What is drawn in these groups.
[[nodiscard]] LineKinds line_kinds(const std::vector<Group>& groups);

/// Both.
[[nodiscard]] LineKinds operator|(LineKinds a, const LineKinds& b);

/// The furniture of one page, in the band of furniture_height at the foot of the printable area. The legend
/// has every kind of line that is `used` on the page; its words and samples are those that fit a page with
/// all that is used `anywhere`, so that pages look alike. On narrow paper it takes three rows instead of two,
/// uses shorter words, and leaves out what doesn't fit; nothing reaches out of the band. Where the margin is
/// smaller than a pen's width and a descender need, it keeps away from the sheet's edge nevertheless.
[[nodiscard]] Group furniture(const Paper& paper, const Drawing& page, const LineKinds& used,
                              const LineKinds& anywhere);

/// The words at the foot of a page's back: of which page it is.
[[nodiscard]] Group foot_of_back(const Paper& paper, const Drawing& page);

/// Takes numbers, names and their leaders off the fronts of a page's pieces, but for what stands on tabs, and
/// gives them as they are seen on the back of the sheet when it is turned over: each at the same place of the
/// paper, and to be read from there.
[[nodiscard]] std::vector<Group> take_to_back(std::vector<PieceDrawing>& pieces, Vec2 sheet,
                                              TurnedOver turned_over);

}  // namespace ridgecraft::export_
