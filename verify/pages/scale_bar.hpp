// SPDX-License-Identifier: GPL-3.0-or-later
// The bar by which people see whether a page was printed in true size.
#pragma once

#include <optional>
#include <string>

#include "verify/pages/printed.hpp"

namespace ridgecraft::verify {

/// What is wrong with the page's bar, or nothing. A bar is a level line with a tick across each of its ends;
/// it has to be 50 mm long, with ticks at each 10 mm, or 20 or 10 mm where the printable area is too narrow
/// for the longer ones. `room_mm` is that area's width. O(n²) in the few level lines and ticks among the
/// page's marks.
[[nodiscard]] std::optional<std::string> fault_of_bar(const PrintedPage& page, double room_mm);

}  // namespace ridgecraft::verify
