// SPDX-License-Identifier: GPL-3.0-or-later
// In which order a model is built from its pieces: what is glued to what, and which bodies lie inside others,
// that can't be put there once the outer one is closed.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// Which pieces are glued to which, and how long the seams are.
struct SeamGraph {
  /// What a piece is glued to another one along.
  struct Seam {
    PieceId other;
    double length_mm = 0.0;
  };
  /// A piece.
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

// In which order a model is built from its pieces.

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
