// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies divided into facets where they meet. Private to prepare/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::prepare {

/// Of a triangle: numbers of its points.
using Corners = std::array<std::uint32_t, 3>;

/// Triangles of several bodies. Those of a solid bound it: around each of its edges as many run one way as
/// the other, as seen by place (points of one place count as one). Triangles without area are allowed.
struct BodySoup {
  std::vector<Vec3> points;
  std::vector<Corners> triangles;
  std::vector<std::uint32_t> body;  ///< of each triangle, below solid.size()
  std::vector<std::uint8_t> solid;  ///< of each body: 1 where its triangles bound it, 0 for a sheet
};

/// A piece of a triangle, or of several that lie on each other.
struct Facet {
  Corners corners;  ///< indices into Arrangement::points
  std::uint32_t patch;
  /// Into Arrangement::sources: the triangles that it is a piece of.
  std::uint32_t first_source, last_source;
};

/// A triangle of the soup that a facet is a piece of.
struct Source {
  std::uint32_t triangle;
  bool same_side;  ///< it faces where the facet faces
};

/// How often a body is around a place: 1 inside; others where it runs into itself or is inside out.
using Winding = std::pair<std::uint32_t, std::int32_t>;  ///< body, number

/// Facets that are connected without meeting others, so that the same bodies are around all of them.
struct Patch {
  std::vector<Winding> front, back;  ///< solids around it on the side that it faces, and on the other; no 0
};

struct Arrangement {
  /// Those of the soup (first ones at their place) and, from new_points on, where triangles meet, rounded.
  std::vector<Vec3> points;
  std::size_t new_points = 0;
  std::vector<Facet> facets;
  std::vector<Source> sources;
  std::vector<Patch> patches;
};

}  // namespace ridgecraft::prepare
