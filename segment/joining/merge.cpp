// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/merge.hpp"

#include <algorithm>
#include <iterator>

#include "segment/joining/border.hpp"

namespace ridgecraft::segment {
namespace {

/// Borders between parts of which one at least is open.
BorderGraph<Border> borders_of(const std::vector<MergePart>& parts, const ScaledSurface& s,
                               const EdgeWeights& weights) {
  std::vector<std::uint32_t> part_of(s.facet_count(), none);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (const std::uint32_t f : parts[p].facets) {
      part_of[f] = p;
    }
  }
  BorderGraph<Border> borders(parts.size());
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == none || g < f || part_of[f] == part_of[g] || part_of[f] == none || part_of[g] == none ||
          !(parts[part_of[f]].open || parts[part_of[g]].open)) {
        continue;
      }
      borders.between(part_of[f], part_of[g]).add_side(s, weights, std::size_t{3} * f + k);
    }
  }
  return borders;
}

}  // namespace

void merge_parts(Measurer& measurer, const EdgeWeights& weights, std::vector<MergePart>& parts,
                 bool from_scratch) {
  BorderGraph<Border> borders = borders_of(parts, measurer.graph().surface(), weights);
  PairQueue<double> waiting;  // the most convex borders first
  for (const auto& [pair, border] : borders.all()) {
    waiting.put(pair, -border.mean());
  }
  Measurement measurement;
  Facets facets;
  std::vector<std::uint32_t> hull_points;
  while (!waiting.empty()) {
    measurer.context().check();
    const auto [p, q] = waiting.take();
    MergePart& into = parts[p];
    MergePart& from = parts[q];
    facets.clear();
    std::merge(into.facets.begin(), into.facets.end(), from.facets.begin(), from.facets.end(),
               std::back_inserter(facets));
    hull_points.clear();
    if (!from_scratch) {
      std::set_union(into.hull_vertices.begin(), into.hull_vertices.end(), from.hull_vertices.begin(),
                     from.hull_vertices.end(), std::back_inserter(hull_points));
    }
    measurer.measure(facets, hull_points, {.stop_at_first = true, .from_scratch = from_scratch}, measurement);
    if (measurement.stopped) {
      continue;  // its turn comes again when one of the two has grown
    }
    into.facets.swap(facets);
    into.hull_vertices = measurement.hull.vertices;
    into.merged = true;
    into.open = true;
    from.facets.clear();
    borders.take_in(p, q, [&](const Pair& pair) { waiting.drop(pair); });
    for (const std::uint32_t other : borders.beside(p)) {
      waiting.put(std::minmax(p, other), -borders.between(p, other).mean());
    }
  }
}

}  // namespace ridgecraft::segment
