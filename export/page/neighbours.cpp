// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/neighbours.hpp"

#include <algorithm>
#include <tuple>

namespace ridgecraft::export_ {

IdVector<PieceId, std::vector<Neighbour>> find_neighbours(const mesh::Surface& surface,
                                                          const unfold::Nets& nets) {
  std::vector<std::tuple<PieceId, PieceId, std::uint32_t>> joins;
  for (const unfold::Join& join : nets.joins) {
    const auto [c, d] = surface.sides(join.edge);
    const PieceId first = nets.piece[mesh::face_of(c)];
    const PieceId second = nets.piece[mesh::face_of(d)];
    if (first != second) {
      joins.emplace_back(first, second, join.number);
      joins.emplace_back(second, first, join.number);
    }
  }
  std::sort(joins.begin(), joins.end());
  joins.erase(std::unique(joins.begin(), joins.end()), joins.end());
  IdVector<PieceId, std::vector<Neighbour>> result(nets.pieces.size());
  for (const auto& [piece, other, number] : joins) {
    std::vector<Neighbour>& neighbours = result[piece];
    if (neighbours.empty() || neighbours.back().piece != other) {
      neighbours.push_back({other, {}});
    }
    neighbours.back().numbers.push_back(number);
  }
  return result;
}

std::string number_ranges(const std::vector<std::uint32_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) {
      ++end;
    }
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (end - i > 2) {
      text += "-" + std::to_string(numbers[end - 1]);
      i = end;
    } else {
      ++i;
    }
  }
  return text;
}

}  // namespace ridgecraft::export_
