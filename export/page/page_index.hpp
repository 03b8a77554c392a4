// SPDX-License-Identifier: GPL-3.0-or-later
// The index of a page: for each of its pieces, which other pieces it is glued to, on which pages, by which
// numbers; and which numbers have no room at their edges.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/page/neighbours.hpp"
#include "export/page/number_list.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

struct PageIndex {
  std::vector<Text> texts;
  /// What the page has no room for: rows that tell where the other edges are, and numbers that have no room
  /// at their edges (Seam::numbered).
  std::vector<std::string> partners, numbers;
};

/// The texts of the index, where the page has room for them: beside the pieces, as low as possible. In fewer
/// words where there is little room, then without what isn't needed most: numbers that have no room at their
/// edges come first. `pieces` are all of the page, with their texts. O(places tried x lines).
[[nodiscard]] PageIndex page_index(const unfold::Nets& nets, const Pages& pages, PageId page,
                                   const IdVector<PieceId, std::vector<Neighbour>>& neighbours,
                                   const std::vector<PieceKind>& kinds,
                                   const std::vector<PieceDrawing>& pieces);

/// What stands above rows that tell where the other edges are.
inline constexpr std::string_view partner_list_heading = "where the other edges are: piece and numbers";

/// The list at the lowest place of a page that has room for it beside its pieces, with their texts, and
/// `others`, which stand there, too. None where there is no room. O(places tried x lines).
[[nodiscard]] std::optional<std::vector<Text>> list_beside(const Paper& paper,
                                                           const std::vector<PieceDrawing>& pieces,
                                                           const std::vector<Text>& others,
                                                           const RowList& list);

}  // namespace ridgecraft::paper
