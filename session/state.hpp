// SPDX-License-Identifier: GPL-3.0-or-later
// Where a project stands after some edits: what it takes to draw it, and to go on.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/id.hpp"
#include "export/sheet/pages.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/tab_choice.hpp"

namespace ridgecraft::session {

/// Nets, places and what was asked of them by hand. Copies share nets and pages.
struct State {
  std::shared_ptr<const unfold::Nets> nets;   ///< never null; finished, with joins and tabs
  std::shared_ptr<const paper::Pages> pages;  ///< null where the program lays out by itself: without paper,
                                              ///< and board
  std::vector<unfold::TabAt> tabs;            ///< that were asked for by hand, in order
  std::set<FaceId> pinned;                    ///< a face of each piece that is pinned

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
  std::size_t edit = 0;       ///< which of those that were to be done together, from 0
  std::string why;            ///< a sentence for people, without its full stop
  std::vector<FaceId> faces;  ///< of the prepared surface, where to look; none where the edge isn't there
};

}  // namespace ridgecraft::session
