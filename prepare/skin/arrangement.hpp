// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that run through each other are divided where they meet, exactly, and it is found out which
// bodies lie on either side of what results. Keeps CGAL out of headers. Private to prepare/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"

namespace ridgecraft::prepare {

/// Triangles of several bodies. Those of a solid bound it: around each of its edges as many run one way as
/// the other, as seen by place (points of one place count as one). Triangles without area are allowed.
struct BodySoup {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> body;  ///< of each triangle, below solid.size()
  std::vector<std::uint8_t> solid;  ///< of each body: 1 where its triangles bound it, 0 for a sheet
};

/// A piece of a triangle, or of several that lie on each other.
struct Facet {
  std::array<std::uint32_t, 3> corners;  ///< indices into Arrangement::points
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

/// Divides all triangles of solids where they meet others of solids, and those of sheets where they meet
/// solids. Points are exact until the end (CGAL's lazy exact numbers), so nothing is missed and nothing
/// fails. None where more than `most_pairs` pairs of triangles meet: that would take too long. O(n log n) for
/// n triangles, and some 20 microseconds a pair that meets.
[[nodiscard]] std::optional<Arrangement> arrange(const BodySoup& soup, std::size_t most_pairs,
                                                 const Context& context);

/// Pairs of triangles that run through each other, those with a common place for a corner not counted; stops
/// counting at the first.
[[nodiscard]] bool has_crossings(const std::vector<Vec3>& points,
                                 const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                 const Context& context);

}  // namespace ridgecraft::prepare
