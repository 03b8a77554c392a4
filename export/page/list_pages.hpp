// SPDX-License-Identifier: GPL-3.0-or-later
// Pages that hold nothing but lists for which sheets of pieces have no room.
#pragma once

#include <vector>

#include "export/page/page_index.hpp"
#include "export/sheet/drawing.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::export_ {

/// What pages have no room for, on pages of their own. The lists follow each other, each under its heading,
/// which stands again where it goes on in another column or page. What stands before the first colon of a row
/// is the entry's own line; semicolons separate the lines below. In columns; letters are as large as costs no
/// page. Only where has_room_for_lists(). O(rows).
[[nodiscard]] std::vector<std::vector<Text>> list_pages(const PageLists& left, const Paper& paper);

}  // namespace ridgecraft::export_
