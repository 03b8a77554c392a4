// SPDX-License-Identifier: GPL-3.0-or-later
// The lists of a page: for each of its pieces, which other pieces it is glued to, on which pages, by which
// numbers; and which edges the numbers belong to that have no room on their pieces. What a page has no room
// for stands on pages at the end.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "export/page/list_rows.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/pages.hpp"
#include "export/sheet/paper.hpp"
#include "export/sheet/pieces.hpp"

namespace ridgecraft::export_ {

/// What stands above rows that say where the other edges are.
inline constexpr std::string_view partner_list_heading = "where the other edges are: piece and numbers";

/// Rows of a page's lists.
struct PageLists {
  std::vector<std::string> kinds;     ///< which pieces are alike
  std::vector<std::string> partners;  ///< where the other edges are
  std::vector<std::string> numbers;   ///< without room on their pieces (NumberAt::list)

  [[nodiscard]] bool empty() const { return kinds.empty() && partners.empty() && numbers.empty(); }
  /// Adds the lists of a page, each row with its page (from 1) before it where there are several pages;
  /// which pieces are alike stands there once for all pages.
  void add(const PageLists& others, std::size_t page, bool several);
};

/// What lists of a page are made of.
struct ListedPage {
  const unfold::Nets& nets;
  const Pages& pages;
  PageId page;
  const IdVector<PieceId, std::vector<Neighbour>>& neighbours;  ///< as find_neighbours()
  const std::vector<PieceKind>& kinds;                          ///< of all pages
  const std::vector<PieceDrawing>& pieces;                      ///< all of the page, with their texts
};

struct PageIndex {
  std::vector<Text> texts;
  PageLists left;  ///< for which the page has no room
};

/// The page's lists, where it has room for them: beside the pieces, as low as possible. The numbers come
/// first; then the index, in fewer words where there is little room. `others` is what other pages have no
/// room for, to stand there, too. O(places tried x lines).
[[nodiscard]] PageIndex page_index(const ListedPage& page, const PageLists& others);

/// What pages have no room for, on pages of their own. The lists follow each other, each under its heading,
/// which stands again where it goes on in another column or page. What stands before the first colon of a row
/// is the entry's own line; semicolons separate the lines below. In columns; letters are as large as costs no
/// page. Only where has_room_for_lists(). O(rows).
[[nodiscard]] std::vector<std::vector<Text>> list_pages(const PageLists& left, const Paper& paper);

}  // namespace ridgecraft::export_
