// SPDX-License-Identifier: GPL-3.0-or-later
// What a person does to nets by hand, as values and as text.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/id.hpp"

namespace ridgecraft::session {

/// An edge of the prepared surface by its two ends, in any order: names that survive every edit. They are
/// those of the vertices in the second frame of the FOLD file.
struct Edge {
  VertexId from, to;

  friend bool operator==(const Edge&, const Edge&) = default;
};

/// The fold at this edge becomes a cut: its piece becomes two.
struct Cut {
  Edge edge;

  friend bool operator==(const Cut&, const Cut&) = default;
};

/// The cut at this edge becomes a fold: the two pieces beside it become one.
struct Join {
  Edge edge;

  friend bool operator==(const Join&, const Join&) = default;
};

/// The tab of this cut grows from the face whose side runs from `from` to `to`, counterclockwise.
struct TabFrom {
  Edge edge;

  friend bool operator==(const TabFrom&, const TabFrom&) = default;
};

/// This cut has no tab.
struct NoTab {
  Edge edge;

  friend bool operator==(const NoTab&, const NoTab&) = default;
};

using Edit = std::variant<Cut, Join, TabFrom, NoTab>;

/// "cut 3 17; join 5 9; tab-from 4 8; no-tab 2 6": edits of one step, in one line.
[[nodiscard]] std::string text_of(std::span<const Edit> edits);

/// The steps of such lines. Throws Error(unreadable_input) that names the first line that isn't in form.
[[nodiscard]] std::vector<std::vector<Edit>> steps_of(std::string_view text);

}  // namespace ridgecraft::session
