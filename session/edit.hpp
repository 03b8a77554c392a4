// SPDX-License-Identifier: GPL-3.0-or-later
// What a person does to nets and pages by hand, as values and as text; and where a project stands after it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/id.hpp"
#include "base/message.hpp"
#include "base/vector.hpp"
#include "export/sheet/pages.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::session {

// Where a project stands after some edits: what it takes to draw it, and to go on.

/// Nets, places and what was asked of them by hand. Copies share nets and pages.
struct State {
  std::shared_ptr<const unfold::Nets> nets;     ///< never null; finished, with joins and tabs
  std::shared_ptr<const export_::Pages> pages;  ///< null where the program lays out by itself: without paper,
                                                ///< and board
  std::vector<unfold::TabAt> tabs;              ///< that were asked for by hand, in order
  std::set<FaceId> pinned;                      ///< a face of each piece that is pinned

  /// A face of the piece that is pinned; none where it isn't.
  [[nodiscard]] bool is_pinned(PieceId piece) const {
    for (const FaceId face : pinned) {
      if (nets->piece[face] == piece) {
        return true;
      }
    }
    return false;
  }
};

/// Why something isn't done.
struct Refusal {
  std::size_t edit = 0;  ///< which of those that were to be done together, from 0
  Message why;
  std::vector<FaceId> faces;  ///< of the prepared surface, where to look; none where the edge isn't there
};

// What a person does to nets and pages by hand, as values and as text.

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

/// The cut at this edge becomes a fold: the two pieces at it become one.
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

/// The tab of this cut grows from that side, so high and with sides so steep, where there is room.
struct TabShape {
  Edge edge;
  double height_mm = 5.0;
  double degrees = 45.0;

  friend bool operator==(const TabShape&, const TabShape&) = default;
};

/// This cut has a tab on both sides, where there is room.
struct BothTabs {
  Edge edge;

  friend bool operator==(const BothTabs&, const BothTabs&) = default;
};

/// A piece, by any of its faces, is laid somewhere: the first corner of this face comes to lie at a point of
/// the page, and the side from there to the second corner runs in a direction. So a place means the same
/// whatever was done before. Faces and their corners are those of the second frame of the FOLD file.
struct Place {
  FaceId face;
  std::uint32_t page = 0;  ///< from 0; the number of pages means a new one behind them
  Vec2 at;                 ///< mm from the lower left corner of the page
  double degrees = 0.0;    ///< counterclockwise from the page's lower side

  friend bool operator==(const Place&, const Place&) = default;
};

/// The piece with this face keeps its net and its place until it is unpinned.
struct Pin {
  FaceId face;

  friend bool operator==(const Pin&, const Pin&) = default;
};
/// The piece with this face may be laid elsewhere and get another net again.
struct Unpin {
  FaceId face;

  friend bool operator==(const Unpin&, const Unpin&) = default;
};

/// The piece with this face gets another net.
struct Retry {
  FaceId face;
  std::uint64_t seed = 1;

  friend bool operator==(const Retry&, const Retry&) = default;
};

/// The pieces with these faces, or all where none are named, are placed again, but for those that are pinned.
struct Pack {
  std::vector<FaceId> faces;

  friend bool operator==(const Pack&, const Pack&) = default;
};

/// Pieces are named and joins numbered as if nothing had been done by hand. Other edits change neither but of
/// what they change.
struct Number {
  friend bool operator==(const Number&, const Number&) = default;
};

using Edit =
    std::variant<Cut, Join, TabFrom, NoTab, TabShape, BothTabs, Place, Pin, Unpin, Retry, Pack, Number>;

/// "cut 3 17; join 5 9; tab-from 4 8; no-tab 2 6; tab-shape 4 8 7 60; both-tabs 2 6; place 12 1 55.5 80 90;
/// pin 12; unpin 12; retry 4 7; pack; number": edits of one step, in one line. Pages count from 1 there.
[[nodiscard]] std::string text_of(std::span<const Edit> edits);

/// The steps of such lines. Throws Error(unreadable_input) that names the first line that isn't in form.
[[nodiscard]] std::vector<std::vector<Edit>> steps_of(std::string_view text);

}  // namespace ridgecraft::session
