// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs as a user wants them on finished nets: on which sides, how high, edge by edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/id.hpp"

namespace ridgecraft::unfold {

/// Heights that may be asked for, mm: the lowest is as low as tabs get, and nobody folds a higher one.
inline constexpr double lowest_asked_mm = 1.5;
inline constexpr double highest_asked_mm = 50.0;

/// How high tabs are that are put into slits, mm.
inline constexpr double slot_tab_height_mm = 6.3;

/// Which side of a cut gives the tab.
enum class TabSides {
  best,       ///< that where it finds room, the smaller face rather than the larger one
  one_side,   ///< along a seam of two pieces always the same piece, where there is room
  alternate,  ///< along a seam one side after the other, where there is room
  both,       ///< both, to be glued to each other
  slots,      ///< one, put into slits of the face beyond instead of glued, where that has room for them
};

/// A value for edges from a length on.
struct FromLength {
  double length_mm = 0.0;
  double value = 0.0;  ///< mm for heights, radians for angles
};

/// What is asked for the edges with one number.
struct EdgeTab {
  std::uint32_t number = 0;
  std::string where;   ///< who asked, for messages: "tabs.txt, line 3"
  bool wanted = true;  ///< no tab otherwise
  bool both = false;
  std::string piece;  ///< the name of the piece that it has to grow from; empty: either
  std::optional<double> height_mm;
  std::optional<double> angle;  ///< radians
};

/// What is asked for the edge between two faces, whatever number it has.
struct TabAt {
  EdgeId edge;
  bool wanted = true;  ///< no tab otherwise
  /// Of mesh::Surface::sides(edge): 0 or 1, from which it grows where there is room; none: either.
  std::optional<std::uint8_t> side;
  bool no_other_side = false;  ///< rather no tab than one on the other side
  bool both = false;
  std::optional<double> height_mm;
  std::optional<double> angle;  ///< radians
};

/// Which tabs are asked for, in all and edge by edge.
struct TabChoice {
  TabSides sides = TabSides::best;
  bool borders = false;                ///< tabs at edges that are glued to nothing
  std::vector<FromLength> heights_mm;  ///< instead of TabOptions::height_mm; ascending, the first from 0 on
  std::vector<FromLength> angles;      ///< instead of TabOptions::angle, radians; the same
  std::vector<EdgeTab> edges;          ///< what is asked for some edges; the last one counts
  /// The same, and counts more; where there are several for an edge, each changes what those before it say.
  /// Nothing is asked for edges that aren't cut.
  std::vector<TabAt> at;

  /// Whether anything is asked beyond TabOptions.
  [[nodiscard]] bool any() const {
    return sides != TabSides::best || borders || !heights_mm.empty() || !angles.empty() || !edges.empty() ||
           !at.empty();
  }
};

}  // namespace ridgecraft::unfold
