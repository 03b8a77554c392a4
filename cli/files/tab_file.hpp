// SPDX-License-Identifier: GPL-3.0-or-later
// A file that says which tab each edge gets (docs/design/tabs.md, "Edge by edge").
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "unfold/net/tab_choice.hpp"

namespace ridgecraft::cli {

/// One edge a line: its number, then in any order "none", "both", "height=7mm", "angle=60" and the name of
/// the piece that the tab has to grow from. Empty lines and what follows a # say nothing. `name` is the
/// file's, for messages. Throws Error(unreadable_input), which tells the line.
[[nodiscard]] std::vector<unfold::EdgeTab> read_tab_file(const std::string& name, std::string_view bytes);

}  // namespace ridgecraft::cli
