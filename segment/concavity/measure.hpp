// SPDX-License-Identifier: GPL-3.0-or-later
// How concave a part is: all its bridges with their valleys (docs/design/segmentation.md, "Bridges" and "One
// part, measured").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "segment/concavity/valley_search.hpp"
#include "segment/concavity/valleys.hpp"
#include "segment/hull/hull.hpp"
#include "segment/hull/hull_depth.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::segment {

// The outline of points seen from one direction: edges of their hull that are found without the hull.

/// Convex outlines of points in a projection. Each side of an outline is an edge of the points' hull, as long
/// as no face of the hull is seen edge-on; up to the rounding of doubles.
class Shadow {
 public:
  /// Finds the outline in the plane of two directions at right angles. `corners()` and `longest()` hold until
  /// the next call. O(n), and O(k log k) for the k points near the outline.
  void cast(std::span<const Vec3> points, std::span<const std::uint32_t> ids, Vec3 right, Vec3 up);
  /// Numbers of the points at the outline's corners, counterclockwise; none when there are no points.
  [[nodiscard]] std::span<const std::uint32_t> corners() const { return corners_; }
  /// The side that is longest in space; the same number twice for less than two corners.
  [[nodiscard]] std::array<std::uint32_t, 2> longest(std::span<const Vec3> points) const;

 private:
  struct Spot {
    double x;
    double y;
    std::uint32_t id;
  };
  void drop_inner();

  std::vector<Spot> spots_;
  std::vector<Spot> chain_;
  std::vector<std::uint32_t> corners_;
};

// Bridges of a part and what is known of their concavity (docs/design/segmentation.md, "Bridges").

/// The ends are joined by an arc or a jump: the bridge is its own valley, of concavity 0.
struct Joined {};

/// The valley was searched.
struct Searched {
  double concavity = 0.0;  ///< infinite where there is no valley
  /// Of a high one: lengths of the sub-valleys from a and from b to the separator on their side; 0 where
  /// nothing but the concavity was asked for.
  std::array<double, 2> reach{};
};

/// The concavity was bounded by that of a neighbour.
struct Derived {
  double least = 0.0;
  double most = 0.0;
  std::uint32_t from = no_index;  ///< searched bridge at the beginning of the chain of neighbours
  bool crossed = false;           ///< a is nearer to that one's b
};

/// Bridge number i is edge number i of the hull.
struct Bridge {
  std::uint32_t a = no_index;  ///< smaller end
  std::uint32_t b = no_index;
  double length = 0.0;  ///< of its valley, estimated when derived; straight as long as nothing is known
  bool high = false;    ///< more concave than the tolerance
  std::variant<std::monostate, Joined, Searched, Derived> known;

  [[nodiscard]] bool is_open() const { return std::holds_alternative<std::monostate>(known); }
};

struct ConcavityBounds {
  double least = 0.0;
  double most = 0.0;  ///< the same where the bridge was searched
};

/// Of a bridge that was searched or derived; none for others.
[[nodiscard]] std::optional<ConcavityBounds> concavity_bounds(const Bridge& bridge);
/// Greatest concavity that it may have: 0 for one that is joined or open.
[[nodiscard]] double greatest_concavity(const Bridge& bridge);
/// Lengths of the sub-valleys of a high bridge from a and from b; a derived one takes those of the bridge
/// that it comes from.
[[nodiscard]] std::array<double, 2> sub_valleys(const Bridge& bridge, std::span<const Bridge> bridges);

/// Bounds the concavity of bridge `index` by that of a bridge that shares an end and a triangle of the hull
/// with it, and decides whether it is high; false, and nothing is changed, where no neighbour is near enough
/// (docs/design/segmentation.md, "Derived bridges"). O(1).
bool derive_bridge(std::uint32_t index, const Hull& hull, std::span<const Vec3> points, double tolerance,
                   std::span<Bridge> bridges);

/// How far the hull bulges over its flat faces, in radii of the ball: all their points become hull vertices
/// and their triangles those of a Delaunay triangulation, so that a gap between two points in one plane has
/// its bridge. Too small to be seen in any measure; large against the grid.
inline constexpr double flat_face_lift = 1e-5;

struct Measurement {
  Hull hull;
  std::vector<Bridge> bridges;
  double concavity = 0.0;            ///< greatest over the bridges (upper estimate where they were derived)
  std::uint32_t deepest = no_index;  ///< searched bridge of greatest concavity
  bool stopped = false;              ///< at the first high bridge, as asked for
};

/// What is asked for; by default all bridges, with what cutting needs.
struct MeasureOptions {
  /// Asks no more than whether all bridges are low: goes through them longest first, up to the first high
  /// one.
  bool stop_at_first = false;
  /// Searches each bridge on this part alone: nothing is derived, and of known valleys only those of this
  /// very part count. That is the value that is reported.
  bool from_scratch = false;
};

/// A part as segmenting gives it, with the numbers of the scaled surface and in the surface's unit.
[[nodiscard]] Part part_of(const ScaledSurface& surface, std::span<const std::uint32_t> facets,
                           const Hull& hull, double concavity, PartReason reason);

/// What counts as concave. Lengths are in the scale of the surface.
struct MeasureRules {
  double tolerance = 0.0;
  Rules rules = {};
};

/// Measures one part at a time.
class Measurer {
 public:
  /// All must outlive this, but for the rules.
  Measurer(const ScaledSurface& surface, const VertexGraph& graph, const MeasureRules& by,
           const Context& context);
  Measurer(const Measurer&) = delete;
  Measurer& operator=(const Measurer&) = delete;

  /// Measures the part with these facets. `hull_points`: vertices among which its hull vertices are; empty
  /// for all. Afterwards graph() shows the part. Throws Error(interrupted).
  void measure(std::span<const std::uint32_t> facets, std::span<const std::uint32_t> hull_points,
               const MeasureOptions& options, Measurement& out);
  /// The same for a part whose hull, among all its vertices, is known.
  void measure_with_hull(std::span<const std::uint32_t> facets, Hull hull, const MeasureOptions& options,
                         Measurement& out);

  [[nodiscard]] PartGraph& graph() { return part_; }
  /// Those that measuring finds; a ValleyLoan shares them with other parts and measurers.
  [[nodiscard]] Valleys& valleys() { return valleys_; }
  [[nodiscard]] ValleySearch& search() { return valleys_.search(); }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] const Context& context() const { return *context_; }

 private:
  /// What fails_in_shadow() works with.
  struct Outlines {
    Shadow shadow;
    std::vector<std::uint32_t> corners;
    Hull hull;  ///< of the corners
  };

  void select(std::span<const std::uint32_t> facets);
  void measure_selected(const MeasureOptions& options, Measurement& out);
  void test_selected(bool from_scratch, Measurement& out);
  [[nodiscard]] bool fails_in_shadow(std::span<const std::uint32_t> hull_points);
  bool join_ends(Bridge& bridge) const;
  void settle(std::uint32_t index, const MeasureOptions& options, Measurement& out);
  void search(std::uint32_t index, const MeasureOptions& options, Measurement& out);
  double cap(const Valley& valley, double above);

  const ScaledSurface* surface_;
  const Context* context_;
  double tolerance_;
  Rules rules_;
  PartGraph part_;
  Valleys valleys_;
  HullBuilder hulls_;
  HullDepth depth_;
  Outlines outlines_;
  std::vector<double> capped_;  ///< of the last valley: concavity of each vertex with the cap
  std::vector<std::pair<double, std::uint32_t>> ranked_;  ///< bridges: minus their length, number
  std::size_t searches_ = 0;
};

}  // namespace ridgecraft::segment
