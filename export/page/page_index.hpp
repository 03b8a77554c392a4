// SPDX-License-Identifier: GPL-3.0-or-later
// The index of a page: for each of its pieces, which other pieces it is glued to, on which pages, by which
// numbers; and where the numbers are that have no room at their edges.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "export/page/enlarged.hpp"
#include "export/page/neighbours.hpp"
#include "export/page/number_list.hpp"
#include "export/page/page_marks.hpp"
#include "export/page/piece_drawing.hpp"
#include "export/sheet/pages.hpp"

namespace ridgecraft::paper {

/// What a page has no room for: which pieces are alike, rows that tell where the other edges are, numbers
/// that stand nowhere else (NumberAt::list), and pictures.
struct Unplaced {
  std::vector<std::string> kinds, partners, numbers;
  std::vector<Enlarged> pictures;

  [[nodiscard]] bool empty() const {
    return kinds.empty() && partners.empty() && numbers.empty() && pictures.empty();
  }
  /// What a page has left, each with its page (from 1) before it where there are several; which pieces are
  /// alike once, for all pages.
  void add(Unplaced others, std::size_t page, bool several);
};

struct PageIndex {
  PageMarks marks;
  std::vector<PicturePlace> shown;  ///< by the pictures among them
  Unplaced left;
};

/// The index, where the page has room for it: beside the pieces, as low as possible. Pictures of parts of its
/// pieces come first; then what there is in words, in fewer of them where there is little room, then without
/// what isn't needed most. `pieces` are all of the page, with their texts; `others` is what other pages have
/// left, to stand there, too. O(places tried x lines).
[[nodiscard]] PageIndex page_index(const unfold::Nets& nets, const Pages& pages, PageId page,
                                   const IdVector<PieceId, std::vector<Neighbour>>& neighbours,
                                   const std::vector<PieceKind>& kinds,
                                   const std::vector<PieceDrawing>& pieces, std::vector<Enlarged> pictures,
                                   const Unplaced& others);

/// What stands above rows that tell where the other edges are.
inline constexpr std::string_view partner_list_heading = "where the other edges are: piece and numbers";

}  // namespace ridgecraft::paper
