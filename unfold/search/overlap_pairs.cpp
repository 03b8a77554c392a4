// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/overlap_pairs.hpp"

namespace ridgecraft::unfold {

std::uint32_t SwapOverlaps::count(std::uint32_t below, std::uint32_t side, std::uint32_t limit) {
  const LaidFaces faces{net_.order(), &net_.circles()};
  const RootedNet::Span moved = net_.moved_span(below);
  return carried_.count({faces, moved.first, moved.count, faces, net_.motion(below, side)}, limit);
}

OverlapPairs::OverlapPairs(RootedNet& net, double tolerance)
    : net_(net), tolerance_(tolerance), after_swap_(net, tolerance), pairs_(net.size()) {}

void OverlapPairs::find_all() {
  pairs_.clear();
  for (std::uint32_t position = 0; position < net_.size(); ++position) {
    const std::uint32_t f = net_.face_at(position);
    net_.visit_near(net_.circle(f).centre, net_.circle(f).radius, [&](std::uint32_t g) {
      if (net_.position(g) > position && overlap(net_.edged_flat(f), net_.edged_flat(g), tolerance_)) {
        pairs_.add(f, g);
      }
    });
  }
}

std::uint32_t OverlapPairs::across(std::uint32_t below) const {
  std::uint32_t count = 0;
  pairs_.visit_across(net_, net_.moved_span(below), [&](std::uint32_t, std::uint32_t) { ++count; });
  return count;
}

std::int64_t OverlapPairs::added(std::uint32_t below, std::uint32_t side, std::int64_t limit) {
  const std::int64_t old = total() > 0 ? across(below) : 0;
  if (limit + old <= 0) {
    return limit;
  }
  return static_cast<std::int64_t>(after_swap_.count(below, side, static_cast<std::uint32_t>(limit + old))) -
         old;
}

std::uint32_t OverlapPairs::swap(std::uint32_t below, std::uint32_t side) {
  after_swap_.count(below, side, nothing);
  return swap(below, side, after_swap_.found());
}

std::uint32_t OverlapPairs::swap(std::uint32_t below, std::uint32_t side, const FacePairs& made) {
  pairs_.drop_across(net_, net_.moved_span(below));
  const std::uint32_t moved = net_.swap(below, side);
  for (const auto& [f, g] : made) {
    pairs_.add(f, g);
  }
  return moved;
}

}  // namespace ridgecraft::unfold
