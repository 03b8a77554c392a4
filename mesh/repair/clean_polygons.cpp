// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/clean_polygons.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/order.hpp"
#include "mesh/repair/polygon_list.hpp"

namespace ridgecraft::mesh {
namespace {

// Walls between solids that are there from either side. Private to mesh/.

/// Two polygons of a list with the same corners in opposite order.
using WallPair = std::array<std::uint32_t, 2>;

constexpr std::uint32_t no_pair = Soup::none;

struct WallSide {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t pair;  ///< or no_pair
  bool forward;
};

/// An edge at which walls lie: which, and whether the rest closes there.
struct WallEdge {
  std::vector<std::uint32_t> pairs;  ///< each once
  std::size_t others = 0;            ///< sides of polygons that are in no pair
  bool balanced = false;             ///< these run as often one way as the other
};

/// All edges of walls. Sides of polygons that name a point twice are skipped where they run from it to
/// itself.
std::vector<WallEdge> wall_edges(const PolygonList& list, const std::vector<WallPair>& pairs) {
  std::vector<std::uint32_t> pair_of(list.size(), no_pair);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    pair_of[pairs[i][0]] = pair_of[pairs[i][1]] = i;
  }
  std::vector<WallSide> sides;
  sides.reserve(list.corners.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto polygon = list.polygon(i);
    std::uint32_t p = polygon.back();
    for (const std::uint32_t q : polygon) {
      if (p != q) {
        sides.push_back({std::min(p, q), std::max(p, q), pair_of[i], p < q});
      }
      p = q;
    }
  }
  const std::vector<WallSide> ordered = in_edge_order(std::span<const WallSide>(sides));
  std::vector<WallEdge> edges;
  for_each_edge(ordered, [&](std::size_t first, std::size_t last) {
    WallEdge edge;
    std::ptrdiff_t balance = 0;
    for (std::size_t i = first; i < last; ++i) {
      const WallSide& side = ordered[i];
      if (side.pair == no_pair) {
        ++edge.others;
        balance += side.forward ? 1 : -1;
      } else if (std::find(edge.pairs.begin(), edge.pairs.end(), side.pair) == edge.pairs.end()) {
        edge.pairs.push_back(side.pair);
      }
    }
    edge.balanced = balance == 0;
    if (!edge.pairs.empty()) {
      edges.push_back(std::move(edge));
    }
  });
  return edges;
}

/// Marks the pairs that are sheets: those that end where nothing else is or where the rest stays open, and
/// those that then end there because others were marked.
std::vector<bool> find_sheets(const std::vector<WallEdge>& edges, std::size_t pair_count) {
  std::vector<std::vector<std::uint32_t>> edges_of(pair_count);
  std::vector<std::size_t> walls(edges.size());
  std::vector<std::uint32_t> open;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    walls[e] = edges[e].pairs.size();
    open.push_back(e);
    for (const std::uint32_t p : edges[e].pairs) {
      edges_of[p].push_back(e);
    }
  }
  std::vector<bool> sheet(pair_count, false);
  while (!open.empty()) {
    const std::uint32_t e = open.back();
    open.pop_back();
    const WallEdge& edge = edges[e];
    if (edge.balanced && (edge.others > 0 || walls[e] != 1)) {
      continue;
    }
    for (const std::uint32_t p : edge.pairs) {
      if (!sheet[p]) {
        sheet[p] = true;
        for (const std::uint32_t other : edges_of[p]) {
          --walls[other];
          open.push_back(other);
        }
      }
    }
  }
  return sheet;
}

/// Those of the pairs that two solids have between them: without both copies the rest closes at the rim of
/// the wall, as many sides running one way as the other. What ends at nothing is a sheet that was drawn from
/// both sides, and so is what closes by itself. `pairs`: each polygon in one pair at most. O(n log n).
std::vector<WallPair> walls_between_solids(const PolygonList& list, const std::vector<WallPair>& pairs) {
  const std::vector<WallEdge> edges = wall_edges(list, pairs);
  const std::vector<bool> sheet = find_sheets(edges, pairs.size());
  // Walls that hang together have a rim somewhere, or they are a body of their own drawn from both sides.
  DisjointSets sets(pairs.size());
  std::vector<std::uint32_t> rim;
  for (const WallEdge& edge : edges) {
    std::vector<std::uint32_t> walls;
    std::copy_if(edge.pairs.begin(), edge.pairs.end(), std::back_inserter(walls),
                 [&](std::uint32_t p) { return !sheet[p]; });
    for (const std::uint32_t p : walls) {
      sets.join(walls.front(), p);
    }
    if (edge.others > 0 && walls.size() % 2 == 1) {
      rim.push_back(walls.front());
    }
  }
  std::vector<bool> has_rim(pairs.size(), false);
  for (const std::uint32_t p : rim) {
    has_rim[sets.find(p)] = true;
  }
  std::vector<WallPair> found;
  for (std::uint32_t p = 0; p < pairs.size(); ++p) {
    if (!sheet[p] && has_rim[sets.find(p)]) {
      found.push_back(pairs[p]);
    }
  }
  return found;
}

constexpr std::uint32_t no_texture = Soup::none;

std::size_t different_points(std::vector<std::uint32_t> corners) {
  std::sort(corners.begin(), corners.end());
  return static_cast<std::size_t>(std::unique(corners.begin(), corners.end()) - corners.begin());
}

/// Corners of one polygon with their place in the list; repeats of the corner before are left out.
std::vector<std::uint32_t> kept_corners(const PolygonList& list, std::size_t i) {
  std::vector<std::uint32_t> kept;
  for (std::uint32_t c = list.first[i]; c < list.first[i + 1]; ++c) {
    if (kept.empty() || list.corners[kept.back()] != list.corners[c]) {
      kept.push_back(c);
    }
  }
  while (kept.size() > 1 && list.corners[kept.back()] == list.corners[kept.front()]) {
    kept.pop_back();
  }
  return kept;
}

/// Whether no polygon has fewer than three corners or names a point twice. False for larger polygons, which
/// take longer to tell.
bool all_corners_differ(const PolygonList& list) {
  constexpr std::size_t quickly_told = 4;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto p = list.polygon(i);
    if (p.size() < 3 || p.size() > quickly_told || p[0] == p[1] || p[1] == p[2] || p[2] == p[0] ||
        (p.size() == quickly_told && (p[3] == p[0] || p[3] == p[1] || p[3] == p[2]))) {
      return false;
    }
  }
  return true;
}

void keep_polygon(PolygonList& to, const PolygonList& from, std::size_t i,
                  std::span<const std::uint32_t> corners) {
  for (const std::uint32_t c : corners) {
    to.corners.push_back(from.corners[c]);
    to.textures.push_back(from.textures.empty() ? no_texture : from.textures[c]);
  }
  to.first.push_back(static_cast<std::uint32_t>(to.corners.size()));
  to.origin.push_back(from.origin[i]);
  to.two_sided.push_back(from.two_sided[i]);
}

/// A polygon as a cycle: it begins with its smallest point and goes on to the smaller neighbour of that.
struct Cycle {
  std::vector<std::uint32_t> points;
  bool reversed = false;  ///< against the polygon's own direction
};

Cycle canonical(std::span<const std::uint32_t> polygon) {
  const std::size_t n = polygon.size();
  const auto start =
      static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end()) - polygon.begin());
  Cycle cycle;
  cycle.reversed = polygon[(start + n - 1) % n] < polygon[(start + 1) % n];
  cycle.points.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    cycle.points.push_back(polygon[(start + (cycle.reversed ? n - k : k)) % n]);
  }
  return cycle;
}

/// Equal for polygons with the same corners, wherever they start and whichever way they run; nearly always
/// different for others.
std::uint64_t corner_key(std::span<const std::uint32_t> polygon) {
  std::uint64_t sum = polygon.size();
  for (const std::uint32_t p : polygon) {
    sum += (p + 1ULL) * 0x9e3779b97f4a7c15ULL ^ ((p + 1ULL) * (p + 1ULL));
  }
  return sum;
}

/// Whether all are different. Linear: a table of twice the size, where each looks for a free place.
bool all_different(const std::vector<std::uint64_t>& keys) {
  const std::size_t size = std::bit_ceil(2 * keys.size() + 1);
  std::vector<std::uint64_t> table(size, 0);
  for (const std::uint64_t key : keys) {
    const std::uint64_t entry = key == 0 ? 1 : key;  // 0 marks a free place; a false alarm costs a sort
    std::size_t i = static_cast<std::size_t>((entry * 0xbf58476d1ce4e5b9ULL) >> 24U) & (size - 1);
    for (; table[i] != 0; i = (i + 1) & (size - 1)) {
      if (table[i] == entry) {
        return false;
      }
    }
    table[i] = entry;
  }
  return true;
}

std::vector<std::uint64_t> corner_keys(const PolygonList& list) {
  std::vector<std::uint64_t> keys(list.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i] = corner_key(list.polygon(i));
  }
  return keys;
}

/// Numbers of polygons by their cycle, equal ones together in ascending order.
std::vector<std::uint32_t> sorted_by_cycle(const PolygonList& list, const std::vector<std::uint64_t>& key) {
  std::vector<std::uint32_t> order(list.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = static_cast<std::uint32_t>(i);
  }
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key[a] != key[b] ? key[a] < key[b] : a < b; });
  // Within equal keys, which are nearly always equal polygons, order by the cycles themselves.
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i + 1;
    while (j < order.size() && key[order[j]] == key[order[i]]) {
      ++j;
    }
    if (j - i > 1) {
      std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(i),
                       order.begin() + static_cast<std::ptrdiff_t>(j), [&](std::uint32_t a, std::uint32_t b) {
                         return canonical(list.polygon(a)).points < canonical(list.polygon(b)).points;
                       });
    }
    i = j;
  }
  return order;
}

/// How many polygon sides run along each edge, both directions together; asked only for meshes with reversed
/// copies.
class EdgeCounts {
 public:
  explicit EdgeCounts(const PolygonList& list) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto p = list.polygon(i);
      for (std::size_t k = 0; k < p.size(); ++k) {
        edges_.push_back(edge(p[k], p[(k + 1) % p.size()]));
      }
    }
    std::sort(edges_.begin(), edges_.end());
  }
  [[nodiscard]] std::size_t count(std::uint32_t a, std::uint32_t b) const {
    const auto [low, high] = std::equal_range(edges_.begin(), edges_.end(), edge(a, b));
    return static_cast<std::size_t>(high - low);
  }

 private:
  static std::array<std::uint32_t, 2> edge(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
  }
  std::vector<std::array<std::uint32_t, 2>> edges_;
};

bool shares_sides_with(const PolygonList& list, const EdgeCounts& counts, std::uint32_t i,
                       std::size_t copies) {
  const auto p = list.polygon(i);
  for (std::size_t k = 0; k < p.size(); ++k) {
    if (counts.count(p[k], p[(k + 1) % p.size()]) != copies) {
      return true;
    }
  }
  return false;
}

/// Equal polygons: where they stand in the order.
struct Group {
  std::size_t first, last;
};

std::vector<Group> groups_of(const PolygonList& list, const std::vector<std::uint64_t>& keys,
                             const std::vector<std::uint32_t>& order) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i + 1;
    if (j < order.size() && keys[order[j]] == keys[order[i]]) {
      const Cycle first = canonical(list.polygon(order[i]));
      while (j < order.size() && list.polygon(order[j]).size() == first.points.size() &&
             canonical(list.polygon(order[j])).points == first.points) {
        ++j;
      }
    }
    if (j - i > 1) {
      groups.push_back({i, j});
    }
    i = j;
  }
  return groups;
}

/// Polygons that are there once in either direction.
std::vector<WallPair> opposite_pairs(const PolygonList& list, const std::vector<Group>& groups,
                                     const std::vector<std::uint32_t>& order) {
  std::vector<WallPair> pairs;
  for (const Group& group : groups) {
    const std::uint32_t a = order[group.first];
    const std::uint32_t b = order[group.first + 1];
    if (group.last - group.first == 2 &&
        canonical(list.polygon(a)).reversed != canonical(list.polygon(b)).reversed) {
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

/// Marks what stays of a group of equal polygons, given in ascending order.
void choose(PolygonList& list, std::span<const std::uint32_t> group, std::vector<bool>& keep,
            std::optional<EdgeCounts>& counts) {
  const bool direction = canonical(list.polygon(group[0])).reversed;
  const auto reversed = std::find_if(group.begin(), group.end(), [&](std::uint32_t i) {
    return canonical(list.polygon(i)).reversed != direction;
  });
  for (const std::uint32_t i : group.subspan(1)) {
    keep[i] = false;
  }
  if (reversed == group.end()) {
    return;
  }
  if (!counts) {
    counts.emplace(list);
  }
  // A pair of larger polygons would get the same diagonals on both sides: edges with four faces.
  if (list.polygon(group[0]).size() <= 4 && !shares_sides_with(list, *counts, group[0], group.size())) {
    keep[*reversed] = true;
  } else {
    list.two_sided[group[0]] = 1;
    list.reversed_copy.emplace(list.origin[group[0]], list.origin[*reversed]);
  }
}

}  // namespace

void drop_repeated_corners(PolygonList& list, RepairReport& report) {
  if (list.textures.empty()) {
    list.textures.assign(list.corners.size(), no_texture);
  }
  if (all_corners_differ(list)) {
    return;
  }
  PolygonList clean;
  clean.points = std::move(list.points);
  clean.corners.reserve(list.corners.size());
  clean.textures.reserve(list.corners.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::vector<std::uint32_t> kept = kept_corners(list, i);
    std::vector<std::uint32_t> points;
    for (const std::uint32_t c : kept) {
      points.push_back(list.corners[c]);
    }
    if (different_points(points) < 3) {
      report.add(RepairKind::polygons_dropped, 1, first_polygon(list.origin[i]));
      continue;
    }
    report.add(RepairKind::polygon_corner_dropped, list.first[i + 1] - list.first[i] - kept.size(),
               first_polygon(list.origin[i]));
    keep_polygon(clean, list, i, kept);
  }
  list = std::move(clean);
}

void drop_duplicates(PolygonList& list, RepairReport& report) {
  const std::vector<std::uint64_t> keys = corner_keys(list);
  if (all_different(keys)) {
    return;
  }
  const std::vector<std::uint32_t> order = sorted_by_cycle(list, keys);
  const std::vector<Group> groups = groups_of(list, keys, order);
  const std::vector<WallPair> pairs = opposite_pairs(list, groups, order);
  std::vector<bool> wall(list.size(), false);
  for (const WallPair& pair : pairs.empty() ? pairs : walls_between_solids(list, pairs)) {
    wall[pair[0]] = wall[pair[1]] = true;
    report.add(RepairKind::inner_walls_dropped, 1, first_polygon(list.origin[pair[0]]));
  }
  std::vector<bool> keep(list.size(), true);
  std::optional<EdgeCounts> counts;
  for (const Group& group : groups) {
    if (!wall[order[group.first]]) {
      choose(list, std::span(order).subspan(group.first, group.last - group.first), keep, counts);
    }
  }
  PolygonList kept;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (wall[i]) {
      continue;
    }
    if (!keep[i]) {
      report.add(RepairKind::duplicate_faces_dropped, 1, first_polygon(list.origin[i]));
      continue;
    }
    std::vector<std::uint32_t> corners;
    for (std::uint32_t c = list.first[i]; c < list.first[i + 1]; ++c) {
      corners.push_back(c);
    }
    keep_polygon(kept, list, i, corners);
  }
  kept.points = std::move(list.points);
  kept.reversed_copy = std::move(list.reversed_copy);
  list = std::move(kept);
}

void drop_duplicates(TriangleList& list, RepairReport& report) {
  std::vector<std::uint64_t> keys(list.triangles.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i] = corner_key(list.triangles[i].points);
  }
  if (all_different(keys)) {
    return;
  }
  PolygonList polygons;
  for (const Triangle& t : list.triangles) {
    polygons.corners.insert(polygons.corners.end(), t.points.begin(), t.points.end());
    polygons.textures.insert(polygons.textures.end(), t.textures.begin(), t.textures.end());
    polygons.first.push_back(static_cast<std::uint32_t>(polygons.corners.size()));
    polygons.origin.push_back(t.origin);
    polygons.two_sided.push_back(t.two_sided ? 1 : 0);
  }
  polygons.reversed_copy = std::move(list.reversed_copy);
  drop_duplicates(polygons, report);
  list.reversed_copy = std::move(polygons.reversed_copy);
  list.triangles.clear();
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::size_t c = polygons.first[i];
    list.triangles.push_back({{polygons.corners[c], polygons.corners[c + 1], polygons.corners[c + 2]},
                              {polygons.textures[c], polygons.textures[c + 1], polygons.textures[c + 2]},
                              polygons.origin[i],
                              polygons.two_sided[i] != 0,
                              false});
  }
}

}  // namespace ridgecraft::mesh
