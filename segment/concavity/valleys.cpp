// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/valleys.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/context.hpp"
#include "base/geometry.hpp"
#include "base/random.hpp"

namespace ridgecraft::segment {
namespace {

/// How far t may fall between two vertices of a chain that still counts as monotone: rounding of a unit
/// length.
constexpr double fall_tolerance = 1e-9;
/// Chains longer than this skip the shortest path in the polygon (its cost grows with the cube at worst) and
/// take the hierarchy, an upper estimate. Benchmark models have 10 to 200 points.
constexpr std::size_t longest_polygon = 1024;
constexpr int deepest_hierarchy = 8;

double turn(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - a);
}

bool on_segment(Vec2 a, Vec2 b, Vec2 p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Whether two closed segments share a point.
bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double o1 = turn(a, b, c);
  const double o2 = turn(a, b, d);
  const double o3 = turn(c, d, a);
  const double o4 = turn(c, d, b);
  if (((o1 > 0.0 && o2 < 0.0) || (o1 < 0.0 && o2 > 0.0)) &&
      ((o3 > 0.0 && o4 < 0.0) || (o3 < 0.0 && o4 > 0.0))) {
    return true;
  }
  return (o1 == 0.0 && on_segment(a, b, c)) || (o2 == 0.0 && on_segment(a, b, d)) ||
         (o3 == 0.0 && on_segment(c, d, a)) || (o4 == 0.0 && on_segment(c, d, b));
}

bool segments_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double o1 = turn(a, b, c);
  const double o2 = turn(a, b, d);
  if (!((o1 > 0.0 && o2 < 0.0) || (o1 < 0.0 && o2 > 0.0))) {
    return false;
  }
  const double o3 = turn(c, d, a);
  const double o4 = turn(c, d, b);
  return (o3 > 0.0 && o4 < 0.0) || (o3 < 0.0 && o4 > 0.0);
}

bool is_monotone(std::span<const Vec2> chain) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    if (chain[i + 1].x < chain[i].x - fall_tolerance) {
      return false;
    }
  }
  return true;
}

/// No two edges of chain and bridge cross, touch or overlap, the common points of neighbours aside.
bool is_simple(std::span<const Vec2> chain) {
  const std::size_t n = chain.size();
  const auto next = [&](std::size_t i) { return i + 1 < n ? i + 1 : 0; };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = chain[i];
    const Vec2 b = chain[next(i)];
    const double low_x = std::min(a.x, b.x);
    const double high_x = std::max(a.x, b.x);
    // Neighbours may share their point only: turning straight back is an overlap.
    const Vec2 c = chain[next(next(i))];
    if (n > 2 && turn(a, b, c) == 0.0 && dot(b - a, c - b) <= 0.0) {
      return false;
    }
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) {
        continue;
      }
      const Vec2 d = chain[j];
      const Vec2 e = chain[next(j)];
      if (std::max(d.x, e.x) < low_x || std::min(d.x, e.x) > high_x) {
        continue;
      }
      if (segments_meet(a, b, d, e)) {
        return false;
      }
    }
  }
  return true;
}

/// Simple polygon of chain and bridge, with the queries that shortest paths inside it need.
class Polygon {
 public:
  explicit Polygon(std::span<const Vec2> corners) : corners_(corners) {}

  [[nodiscard]] bool contains(Vec2 p) const {
    bool inside = false;
    for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
      const Vec2 a = corners_[i];
      const Vec2 b = corners_[j];
      if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
        inside = !inside;
      }
    }
    return inside;
  }
  /// Whether the open segment from corner i to q lies inside; sides at either end don't count as crossed.
  [[nodiscard]] bool sees(std::size_t i, Vec2 q) const {
    const Vec2 p = corners_[i];
    for (std::size_t j = 0; j + 1 < corners_.size(); ++j) {
      if (segments_cross(p, q, corners_[j], corners_[j + 1])) {
        return false;
      }
    }
    return contains(0.5 * (p + q));
  }
  [[nodiscard]] bool neighbors(std::size_t i, std::size_t j) const { return i + 1 == j || j + 1 == i; }

 private:
  std::span<const Vec2> corners_;
};

/// Corners that see their nearest point of the bridge have h; from those, Dijkstra over pairs that see
/// each other reaches the others.
void shortest_in_polygon(std::span<const Vec2> chain, std::vector<double>& concavity) {
  const Polygon polygon(chain);
  const std::size_t n = chain.size();
  std::vector<std::size_t> hidden;
  std::vector<std::size_t> open(n);
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (std::size_t i = 1; i + 1 < n; ++i) {
    concavity[i] = chain[i].y;
    const Vec2 foot = nearest_on_segment(chain[i], chain.front(), chain.back());
    if (chain[i].y > 0.0 && !polygon.sees(i, foot)) {
      concavity[i] = INFINITY;
      hidden.push_back(i);
    }
  }
  while (!hidden.empty() && !open.empty()) {
    const auto nearest = std::min_element(open.begin(), open.end(), [&](std::size_t i, std::size_t j) {
      return concavity[i] != concavity[j] ? concavity[i] < concavity[j] : i < j;
    });
    const std::size_t u = *nearest;
    open.erase(nearest);
    std::erase(hidden, u);
    if (!std::isfinite(concavity[u])) {
      break;
    }
    for (const std::size_t w : hidden) {
      const double reached = concavity[u] + length(chain[w] - chain[u]);
      if (reached < concavity[w] && (polygon.neighbors(u, w) || polygon.sees(w, chain[u]))) {
        concavity[w] = reached;
      }
    }
  }
}

/// Positions of the convex hull of chain[first..last], ascending, both ends always among them.
std::vector<std::size_t> hull_positions(std::span<const Vec2> chain, std::size_t first, std::size_t last) {
  std::vector<std::size_t> order(last - first + 1);
  std::iota(order.begin(), order.end(), first);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const Vec2 p = chain[i];
    const Vec2 q = chain[j];
    return p.x != q.x ? p.x < q.x : (p.y != q.y ? p.y < q.y : i < j);
  });
  std::vector<std::size_t> hull;
  const auto half = [&](auto begin, auto end) {
    std::vector<std::size_t> stack;
    for (auto it = begin; it != end; ++it) {
      while (stack.size() >= 2 &&
             turn(chain[stack[stack.size() - 2]], chain[stack.back()], chain[*it]) <= 0.0) {
        stack.pop_back();
      }
      stack.push_back(*it);
    }
    hull.insert(hull.end(), stack.begin(), stack.end());
  };
  half(order.begin(), order.end());
  half(order.rbegin(), order.rend());
  hull.push_back(first);
  hull.push_back(last);
  std::sort(hull.begin(), hull.end());
  hull.erase(std::unique(hull.begin(), hull.end()), hull.end());
  return hull;
}

/// Where chain and bridge cross: corners of the chain's hull are as deep as their distance to the bridge, and
/// what lies between two of them has the line between these as a bridge of its own.
void hierarchy_of_bridges(std::span<const Vec2> chain, std::vector<double>& concavity) {
  struct Pocket {
    std::size_t first;
    std::size_t last;
    double base;
    int depth;
  };
  std::vector<Pocket> pockets{{0, chain.size() - 1, 0.0, 0}};
  while (!pockets.empty()) {
    const Pocket p = pockets.back();
    pockets.pop_back();
    const auto depth_of = [&](std::size_t i) {
      return p.base + distance_to_segment(chain[i], chain[p.first], chain[p.last]);
    };
    const std::vector<std::size_t> hull = hull_positions(chain, p.first, p.last);
    if (p.depth >= deepest_hierarchy || hull.size() <= 2) {
      for (std::size_t i = p.first + 1; i < p.last; ++i) {
        concavity[i] = depth_of(i);
      }
      continue;
    }
    for (const std::size_t i : hull) {
      if (i != p.first && i != p.last) {
        concavity[i] = depth_of(i);
      }
    }
    for (std::size_t k = 0; k + 1 < hull.size(); ++k) {
      if (hull[k + 1] > hull[k] + 1) {
        pockets.push_back(
            {hull[k], hull[k + 1], std::min(concavity[hull[k]], concavity[hull[k + 1]]), p.depth + 1});
      }
    }
  }
}

/// A corner of the new bridges, with the concavity of all pockets up to it.
struct Corner {
  std::size_t position;
  double concavity;
};

/// Residual concavities closer than this are equal: rounding of unit lengths.
constexpr double tie_tolerance = 1e-12;
/// The cap is measured along vertex normals, which jump where creases meet: a vertex beside the deepest one
/// with at least this share of its concavity may be the true bottom.
constexpr double near_tie = 0.95;
/// ... if it is deeper by this factor before the cap: one edge down a coarse slope, not noise on a smooth
/// one.
constexpr double clearly_deeper = 1.1;

/// Position 1..i where cutting chain[0..i] leaves least; ties go to the larger concavity.
std::size_t least_residual(std::span<const Vec2> chain, std::span<const double> prefix,
                           std::span<const double> concavity, std::size_t i) {
  std::vector<double> suffix;
  suffix_concavity(chain.first(i + 1), suffix);
  std::size_t best = 1;
  double least = std::max(prefix[1], suffix[1]);
  for (std::size_t k = 2; k <= i; ++k) {
    const double residual = std::max(prefix[k], suffix[k]);
    if (residual < least - tie_tolerance ||
        (residual <= least + tie_tolerance && concavity[k] > concavity[best])) {
      best = k;
      least = residual;
    }
  }
  return best;
}

/// The vertex of largest concavity, or the one beside it where that is nearly as deep and deeper before the
/// cap.
std::size_t deepest(std::span<const double> capped, std::span<const double> uncapped) {
  const auto top = static_cast<std::size_t>(std::max_element(capped.begin(), capped.end()) - capped.begin());
  std::size_t best = top;
  for (const std::size_t k : {top - 1, top + 1}) {
    if (k < capped.size() && capped[k] >= near_tie * capped[top] &&
        uncapped[k] > clearly_deeper * uncapped[best]) {
      best = k;
    }
  }
  return best;
}

/// Last position with prefix(1..i) below the tolerance, at least 1.
std::size_t last_shallow(std::span<const double> prefix, double tolerance) {
  std::size_t i = 1;
  while (i + 1 < prefix.size() && prefix[i + 1] < tolerance) {
    ++i;
  }
  return i;
}

/// Equal for equal parts; two different ones of a run agree with a probability of 2^-64.
std::uint64_t signature_of(std::span<const std::uint32_t> facets) {
  std::uint64_t sum = 0;
  for (const std::uint32_t f : facets) {
    sum += Random(f).next();
  }
  return sum;
}

}  // namespace

void project_valley(std::span<const Vec3> valley, std::vector<Vec2>& chain) {
  chain.resize(valley.size());
  const Vec3 a = valley.front();
  const Vec3 way = valley.back() - a;
  const double size = length(way);
  const Vec3 unit = size > 0.0 ? way / size : Vec3{};
  for (std::size_t i = 0; i < valley.size(); ++i) {
    const Vec3 p = valley[i] - a;
    const double t = dot(p, unit);
    chain[i] = {t, length(p - std::clamp(t, 0.0, size) * unit)};
  }
  chain.front() = {0.0, 0.0};
  chain.back() = {size, 0.0};
}

void chain_concavity(std::span<const Vec2> chain, std::vector<double>& concavity) {
  concavity.resize(chain.size());
  for (std::size_t i = 0; i < chain.size(); ++i) {
    concavity[i] = chain[i].y;
  }
  if (chain.size() < 3 || is_monotone(chain)) {
    return;
  }
  if (chain.size() <= longest_polygon && is_simple(chain)) {
    shortest_in_polygon(chain, concavity);
  } else {
    hierarchy_of_bridges(chain, concavity);
  }
  for (std::size_t i = 0; i < chain.size(); ++i) {
    // A point that rounding let nobody see keeps its distance to the bridge, the least it can be.
    concavity[i] = std::isfinite(concavity[i]) ? std::max(concavity[i], chain[i].y) : chain[i].y;
  }
}

void prefix_concavity(std::span<const Vec2> chain, std::vector<double>& prefix) {
  prefix.assign(chain.size(), 0.0);
  std::vector<Corner> stack;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vec2 q = chain[k];
    while (stack.size() >= 2) {
      const Vec2 s1 = chain[stack.back().position];
      const Vec2 s2 = chain[stack[stack.size() - 2].position];
      if (cross(s1 - s2, q - s2) > 0.0) {
        break;
      }
      stack.pop_back();
    }
    double pocket = 0.0;
    if (!stack.empty()) {
      const std::size_t top = stack.back().position;
      for (std::size_t i = top + 1; i < k; ++i) {
        pocket = std::max(pocket, distance_to_segment(chain[i], chain[top], q));
      }
      pocket = std::max(pocket, stack.back().concavity);
    }
    stack.push_back({k, pocket});
    prefix[k] = pocket;
  }
}

void suffix_concavity(std::span<const Vec2> chain, std::vector<double>& suffix) {
  std::vector<Vec2> mirrored(chain.rbegin(), chain.rend());
  for (Vec2& p : mirrored) {
    p.x = chain.back().x - p.x;
  }
  prefix_concavity(mirrored, suffix);
  std::reverse(suffix.begin(), suffix.end());
}

Separators find_separators(std::span<const Vec2> chain, std::span<const double> concavity,
                           std::span<const double> uncapped, double tolerance) {
  const std::size_t n = chain.size();
  std::vector<double> prefix;
  std::vector<double> suffix;
  prefix_concavity(chain, prefix);
  suffix_concavity(chain, suffix);
  double least = std::max(prefix[1], suffix[1]);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    least = std::min(least, std::max(prefix[k], suffix[k]));
  }
  Separators s;
  if (least < tolerance) {
    s.first = deepest(concavity, uncapped);
    s.last = s.first;
  } else {
    s.v_shaped = false;
    s.first = least_residual(chain, prefix, concavity, last_shallow(prefix, tolerance));
    // From the other end: everything mirrored.
    std::vector<Vec2> mirrored(chain.rbegin(), chain.rend());
    for (Vec2& p : mirrored) {
      p.x = chain.back().x - p.x;
    }
    const std::vector<double> mirrored_concavity(concavity.rbegin(), concavity.rend());
    std::reverse(suffix.begin(), suffix.end());
    s.last = n - 1 - least_residual(mirrored, suffix, mirrored_concavity, last_shallow(suffix, tolerance));
    if (s.last < s.first) {
      s.first = s.last = (s.first + s.last) / 2;
    }
  }
  s.first = std::clamp(s.first, std::size_t{1}, n - 2);
  s.last = std::clamp(s.last, std::size_t{1}, n - 2);
  return s;
}

Valleys::Valleys(const PartGraph& part) : part_(&part), search_(part) {}

void Valleys::select() {
  signature_ = signature_of(part_->facets());
}

/// Whether all its arcs and jumps exist on this part.
bool Valleys::survives(const Valley& valley) const {
  for (std::size_t i = 1; i < valley.steps.size(); ++i) {
    const std::uint32_t from = valley.steps[i - 1].vertex;
    const Step& step = valley.steps[i];
    if (step.arc == jump_arc ? !part_->jump_exists(from, step.vertex) : !part_->arc_exists(from, step.arc)) {
      return false;
    }
  }
  return true;
}

/// Fills chain_.
void Valleys::project(std::span<const Step> steps) {
  points_.clear();
  for (const Step& s : steps) {
    points_.push_back(part_->surface().points[s.vertex]);
  }
  project_valley(points_, chain_);
}

Valley Valleys::find(std::uint32_t from, std::uint32_t to, double tolerance, bool from_scratch) {
  Valley valley;
  if (found_->find(from, to, valley) || (others_ != nullptr && others_->find(from, to, valley))) {
    // A search on the same part would find the same valley again. From other parts only what is surely still
    // shortest is taken: where there are cut loops, a jump may be shorter than a deep valley.
    if (valley.part == signature_ ||
        (!from_scratch && !(valley.greatest > tolerance && part_->has_loops()) && survives(valley))) {
      return valley;
    }
  }
  valley = {};
  valley.length = search_.find(from, to, steps_);
  if (steps_.empty()) {
    return valley;
  }
  project(steps_);
  chain_concavity(chain_, concavity_);
  valley.steps = steps_;
  valley.concavity = concavity_;
  valley.greatest = *std::max_element(concavity_.begin(), concavity_.end());
  valley.part = signature_;
  found_->store(from, to, valley);
  return valley;
}

std::array<double, 2> Valleys::sub_valleys(const Valley& valley, std::span<const double> capped,
                                           double tolerance) {
  project(valley.steps);
  const Separators separators = find_separators(chain_, capped, valley.concavity, tolerance);
  double along = 0.0;
  double to_first = 0.0;
  double to_last = 0.0;
  for (std::size_t i = 1; i < valley.steps.size(); ++i) {
    const Step& step = valley.steps[i];
    along += step.arc == jump_arc ? length(points_[i] - points_[i - 1])
                                  : static_cast<double>(part_->arc(step.arc).length);
    to_first = i == separators.first ? along : to_first;
    to_last = i == separators.last ? along : to_last;
  }
  return {to_first, along - to_last};
}

}  // namespace ridgecraft::segment
