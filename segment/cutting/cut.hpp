// SPDX-License-Identifier: GPL-3.0-or-later
// What a cut along an edge costs, and cutting a part between its ridges (docs/design/segmentation.md, "Price
// of an edge", "Order of cuts" and "Where nothing is cut").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/measure.hpp"
#include "segment/cutting/minimum_cut.hpp"
#include "segment/cutting/regions.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::segment {

// What a cut along an edge costs: concave and short edges are cheap (docs/design/segmentation.md,
// "Price of an edge").

/// Why it is cheap to cut along an edge; a byte, as millions of faces have three sides each.
enum class EdgeKind : std::uint8_t {
  rim,              ///< of the surface
  smooth,           ///< no reason
  hollow,           ///< concave
  drawn,            ///< the artist drew a border
  drawn_in_hollow,  ///< both
};

/// Per side, 3 f + k, of both facets of an edge alike; 0 at rims.
class EdgeWeights {
 public:
  /// As weigh_edges().
  EdgeWeights(const ScaledSurface& surface, const Rules& rules, std::span<const std::uint32_t> label);

  /// Theta: small on concave edges, 1 elsewhere.
  [[nodiscard]] double smoothness(std::size_t side) const {
    constexpr double in_hollow = 0.3;
    // Where the artist drew a border, a cut is as cheap as in a hollow, and in a hollow cheaper still.
    constexpr double on_border = 0.3;
    constexpr std::array theta{0.0, 1.0, in_hollow, on_border, in_hollow * on_border};
    return theta[static_cast<std::size_t>(kind_[side])];
  }
  /// w(e) in steps of 2^-20, at least 1: flows are exact in integers. Worked out where it is asked for, since
  /// it would be most of what is kept.
  [[nodiscard]] std::int64_t capacity(std::size_t side) const;

 private:
  const ScaledSurface* surface_;
  bool folds_by_length_;
  std::vector<EdgeKind> kind_;
  double mean_length_ = 1.0;
  double mean_smoothness_ = 1.0;
};

/// The surface must outlive it. `label`, as in segment(): edges between faces of different labels are cheap,
/// too. O(n).
[[nodiscard]] EdgeWeights weigh_edges(const ScaledSurface& surface, const Rules& rules = {},
                                      std::span<const std::uint32_t> label = {});

/// Ridges of one round that are cut off at most, the last region counted in.
inline constexpr std::size_t most_ridges = 64;

/// From so many open facets on a cut is first looked for among clusters of them. No benchmark model has as
/// many; below, the whole flow takes milliseconds.
inline constexpr std::size_t coarse_from_open = 50000;

class Cutter {
 public:
  Cutter(const ScaledSurface& surface, const EdgeWeights& weights,
         std::size_t coarse_from = coarse_from_open);

  /// Cuts the part that was just measured (it has a high bridge) along minimum cuts between its ridges'
  /// regions. Children are connected, ascending by smallest facet, facets ascending; one child when nothing
  /// was cut.
  [[nodiscard]] std::vector<Facets> cut(Measurer& measurer, const Measurement& measurement);

  /// Splits the part by which end of its deepest bridge facets are nearer to; `halves`: by the median of
  /// that, so that each child has about half of the facets. Two children at least, unless all facets are of
  /// one polygon.
  [[nodiscard]] std::vector<Facets> split(Measurer& measurer, const Measurement& measurement, bool halves);

  /// Connected components of a set of facets in ascending order, ascending by smallest facet.
  [[nodiscard]] std::vector<Facets> components(std::span<const std::uint32_t> facets);
  /// The same, where only neighbours with equal labels are together.
  [[nodiscard]] std::vector<Facets> components(std::span<const std::uint32_t> facets,
                                               std::span<const std::uint32_t> label);

 private:
  [[nodiscard]] std::vector<std::uint32_t> cut_order(std::span<const Ridge> ridges);
  void cut_off(const PartGraph& part, std::uint32_t ridge);
  void flood_fuzzy(const PartGraph& part, std::uint32_t ridge);
  /// Capacities from a node to the regions that are source and sink.
  struct Ends {
    std::int64_t source = 0;
    std::int64_t sink = 0;
  };
  template <class Inner>
  [[nodiscard]] Ends for_sides(const PartGraph& part, std::uint32_t ridge, std::uint32_t node,
                               Inner inner) const;
  class FuzzyGraph;
  void narrow_down(const PartGraph& part, std::uint32_t ridge);
  void build_flow(const PartGraph& part, std::uint32_t ridge);
  [[nodiscard]] bool touched_holds(const PartGraph& part);

  const ScaledSurface* surface_;
  const EdgeWeights* weights_;
  std::size_t coarse_from_;
  Regions regions_;
  MaximumFlow flow_;
  std::vector<std::uint32_t> label_;  ///< per facet: ridge that it was cut off with, or none
  std::vector<bool> cut_off_;         ///< per ridge
  std::vector<std::uint32_t> node_;   ///< per facet: its place in nodes_ when node_mark_ says so
  std::vector<std::uint32_t> node_mark_;
  std::uint32_t mark_ = 0;
  std::vector<std::uint32_t> nodes_;  ///< facets that a cut may run through
  CoarseCut coarse_;
  std::vector<CutSide> side_;             ///< of each of nodes_
  std::vector<std::uint32_t> touched_;    ///< places in nodes_
  std::vector<std::uint32_t> flow_node_;  ///< of each of nodes_ that is open
};

}  // namespace ridgecraft::segment
