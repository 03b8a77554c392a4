// SPDX-License-Identifier: GPL-3.0-or-later
// What is glued to what, and which bodies lie inside others, that can't be put there once the outer one is
// closed.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

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

/// The groups of the graph in an order in which each comes after those that lie inside it, and else
/// the larger first, by its area. A group with a border encloses nothing; inside another lies what doesn't
/// stand out of it anywhere and is a millimetre off its faces somewhere (surface in mm). O(groups log groups
/// + pairs of boxes that meet + faces of groups whose boxes hold others).
[[nodiscard]] std::vector<std::size_t> inner_groups_first(const mesh::Surface& surface,
                                                          const unfold::Nets& nets, const SeamGraph& graph);

}  // namespace ridgecraft::export_
