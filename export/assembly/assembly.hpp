// SPDX-License-Identifier: GPL-3.0-or-later
// In which order a model is built from its pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// What is done at a time: these pieces are folded, and glued to what stands.
struct AssemblyStep {
  std::vector<PieceId> pieces;  ///< at least one; several are equal or mirror images; ascending
  std::vector<JoinId> own;      ///< that close one of the pieces by itself: these are glued first; ascending
  std::vector<JoinId> joins;    ///< with what stands, and between pieces of this step; ascending
  bool starts = false;          ///< what stands has no seam with these pieces: a body begins
  bool closes = false;          ///< the body is closed after it: no hand reaches inside any more
};

/// How a model is built, one step after the other.
struct Assembly {
  std::vector<AssemblyStep> steps;
};

/// A border of this length lets a hand in, mm: then a body needn't have a last piece that is easy.
inline constexpr double hand_hole_mm = 120.0;

/// Each piece is in one step, each join in the step after which both its sides stand. Bodies that lie inside
/// others come first, then the larger ones. A body begins with the piece that has most seam; then comes
/// whichever piece has most seam with what stands. The piece whose seams are easiest (long edges, a wide
/// opening, nothing to be closed by itself) comes last where a body has no border by which a hand gets in, so
/// long as the others hang together without it; or rather one on the model's underside, if it is half as
/// easy. `up`: a unit vector, or zero where that isn't known. Pieces that are equal or mirror images come
/// together where what stands has at least seven tenths as much seam with each as with the first, and equal
/// bodies are built side by side. Deterministic. O(pieces^2 + faces log faces).
[[nodiscard]] Assembly assembly_order(const mesh::Surface& surface, const unfold::Nets& nets, Vec3 up = {});

}  // namespace ridgecraft::export_
