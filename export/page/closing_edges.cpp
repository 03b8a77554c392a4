// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/closing_edges.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ridgecraft::export_ {
namespace {

/// Ends of two edges that are one corner but for rounding, mm.
constexpr double same_corner_mm = 1e-6;

using Rim = std::vector<std::size_t>;

/// The place of an edge's mate in the rim, where both close like a zip, looking one way round.
std::optional<std::size_t> mate_ahead(const PieceDrawing& piece, const Rim& rim, std::size_t at, bool back) {
  const std::size_t size = rim.size();
  const auto place = [&](std::size_t steps) { return (at + (back ? size - steps : steps)) % size; };
  const auto seam = [&](std::size_t steps) -> const Seam& { return piece.seams[rim[place(steps)]]; };
  // Edges follow each other clockwise with their faces on their left: each begins where the next one ends.
  const auto follows = [&](std::size_t steps) {
    const Seam& first = back ? seam(steps) : seam(steps - 1);
    const Seam& second = back ? seam(steps - 1) : seam(steps);
    return length(first.edge.a - second.edge.b) <= same_corner_mm;
  };
  std::vector<std::uint32_t> open;  // numbers whose second edge is still to come
  for (std::size_t steps = 1; steps < size && follows(steps); ++steps) {
    const std::uint32_t number = seam(steps).number;
    if (!open.empty() && open.back() == number) {
      open.pop_back();
    } else if (open.empty() && number == piece.seams[rim[at]].number) {
      return place(steps);
    } else {
      open.push_back(number);
    }
  }
  return std::nullopt;
}

bool has_number(const PieceDrawing& piece, const Rim& rim, std::size_t place) {
  return piece.seams[rim[place % rim.size()]].at == NumberAt::edge;
}

}  // namespace

bool closes_by_itself(const PieceDrawing& piece, const std::vector<std::size_t>& rim, std::size_t at) {
  return mate_ahead(piece, rim, at, false) || mate_ahead(piece, rim, at, true);
}

void leave_out_closing(PieceDrawing& piece) {
  for (const Rim& rim : piece.rims) {
    std::vector<std::size_t> closing;
    for (std::size_t at = 0; at < rim.size(); ++at) {
      if (piece.seams[rim[at]].at != NumberAt::list) {
        continue;
      }
      for (const bool back : {false, true}) {
        const auto mate = mate_ahead(piece, rim, at, back);
        if (!mate) {
          continue;
        }
        if (has_number(piece, rim, *mate)) {
          closing.push_back(rim[at]);
        }
      }
    }
    for (const std::size_t seam : closing) {
      piece.seams[seam].at = NumberAt::closing;
    }
  }
}

}  // namespace ridgecraft::export_
