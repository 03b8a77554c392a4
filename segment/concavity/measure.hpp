// SPDX-License-Identifier: GPL-3.0-or-later
// How concave a part is: all its bridges with their valleys (specification 2 to 4).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "segment/concavity/hull.hpp"
#include "segment/concavity/hull_depth.hpp"
#include "segment/concavity/part_graph.hpp"
#include "segment/concavity/shadow.hpp"
#include "segment/concavity/valley_cache.hpp"
#include "segment/concavity/valley_search.hpp"
#include "segment/rules.hpp"

namespace ridgecraft::segment {

/// How far the hull bulges over its flat faces, in radii of the ball: all their points become hull vertices
/// and their triangles those of a Delaunay triangulation, so that a gap between two points in one plane has
/// its bridge. Too small to be seen in any measure; large against the grid.
inline constexpr double flat_face_lift = 1e-5;

/// A bridge: edge number i of the hull.
struct Bridge {
  enum class State : std::uint8_t { open, low, high };

  std::uint32_t a = none;  ///< smaller end
  std::uint32_t b = none;
  double low = 0.0;  ///< its concavity is between low and high; equal when it was searched
  double high = 0.0;
  double length = 0.0;  ///< of its valley, estimated when derived
  State state = State::open;
  bool zero = false;            ///< low because its ends are joined by an arc or a jump (2.4)
  std::uint32_t source = none;  ///< searched bridge that its interval comes from; itself when searched
  double reach_a = 0.0;         ///< high: length of the sub-valley from a to its separator (8.1)
  double reach_b = 0.0;
};

struct Measurement {
  Hull hull;
  std::vector<Bridge> bridges;
  double concavity = 0.0;        ///< greatest over the bridges (upper estimate where they were derived)
  std::uint32_t deepest = none;  ///< searched bridge of greatest concavity
  bool stopped = false;          ///< at the first high bridge, as asked for
};

enum class MeasureMode {
  split,         ///< all bridges, with what cutting needs
  test,          ///< whether all are low: longest first, stops at the first high one
  test_scratch,  ///< as test, with the value of scratch
  scratch,       ///< as split, but each bridge is searched on this part alone: the value that is reported
};

/// Measures one part at a time.
class Measurer {
 public:
  /// `opening_scale`: how far openings may be (hull_depth.hpp), where that isn't the tolerance.
  Measurer(const ScaledSurface& surface, const VertexGraph& graph, double tolerance, const Context& context,
           const Rules& rules = {}, std::optional<double> opening_scale = {});

  /// Measures the part with these facets. `hull_points`: vertices among which its hull vertices are; empty
  /// for all. Afterwards graph() shows the part.
  void measure(std::span<const std::uint32_t> facets, std::span<const std::uint32_t> hull_points,
               MeasureMode mode, Measurement& out);
  /// The same for a part whose hull, among all its vertices, is known.
  void measure_with_hull(std::span<const std::uint32_t> facets, Hull hull, MeasureMode mode,
                         Measurement& out);

  /// From now on uses and adds to these valleys, and uses those of `known`, which may be null, but outlives
  /// their use and isn't changed.
  void use_valleys(ValleyCache own, const ValleyCache* known);
  /// What it found, and was given as own, since use_valleys().
  [[nodiscard]] ValleyCache take_valleys();

  [[nodiscard]] PartGraph& graph() { return part_; }
  [[nodiscard]] ValleySearch& search() { return search_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] const Context& context() const { return *context_; }

 private:
  void measure_selected(MeasureMode mode, Measurement& out);
  void sort_longest_first(std::size_t from, std::span<Bridge> bridges);
  [[nodiscard]] bool fails_in_shadow(std::span<const std::uint32_t> hull_points);
  [[nodiscard]] bool is_zero(Bridge& bridge) const;
  bool derive(std::uint32_t index, Measurement& m) const;
  bool derive_from(Bridge& bridge, const Bridge& source, double moved) const;
  void search(std::uint32_t index, Measurement& m, bool scratch, bool with_reach);
  Valley find_valley(const Bridge& bridge, bool scratch);
  [[nodiscard]] bool survives(const Valley& valley) const;
  double cap(const Valley& valley);
  void find_reach(Bridge& bridge, const Valley& valley);

  const ScaledSurface* surface_;
  const Context* context_;
  double tolerance_;
  Rules rules_;
  PartGraph part_;
  ValleySearch search_;
  ValleyCache cache_;
  const ValleyCache* known_ = nullptr;
  std::uint64_t signature_ = 0;  ///< of the part that the graph shows: a hash of its facets
  HullBuilder hulls_;
  HullDepth depth_;
  Shadow shadow_;
  std::vector<std::uint32_t> shadow_corners_;
  Hull inner_hull_;
  std::vector<Step> steps_;
  std::vector<Vec3> valley_points_;
  std::vector<Vec2> chain_;
  std::vector<double> concavity_;
  std::vector<double> capped_;
  std::vector<std::uint32_t> order_;
  std::vector<std::pair<double, std::uint32_t>> ranked_;
};

}  // namespace ridgecraft::segment
