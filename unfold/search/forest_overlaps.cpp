// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/forest_overlaps.hpp"

namespace ridgecraft::unfold {

ForestOverlaps::ForestOverlaps(const Forest& forest, double tolerance)
    : forest_(forest),
      tolerance_(tolerance),
      pairs_(forest.face_count()),
      carried_(forest.edged_flats(), tolerance) {}

void ForestOverlaps::find_all() {
  pairs_.clear();
  counted_ = {};
  for (std::uint32_t f = 0; f < forest_.face_count(); ++f) {
    forest_.visit_near(forest_.tree_of(f), forest_.circle(f).centre, forest_.circle(f).radius,
                       [&](std::uint32_t g) {
                         if (g > f && overlap(forest_.edged_flat(f), forest_.edged_flat(g), tolerance_)) {
                           pairs_.add(f, g);
                         }
                       });
  }
}

std::uint32_t ForestOverlaps::count_new(const Move& move, std::uint32_t limit) {
  counted_ = {};
  if (move.splits()) {
    carried_.found().clear();
    return 0;
  }
  const Forest::Carried what = forest_.carried(move);
  const std::uint32_t from = what.faces.tree;
  const std::uint32_t count = carried_.count({{forest_.faces_of(from), &forest_.circles_of(from)},
                                              what.faces.first,
                                              what.faces.count,
                                              {forest_.faces_of(what.to), &forest_.circles_of(what.to)},
                                              what.motion},
                                             limit);
  if (count < limit) {
    counted_ = move;
  }
  return count;
}

std::int64_t ForestOverlaps::added(const Move& move, std::int64_t limit) {
  std::int64_t old = 0;
  if (total() > 0 && !move.joins()) {
    pairs_.visit_across(forest_, forest_.carried(move).faces, [&](std::uint32_t, std::uint32_t) { ++old; });
  }
  if (limit + old <= 0) {
    return limit;
  }
  return static_cast<std::int64_t>(count_new(move, static_cast<std::uint32_t>(limit + old))) - old;
}

void ForestOverlaps::make(const Move& move) {
  if (move.splits() || !(move == counted_)) {
    count_new(move, no_index);
  }
  counted_ = {};
  if (!move.joins()) {
    pairs_.drop_across(forest_, forest_.carried(move).faces);
  }
  for (const auto& [f, g] : carried_.found()) {
    pairs_.add(f, g);
  }
}

}  // namespace ridgecraft::unfold
