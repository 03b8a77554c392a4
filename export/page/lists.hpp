// SPDX-License-Identifier: GPL-3.0-or-later
// The lists of pages: for each piece, which other pieces it is glued to, on which pages, by which numbers;
// which pieces are alike; and which numbers stand nowhere on their pieces.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/page/piece_drawing.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"
#include "export/sheet/paper.hpp"
#include "export/sheet/pieces.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// What stands above rows that say where the other edges are.
inline constexpr std::string_view partner_list_heading = "where the other edges are: piece and numbers";

/// A row of a list: "A: 13, 14 unmarked", "page 2, A: B 5-9, 13; page 3: C 60-67".
struct ListRow {
  std::string of;                  ///< whose row it is; empty where it is of several pieces
  std::vector<std::string> words;  ///< separated by semicolons, or each on a line of its own
};

/// The numbers of a piece that stand nowhere else (NumberAt::list), and the names of what is glued on it that
/// have no room there. Without words where all have their places. O(seams log seams).
[[nodiscard]] ListRow unmarked_row(const PieceDrawing& piece);

/// Whether a page of this paper can hold a list.
[[nodiscard]] bool has_room_for_lists(const Paper& paper);

/// What lists are made of.
struct ListedNets {
  const mesh::Surface& surface;
  const unfold::Nets& nets;
  const Pages& pages;
  const std::vector<PieceKind>& kinds;
  const std::vector<std::vector<PieceDrawing>>& pieces;  ///< of each page, with their texts
};

/// The texts of each page's lists, between its pieces, as low as there is room. Where there is little, they
/// leave out the numbers by which pieces are glued to each other. What has no room on its page stands on the
/// last one, or on pages at the end: those beyond `pages.count`, where has_room_for_lists(). O(places tried x
/// lines).
[[nodiscard]] std::vector<std::vector<Text>> place_lists(const ListedNets& listed);

}  // namespace ridgecraft::export_
