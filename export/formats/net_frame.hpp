// SPDX-License-Identifier: GPL-3.0-or-later
// All nets in one plane as vertices, edges and faces by number: what the first frame of nets.fold says.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "export/sheet/pages.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Net face i is face i of the surface, corner by corner.
struct NetFrame {
  struct Edge {
    std::array<std::uint32_t, 2> vertices;
    CornerId side;      ///< of the face it was met at first
    bool fold = false;  ///< two faces of one piece share it
  };

  std::vector<Vec2> points;                         ///< of each net vertex, mm, y up
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< net vertices at the corners
  std::vector<Edge> edges;
  IdVector<CornerId, std::uint32_t> edge;  ///< of each side
  std::vector<Vec2> origins;               ///< lower left corners of the pages
  IdVector<PieceId, PageId> page;

  /// From a piece's plane to the plane of all nets.
  [[nodiscard]] Vec2 place(PieceId piece, Vec2 p) const {
    return placements_[piece](p) + origins[page[piece].value()];
  }
  /// A cut whose two sides lie on each other with common ends (a slit in a flat region): the contract has it
  /// as a fold.
  [[nodiscard]] bool is_slit(const mesh::Surface& surface, EdgeId e) const;

  IdVector<PieceId, Placement> placements_;
};

/// Corners that a chain of folds joins become one vertex. Pages stand side by side; without pages each piece
/// has an unbounded page of its own, beside the others. O(n α(n)) for n faces.
[[nodiscard]] NetFrame net_frame(const mesh::Surface& surface, const unfold::Nets& nets, const Pages* pages);

}  // namespace ridgecraft::export_
