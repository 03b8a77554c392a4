// SPDX-License-Identifier: GPL-3.0-or-later
// Where the other side of an edge is: which pieces a piece is glued to, by which numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

struct Neighbour {
  PieceId piece;
  std::vector<std::uint32_t> numbers;  ///< of the joins with it, as printed; ascending, each once
};

/// For each piece the other pieces that it is glued to, ascending. O(joins log joins).
[[nodiscard]] IdVector<PieceId, std::vector<Neighbour>> find_neighbours(const mesh::Surface& surface,
                                                                        const unfold::Nets& nets);

/// "1-3, 7, 8": rows of three and more by their ends.
[[nodiscard]] std::string number_ranges(const std::vector<std::uint32_t>& numbers);

}  // namespace ridgecraft::export_
