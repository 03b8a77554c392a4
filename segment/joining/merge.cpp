// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/merge.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace ridgecraft::segment {
namespace {

/// Borders between parts, and which of them come next.
class Borders {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  ///< ascending

  Borders(const ScaledSurface& s, const EdgeWeights& weights, const std::vector<MergePart>& parts)
      : beside_(parts.size()) {
    std::vector<std::uint32_t> part_of(s.facet_count(), none);
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
      for (const std::uint32_t f : parts[p].facets) {
        part_of[f] = p;
      }
    }
    for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t g = s.neighbors[f][k];
        if (g == none || g < f || part_of[f] == part_of[g] || part_of[f] == none || part_of[g] == none ||
            !(parts[part_of[f]].open || parts[part_of[g]].open)) {
          continue;
        }
        Border& b = border(part_of[f], part_of[g]);
        b.length += weights.length[3 * f + k];
        b.smoothness += weights.smoothness[3 * f + k] * weights.length[3 * f + k];
      }
    }
    for (const auto& [pair, b] : borders_) {
      open_.insert({b.mean(), pair});
    }
  }

  [[nodiscard]] bool empty() const { return open_.empty(); }
  /// The most convex one, the first of equal ones, taken out: unless one of its parts grows, it had its turn.
  Pair take() { return open_.extract(open_.begin()).value().pair; }

  /// `from` becomes part of `into`: its borders are into's now, and all of into's have a turn again.
  void redirect(std::uint32_t into, std::uint32_t from) {
    for (const std::uint32_t other : std::exchange(beside_[from], {})) {
      const auto at = borders_.find(std::minmax(from, other));
      const Border moved = at->second;
      open_.erase({moved.mean(), at->first});
      borders_.erase(at);
      beside_[other].erase(from);
      if (other != into) {
        Border& b = border(into, other);
        open_.erase({b.mean(), std::minmax(into, other)});
        b.length += moved.length;
        b.smoothness += moved.smoothness;
      }
    }
    for (const std::uint32_t other : beside_[into]) {
      open_.insert({border(into, other).mean(), std::minmax(into, other)});
    }
  }

 private:
  struct Border {
    double length = 0.0;
    double smoothness = 0.0;  ///< Theta times length, summed

    [[nodiscard]] double mean() const { return length > 0.0 ? smoothness / length : 0.0; }
  };
  struct Turn {
    double mean = 0.0;
    Pair pair;

    bool operator<(const Turn& other) const {
      return mean != other.mean ? mean > other.mean : pair < other.pair;
    }
  };

  /// The one between two parts, a new one where there is none.
  Border& border(std::uint32_t p, std::uint32_t q) {
    beside_[p].insert(q);
    beside_[q].insert(p);
    return borders_[std::minmax(p, q)];
  }

  std::map<Pair, Border> borders_;
  std::vector<std::set<std::uint32_t>> beside_;  ///< of each part, those that it has a border with
  std::set<Turn> open_;  ///< those that weren't tried, or whose parts have changed since
};

}  // namespace

void merge_parts(Measurer& measurer, const EdgeWeights& weights, std::vector<MergePart>& parts,
                 MeasureMode mode) {
  Borders borders(measurer.graph().surface(), weights, parts);
  Measurement measurement;
  Facets facets;
  std::vector<std::uint32_t> hull_points;
  while (!borders.empty()) {
    measurer.context().check();
    const auto [p, q] = borders.take();
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
      continue;
    }
    into.facets.swap(facets);
    into.hull_vertices = measurement.hull.vertices;
    into.merged = true;
    into.open = true;
    from.facets.clear();
    borders.redirect(p, q);
  }
}

}  // namespace ridgecraft::segment
