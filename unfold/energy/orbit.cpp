// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/orbit.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "base/no_index.hpp"

namespace ridgecraft::unfold {
namespace {

/// Larger orbits would be made of too many moves for all to come true.
constexpr std::size_t most_images = 64;

/// Nothing where an edge has no image.
std::optional<Move> image_of(const Move& move, const SideImages& images) {
  const auto at = [&](std::uint32_t side) { return side == no_index ? no_index : images.side[side]; };
  const Move image{at(move.opened), at(move.closed)};
  const bool whole = (image.opened == no_index) == (move.opened == no_index) &&
                     (image.closed == no_index) == (move.closed == no_index);
  return whole ? std::optional(image) : std::nullopt;
}

bool share_an_edge(const Patch& patch, const Move& a, const Move& b) {
  const auto same = [&](std::uint32_t side, std::uint32_t other) {
    return side != no_index && (side == other || patch.twin[side] == other);
  };
  return same(a.opened, b.opened) || same(a.closed, b.closed);
}

}  // namespace

void find_orbit(const Move& move, const Patch& patch, const CutCosts& costs, std::vector<Move>& orbit) {
  orbit.assign(1, move);
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    for (const SideImages& images : costs.images()) {
      const std::optional<Move> image = image_of(orbit[i], images);
      if (image && std::none_of(orbit.begin(), orbit.end(),
                                [&](const Move& other) { return share_an_edge(patch, *image, other); })) {
        orbit.push_back(*image);
      }
    }
    if (orbit.size() > most_images) {
      orbit.assign(1, move);
      return;
    }
  }
  for (Move& image : orbit) {
    const bool opens = image.opened != no_index && !costs.is_cut(image.opened);
    const bool closes = image.closed != no_index && costs.is_cut(image.closed);
    image = {opens ? image.opened : no_index, closes ? image.closed : no_index};
  }
  std::erase(orbit, Move{});
}

}  // namespace ridgecraft::unfold
