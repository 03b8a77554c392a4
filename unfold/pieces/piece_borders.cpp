// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/piece_borders.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace ridgecraft::unfold {

std::vector<PieceBorder> piece_borders(const Patch& patch, std::span<const std::uint32_t> piece) {
  std::vector<double> area;
  for (std::uint32_t f = 0; f < patch.size(); ++f) {
    area.resize(std::max<std::size_t>(area.size(), piece[f] + 1), 0.0);
    area[piece[f]] += area_of(patch.shape[f]);
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> length;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != nothing && piece[side / 3] < piece[patch.twin[side] / 3]) {
      length[{piece[side / 3], piece[patch.twin[side] / 3]}] += patch.length[side];
    }
  }
  std::vector<PieceBorder> borders;
  for (const auto& [ends, mm] : length) {
    const auto [a, b] = ends;
    borders.push_back({a, b, mm, std::min(area[a], area[b])});
  }
  std::stable_sort(borders.begin(), borders.end(), [](const PieceBorder& s, const PieceBorder& t) {
    return s.smaller_area != t.smaller_area ? s.smaller_area < t.smaller_area : s.length > t.length;
  });
  return borders;
}

}  // namespace ridgecraft::unfold
