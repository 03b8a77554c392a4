// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/merge.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace ridgecraft::segment {
namespace {

/// Two parts with a common border.
struct Border {
  double length = 0.0;
  double smoothness = 0.0;  ///< Theta times length, summed
  bool failed = false;      ///< the union was too concave, and neither has changed since

  [[nodiscard]] double mean() const { return length > 0.0 ? smoothness / length : 0.0; }
};

using Borders = std::map<std::pair<std::uint32_t, std::uint32_t>, Border>;

Borders find_borders(const ScaledSurface& s, const EdgeWeights& weights,
                     const std::vector<MergePart>& parts) {
  std::vector<std::uint32_t> part_of(s.facet_count(), none);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (const std::uint32_t f : parts[p].facets) {
      part_of[f] = p;
    }
  }
  Borders borders;
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == none || g < f || part_of[f] == part_of[g] || part_of[f] == none || part_of[g] == none ||
          !(parts[part_of[f]].open || parts[part_of[g]].open)) {
        continue;
      }
      Border& b = borders[std::minmax(part_of[f], part_of[g])];
      b.length += weights.length[3 * f + k];
      b.smoothness += weights.smoothness[3 * f + k] * weights.length[3 * f + k];
    }
  }
  return borders;
}

/// `from` becomes part of `into`: its borders are into's now, and all of into's are to be tested again.
void redirect(Borders& borders, std::uint32_t into, std::uint32_t from) {
  Borders changed;
  for (auto it = borders.begin(); it != borders.end();) {
    const auto [p, q] = it->first;
    if (p != from && q != from) {
      it->second.failed = it->second.failed && p != into && q != into;
      ++it;
      continue;
    }
    const std::uint32_t other = p == from ? q : p;
    if (other != into) {
      changed[std::minmax(into, other)] = it->second;
    }
    it = borders.erase(it);
  }
  for (const auto& [pair, border] : changed) {
    Border& b = borders[pair];
    b.length += border.length;
    b.smoothness += border.smoothness;
    b.failed = false;
  }
}

}  // namespace

void merge_parts(Measurer& measurer, const EdgeWeights& weights, std::vector<MergePart>& parts,
                 MeasureMode mode) {
  Borders borders = find_borders(measurer.graph().surface(), weights, parts);
  Measurement measurement;
  Facets facets;
  std::vector<std::uint32_t> hull_points;
  for (;;) {
    measurer.context().check();
    auto best = borders.end();
    for (auto it = borders.begin(); it != borders.end(); ++it) {
      if (!it->second.failed && (best == borders.end() || it->second.mean() > best->second.mean())) {
        best = it;
      }
    }
    if (best == borders.end()) {
      return;
    }
    const auto [p, q] = best->first;
    MergePart& into = parts[p];
    MergePart& from = parts[q];
    facets.clear();
    std::merge(into.facets.begin(), into.facets.end(), from.facets.begin(), from.facets.end(),
               std::back_inserter(facets));
    hull_points.clear();
    if (mode == MeasureMode::test) {
      std::set_union(into.hull_vertices.begin(), into.hull_vertices.end(), from.hull_vertices.begin(),
                     from.hull_vertices.end(), std::back_inserter(hull_points));
    }
    measurer.measure(facets, hull_points, mode, measurement);
    if (measurement.stopped) {
      best->second.failed = true;
      continue;
    }
    into.facets.swap(facets);
    into.hull_vertices = measurement.hull.vertices;
    into.merged = true;
    into.open = true;
    from.facets.clear();
    redirect(borders, p, q);
  }
}

}  // namespace ridgecraft::segment
