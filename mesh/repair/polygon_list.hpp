// SPDX-License-Identifier: GPL-3.0-or-later
// What repair works on: first the file's polygons, then triangles, both over shared points, each knowing
// where in the file it comes from. Private to mesh/.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// Polygons that are still wanted. Unlike in a Soup the points are those of the surface to be: scaled and
/// joined.
struct PolygonList {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> first{0};  ///< as Soup::first_corner
  std::vector<std::uint32_t> corners;   ///< index into points
  std::vector<std::uint32_t> textures;  ///< as Soup::corner_texture, same length as corners
  std::vector<std::uint32_t> origin;    ///< number in the file
  std::vector<std::uint8_t> two_sided;  ///< 1: a reversed copy was dropped, so its direction means nothing
  /// By the number of such a polygon in the file: that of the copy.
  std::map<std::uint32_t, std::uint32_t> reversed_copy;

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> polygon(std::size_t i) const {
    return {corners.data() + first[i], first[i + 1] - first[i]};
  }
};

struct Triangle {
  std::array<std::uint32_t, 3> points;
  std::array<std::uint32_t, 3> textures;
  std::uint32_t origin;    ///< number of the polygon in the file
  bool two_sided = false;  ///< as PolygonList::two_sided
  bool turned = false;     ///< runs against the direction it has in the file

  void turn() {
    std::swap(points[1], points[2]);
    std::swap(textures[1], textures[2]);
    turned = !turned;
  }
};

struct TriangleList {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::map<std::uint32_t, std::uint32_t> reversed_copy;  ///< as PolygonList::reversed_copy
};

/// Details of remarks: where it was first.
[[nodiscard]] inline std::string first_polygon(std::uint32_t polygon) {
  return "first: polygon " + std::to_string(std::uint64_t{polygon} + 1);
}
[[nodiscard]] inline std::string first_at_polygon(std::uint32_t polygon) {
  return "first: at polygon " + std::to_string(std::uint64_t{polygon} + 1);
}

/// One use of an edge by a triangle: side k runs from corner k to corner k + 1.
struct EdgeUse {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;
  std::uint8_t side;
  bool forward;  ///< the side runs from low to high
};

/// All sides, sorted by edge and then by triangle, so that the uses of one edge stand together. O(n).
[[nodiscard]] std::vector<EdgeUse> edge_uses(std::span<const Triangle> triangles);

/// Calls visit(first, last) for each run of uses of one edge, from `low` to `high`, that stand together.
template <class Use, class Visit>
void for_each_edge(const std::vector<Use>& uses, Visit visit) {
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high) {
      ++j;
    }
    visit(i, j);
    i = j;
  }
}

/// Splits every polygon along diagonals that lie inside it: quads along the one that bends them least (flat
/// ones along the one that gives the better triangles), larger ones by constrained Delaunay in their mean
/// plane. What crosses itself is left out and remarked; what is bent is split and remarked. `flat` is the
/// distance from its mean plane that a corner may have. O(n log n).
[[nodiscard]] TriangleList triangulate(PolygonList list, double flat, RepairReport& report,
                                       const Context& context);

/// The surface of these faces, without points that none uses; the others keep their order. O(n log n).
[[nodiscard]] Surface surface_of(const std::vector<Vec3>& points,
                                 const std::vector<std::array<std::uint32_t, 3>>& faces);

}  // namespace ridgecraft::mesh
