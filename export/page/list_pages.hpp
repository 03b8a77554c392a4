// SPDX-License-Identifier: GPL-3.0-or-later
// Pages that hold nothing but lists for which sheets of pieces have no room.
#pragma once

#include <vector>

#include "export/page/page_index.hpp"
#include "export/page/page_marks.hpp"
#include "export/sheet/paper.hpp"

namespace ridgecraft::paper {

/// What pages have no room for, on pages of their own. Pictures come first, side by side in rows. The lists
/// follow, one after the other, each under its heading, which stands again where it goes on in another column
/// or page. What stands before the first colon of a row is the entry's own line, and what semicolons part has
/// a line each. In columns; letters are as large as costs no page. Only where has_room_for_lists().
[[nodiscard]] std::vector<PageMarks> list_pages(Unplaced left, const Paper& paper);

}  // namespace ridgecraft::paper
