// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/unfold_options.hpp"

#include <utility>

#include "export/sheet/paper.hpp"
#include "job/parts.hpp"

namespace ridgecraft::job {
namespace {

/// A face of this size fits every sheet; for nets without pages.
constexpr double boundless_mm = 1e9;

}  // namespace

Vec2 room_for_pieces(const Options& options) {
  return options.paper ? export_::piece_area(*options.paper) : Vec2{boundless_mm, boundless_mm};
}

unfold::Options unfold_options(const Options& options, const prepare::Prepared& prepared,
                               unfold::EdgeConstraints constraints) {
  unfold::Options unfolding;
  if (options.paper) {
    const Vec2 area = room_for_pieces(options);
    unfolding.sheet = unfold::Sheet{area.x, area.y};
  }
  unfolding.tabs = options.tabs;
  // A wall of board stands on its edge.
  unfolding.tabs.at_open_bases = options.tabs.at_open_bases && !(options.board.thickness_mm > 0.0);
  unfolding.panel_cuts = options.panel_cuts;
  unfolding.pieces = options.pieces;
  unfolding.constraints = std::move(constraints);
  unfolding.labels = author_labels(prepared.model);
  unfolding.twins = prepared.twins;
  return unfolding;
}

}  // namespace ridgecraft::job
