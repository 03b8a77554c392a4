// SPDX-License-Identifier: GPL-3.0-or-later
// Cutting a part between its ridges (docs/design/segmentation.md, "Order of cuts"), and what is done when
// that cuts nothing (there, "Where nothing is cut").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/measure.hpp"
#include "segment/cutting/coarse_cut.hpp"
#include "segment/cutting/edge_weights.hpp"
#include "segment/cutting/maximum_flow.hpp"
#include "segment/cutting/regions.hpp"

namespace ridgecraft::segment {

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
  template <class Inner>
  void for_sides(const PartGraph& part, std::uint32_t ridge, std::uint32_t node, Inner inner,
                 std::int64_t& source, std::int64_t& sink) const;
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
