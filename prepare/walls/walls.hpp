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

/// The walls of a surface in mm, of components of which walls are a good part; none else. A wall is a flat
/// region that a person sees as one: large, or with sharp sides. Bevels, and the narrow faces that something
/// round is made of, are none. O(n).
[[nodiscard]] Walls find_walls(const mesh::Surface& surface, const Panels& panels, double short_edge_mm);

/// The same walls, with the faces of a domain of the surface. O(n).
[[nodiscard]] Walls walls_of(const Walls& whole, const FundamentalDomain& domain);

}  // namespace ridgecraft::prepare
