// SPDX-License-Identifier: GPL-3.0-or-later
// Flat regions that simplification keeps in their planes. Private to prepare/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// The points p with dot(p, normal) == offset; the normal has length 1 and looks outwards.
struct Wall {
  Vec3 normal;
  double offset = 0.0;

  [[nodiscard]] double height(Vec3 p) const { return dot(p, normal) - offset; }
};

/// Walls, and which faces are parts of them.
struct Walls {
  static constexpr std::uint32_t none = no_index;
  std::vector<Wall> walls;
  std::vector<std::uint32_t> of_face;  ///< of each face: its wall, or none; empty where no face is of one

  [[nodiscard]] std::uint32_t wall(std::size_t face) const { return of_face.empty() ? none : of_face[face]; }
};

/// Planes that a place is moved into, one after the other, each within those before.
class Meeting {
 public:
  explicit Meeting(Vec3 start) : place_(start) {}

  /// A plane at less than 2 degrees to what the others have in common is left out: where they meet isn't
  /// known well.
  void add(Vec3 normal, double offset);
  /// Orthogonal unit vectors; the planes together are across these. Three at most.
  [[nodiscard]] const std::vector<Vec3>& directions() const { return directions_; }
  [[nodiscard]] Vec3 place() const { return place_; }

 private:
  Vec3 place_;
  std::vector<Vec3> directions_;
};

/// Whether faces side by side along what is bent one way, such as a column, count as walls: where collapses
/// would set them askew they do, where it is asked what is too narrow they don't.
enum class Slats { are_walls, are_none };

/// The walls of a surface in mm, of components of which walls are a good part; none else. A wall is a flat
/// region that a person sees as one: large, or with sharp sides. Bevels, and the narrow faces that something
/// round is made of, are none. O(n).
[[nodiscard]] Walls find_walls(const mesh::Surface& surface, const Panels& panels, double short_edge_mm,
                               Slats which);

/// The same walls, with the faces of a domain of the surface. O(n).
[[nodiscard]] Walls walls_of(const Walls& whole, const FundamentalDomain& domain);

// How many folds of a surface are too short, as far as anything could be done about them.

/// Folds that are drawn: edges between panels, folded by hidden_fold_angle or more.
struct FoldFigures {
  std::size_t folds = 0;
  /// Shorter than short_edge_mm, though the walls at their ends would let them be longer: where these have no
  /// point in common near the edge, no simplification that keeps walls makes it longer.
  std::size_t brief = 0;
  /// Shorter than tiny_edge_mm; across a plate, from one wall to a parallel one, shorter than half of that:
  /// the fold along the plate is long.
  std::size_t tiny = 0;

  /// Edges between panels, drawn or not, and those of them between which numbers and tabs have little room.
  std::size_t edges = 0;
  std::size_t close = 0;
  /// Lengths of these edges, mm, and of those of them that are shorter than short_edge_mm.
  double length = 0.0;
  double cramped = 0.0;

  /// Whether most edges are too close for a model of many faces.
  [[nodiscard]] bool crowded() const { return 2 * close > edges; }
  /// Shares of the folds; 0 where there are none.
  [[nodiscard]] double short_fraction() const { return fraction(brief); }
  [[nodiscard]] double tiny_fraction() const { return fraction(tiny); }
  [[nodiscard]] double cramped_fraction() const { return length > 0.0 ? cramped / length : 0.0; }

 private:
  [[nodiscard]] double fraction(std::size_t count) const {
    return folds == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(folds);
  }
};

/// Panels must have been remeshed: then a straight fold between two of them is one
/// edge. O(n).
[[nodiscard]] FoldFigures fold_figures(const mesh::Surface& surface, const SimplifyOptions& options);
/// The same where panels and walls (without slats) are known.
[[nodiscard]] FoldFigures fold_figures(const mesh::Surface& surface, const Panels& panels, const Walls& walls,
                                       const SimplifyOptions& options);

/// Of each component: whether it can't be folded as it is, or has more faces than anybody builds. Panels must
/// have been remeshed. O(n).
[[nodiscard]] std::vector<bool> too_fine_components(const mesh::Surface& surface,
                                                    const SimplifyOptions& options);

}  // namespace ridgecraft::prepare
