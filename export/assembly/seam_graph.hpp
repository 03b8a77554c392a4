// SPDX-License-Identifier: GPL-3.0-or-later
// What is glued to what: pieces and the lengths of the seams between them.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::paper {

struct SeamGraph {
  struct Seam {
    PieceId other;
    double length_mm = 0.0;
  };
  struct Node {
    std::vector<Seam> seams;  ///< with other pieces, ascending
    double seam_mm = 0.0;     ///< of all these
    std::size_t joins = 0;    ///< of all these
    double own_mm = 0.0;      ///< of joins of the piece with itself
    std::size_t own_joins = 0;
    double border_mm = 0.0;  ///< of its edges that nothing is glued to
    double area_mm2 = 0.0;
    std::uint32_t group = 0;
  };
  IdVector<PieceId, Node> nodes;
  std::vector<std::vector<PieceId>> groups;  ///< pieces that seams connect, ascending; by their first pieces

  /// Length of the seam between two pieces, 0 where there is none, mm.
  [[nodiscard]] double seam_between(PieceId a, PieceId b) const;
  /// Length of the edges of a group that nothing is glued to, mm: there a hand gets in.
  [[nodiscard]] double border_of(std::size_t group) const;
};

/// O(faces + joins log joins).
[[nodiscard]] SeamGraph seam_graph(const mesh::Surface& surface, const unfold::Nets& nets);

}  // namespace ridgecraft::paper
