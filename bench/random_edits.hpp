// SPDX-License-Identifier: GPL-3.0-or-later
// Edits of a project that are drawn at random, as somebody might make them who tries everything.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/random.hpp"
#include "session/session.hpp"

namespace ridgecraft::bench {

enum class EditKind { cut, join, tab_from, no_tab, place, pin, unpin, retry, pack };
inline constexpr std::array<std::string_view, 9> edit_kinds{"cut", "join",  "tab-from", "no-tab", "place",
                                                            "pin", "unpin", "retry",    "pack"};

/// One of this kind, which may well be refused; none where the project has nothing for it. A place is mostly
/// some millimetres away from where the piece lies. No more than a third of the pieces gets pinned.
std::optional<session::Edit> random_edit(const session::Project& project, EditKind kind, Random& random);

}  // namespace ridgecraft::bench
