// SPDX-License-Identifier: GPL-3.0-or-later
// The convex hull of a part's vertices: exact, and triangulated in one fixed manner
// (docs/design/segmentation.md, "Bridges").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// A hull whose vertices are the extreme points only and whose flat faces are fans from their smallest
/// vertex. So it depends on the set of points alone: hull(hull vertices) is the same hull, whatever the order
/// of the points.
struct Hull {
  std::vector<std::uint32_t> vertices;                  ///< ascending
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counterclockwise from outside; none when flat
  std::vector<std::array<std::uint32_t, 2>> edges;      ///< {smaller, larger vertex}, ascending: the bridges
  std::vector<std::array<std::uint32_t, 3>>
      triangle_edges;  ///< edge k of a triangle runs from corner k to k + 1
  std::vector<std::array<std::uint32_t, 2>>
      edge_triangles;  ///< the two triangles at each edge; none twice when flat
  bool flat = false;   ///< all points in one plane: edges are those of the hull in the plane (none on a line)

  void clear();
  /// Enclosed volume; 0 when flat. O(triangles).
  [[nodiscard]] double volume(std::span<const Vec3> points) const;
};

/// Quickhull (Barber, Dobkin, Huhdanpaa 1996) on flat arrays. Facets that contain a new point in their plane
/// are replaced together with those that see it, so no facet is ever degenerate. Signs are exact: a bound on
/// the rounding of each facet's plane decides nearly always, 128-bit integers the rest. Points must be on the
/// grid. Why not a library's: docs/design/segmentation.md, "What is written by hand, and why".
class HullBuilder {
 public:
  explicit HullBuilder(std::span<const Vec3> points);
  /// Hull of the points with these numbers (no number twice). With a `lift`, the points are first moved away
  /// from their middle, by lift (1 - r^2 / 4) r at distance r: over each flat face they bulge like a
  /// paraboloid, which makes all its points hull vertices and its triangles Delaunay. Expected O(n log n).
  void build(std::span<const std::uint32_t> ids, Hull& out, double lift = 0.0);

 private:
  struct Facet {
    std::array<std::uint32_t, 3> v;    ///< local point numbers, counterclockwise from outside
    std::array<std::uint32_t, 3> nb;   ///< across the side from corner k to k + 1
    Vec3 at;                           ///< a point of the plane
    Vec3 n;                            ///< not normalised
    double bound = 0.0;                ///< rounding of n . (p - at) for any p in the unit ball
    std::uint32_t outside = no_index;  ///< first of the points above it, linked through next_
    std::uint32_t top = no_index;      ///< the highest of them
    double height = 0.0;
    bool alive = true;
    std::uint32_t mark = 0;
  };
  struct HorizonEdge {
    std::uint32_t from;
    std::uint32_t to;
    std::uint32_t beyond;       ///< facet that stays
    std::uint32_t beyond_side;  ///< its side along this edge
  };

  void take_points(std::span<const std::uint32_t> ids, double lift);
  double find_extent();
  bool find_simplex();
  template <class Distance>
  [[nodiscard]] std::uint32_t farthest(double limit, const Distance& distance) const;
  void begin_with_simplex();
  void build_line(Hull& out) const;
  void build_flat(Hull& out) const;
  [[nodiscard]] int side_of(const Facet& f, std::uint32_t p) const;
  std::uint32_t new_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void give_point(std::uint32_t facet, std::uint32_t p, double height);
  void add_top_of(std::uint32_t facet);
  void find_horizon(std::uint32_t facet, std::uint32_t p);
  void merge_coplanar();
  void emit();
  void emit_face(const std::vector<std::uint32_t>& members);
  void connect(Hull& out);

  std::span<const Vec3> all_points_;
  std::vector<std::uint32_t> ids_;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> slot_;  ///< per local point: scratch for linking cycles
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> pending_;
  std::vector<std::uint32_t> visible_;
  std::vector<std::uint32_t> fresh_;
  std::vector<HorizonEdge> horizon_;
  DisjointSets faces_;  ///< of facets in one plane
  std::vector<std::uint32_t> cycle_;
  std::vector<std::array<std::uint32_t, 3>> local_triangles_;
  std::vector<std::array<std::uint32_t, 2>> vertex_order_;  ///< {vertex, local point}
  std::vector<std::uint32_t> bucket_;
  std::vector<std::array<std::uint32_t, 2>> sides_;  ///< {rank of the larger end, 3 triangle + side}
  std::array<std::uint32_t, 4> simplex_{};
  std::uint32_t mark_ = 0;
};

}  // namespace ridgecraft::segment
