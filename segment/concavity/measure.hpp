// SPDX-License-Identifier: GPL-3.0-or-later
// How concave a part is: all its bridges with their valleys (docs/design/segmentation.md, "One part,
// measured").
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "segment/concavity/bridges.hpp"
#include "segment/concavity/part_graph.hpp"
#include "segment/concavity/valleys.hpp"
#include "segment/hull/hull.hpp"
#include "segment/hull/hull_depth.hpp"
#include "segment/hull/shadow.hpp"
#include "segment/parts/rules.hpp"

namespace ridgecraft::segment {

/// How far the hull bulges over its flat faces, in radii of the ball: all their points become hull vertices
/// and their triangles those of a Delaunay triangulation, so that a gap between two points in one plane has
/// its bridge. Too small to be seen in any measure; large against the grid.
inline constexpr double flat_face_lift = 1e-5;

struct Measurement {
  Hull hull;
  std::vector<Bridge> bridges;
  double concavity = 0.0;        ///< greatest over the bridges (upper estimate where they were derived)
  std::uint32_t deepest = none;  ///< searched bridge of greatest concavity
  bool stopped = false;          ///< at the first high bridge, as asked for
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

/// Measures one part at a time.
class Measurer {
 public:
  /// All must outlive this. `opening_scale`: how far openings may be (hull_depth.hpp), where that isn't the
  /// tolerance.
  Measurer(const ScaledSurface& surface, const VertexGraph& graph, double tolerance, const Context& context,
           const Rules& rules = {}, std::optional<double> opening_scale = {});
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
  double cap(const Valley& valley);

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
