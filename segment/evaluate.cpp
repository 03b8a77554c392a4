// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "segment/hull/hull.hpp"
#include "segment/hull/pockets.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {
namespace {

struct Interval {
  double low;
  double high;
};

/// Adds the intervals in which rays run inside a hull to their lists.
void add_hull(const Hull& hull, std::span<const Vec3> points, const RayGrid& grid,
              std::vector<std::vector<Interval>>& along) {
  std::vector<Interval> inside(grid.cell_count(), {INFINITY, -INFINITY});
  for (const auto& corners : hull.triangles) {
    const Vec3 a = points[corners[0]];
    const Vec3 b = points[corners[1]];
    const Vec3 c = points[corners[2]];
    grid.for_rays_near(a, b, c, [&](std::uint32_t ray, double u, double v) {
      const double w = 1.0 - u - v;
      if (u < 0.0 || v < 0.0 || w < 0.0) {
        return;
      }
      const double z = u * a.z + v * b.z + w * c.z;
      inside[ray] = {std::min(inside[ray].low, z), std::max(inside[ray].high, z)};
    });
  }
  for (std::size_t ray = 0; ray < inside.size(); ++ray) {
    if (inside[ray].low < inside[ray].high) {
      along[ray].push_back(inside[ray]);
    }
  }
}

constexpr double unreached = std::numeric_limits<double>::infinity();

/// A labeling with its labels replaced by 0, 1, 2 ... in the order of their values.
struct Parts {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};

Parts compact(std::span<const std::uint32_t> labels) {
  std::vector<std::uint32_t> values(labels.begin(), labels.end());
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  Parts parts;
  parts.count = static_cast<std::uint32_t>(values.size());
  parts.of.reserve(labels.size());
  for (const std::uint32_t label : labels) {
    const auto at = std::lower_bound(values.begin(), values.end(), label);
    parts.of.push_back(static_cast<std::uint32_t>(at - values.begin()));
  }
  return parts;
}

/// What a part of one labeling and a part of the other share.
struct Common {
  std::uint32_t a;
  std::uint32_t b;
  double weight;
};

/// The pairs of parts that share something, with the weights of the items added up.
std::vector<Common> common_weights(const Parts& a, const Parts& b, std::span<const double> weight) {
  std::vector<Common> items;
  items.reserve(weight.size());
  for (std::size_t i = 0; i < weight.size(); ++i) {
    items.push_back({a.of[i], b.of[i], weight[i]});
  }
  // Stable, so that weights are added in the items' order whatever the labels are called.
  std::stable_sort(items.begin(), items.end(), [](const Common& x, const Common& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  std::vector<Common> sums;
  for (const Common& item : items) {
    if (!sums.empty() && sums.back().a == item.a && sums.back().b == item.b) {
      sums.back().weight += item.weight;
    } else {
      sums.push_back(item);
    }
  }
  return sums;
}

std::vector<double> part_weights(const Parts& parts, std::span<const double> weight) {
  std::vector<double> sums(parts.count, 0.0);
  for (std::size_t i = 0; i < weight.size(); ++i) {
    sums[parts.of[i]] += weight[i];
  }
  return sums;
}

double pairs(double n) {
  return 0.5 * n * (n - 1.0);
}

double rand_error_of(const Parts& a, const Parts& b) {
  const std::vector<double> ones(a.of.size(), 1.0);
  double differ = 0.0;
  for (const double n : part_weights(a, ones)) {
    differ += pairs(n);
  }
  for (const double n : part_weights(b, ones)) {
    differ += pairs(n);
  }
  for (const Common& c : common_weights(a, b, ones)) {
    differ -= 2.0 * pairs(c.weight);
  }
  return differ / pairs(static_cast<double>(ones.size()));
}

/// Hamming distance and consistency errors from the parts' areas.
void compare_areas(const Parts& a, const Parts& b, std::span<const double> area, Disagreement& result) {
  const std::vector<double> of_a = part_weights(a, area);
  const std::vector<double> of_b = part_weights(b, area);
  const double total = std::accumulate(of_a.begin(), of_a.end(), 0.0);
  if (!(total > 0.0)) {
    return;
  }
  const std::vector<double> ones(area.size(), 1.0);
  const std::vector<Common> shared_area = common_weights(a, b, area);
  const std::vector<Common> shared_count = common_weights(a, b, ones);
  std::vector<double> most_of_a(a.count, 0.0);
  std::vector<double> most_of_b(b.count, 0.0);
  double outside_b = 0.0;
  double outside_a = 0.0;
  double nearer = 0.0;
  for (std::size_t i = 0; i < shared_area.size(); ++i) {
    const Common& c = shared_area[i];
    most_of_a[c.a] = std::max(most_of_a[c.a], c.weight);
    most_of_b[c.b] = std::max(most_of_b[c.b], c.weight);
    const double a_left = of_a[c.a] > 0.0 ? 1.0 - c.weight / of_a[c.a] : 0.0;
    const double b_left = of_b[c.b] > 0.0 ? 1.0 - c.weight / of_b[c.b] : 0.0;
    outside_b += shared_count[i].weight * a_left;
    outside_a += shared_count[i].weight * b_left;
    nearer += shared_count[i].weight * std::min(a_left, b_left);
  }
  const double covered = std::accumulate(most_of_a.begin(), most_of_a.end(), 0.0) +
                         std::accumulate(most_of_b.begin(), most_of_b.end(), 0.0);
  const auto n = static_cast<double>(area.size());
  result.hamming = std::max(0.0, 1.0 - 0.5 * covered / total);
  result.global_consistency = std::max(0.0, std::min(outside_a, outside_b) / n);
  result.local_consistency = std::max(0.0, nearer / n);
}

/// Vertices of the edges between parts, ascending.
std::vector<std::uint32_t> cut_vertices(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                        std::span<const std::uint32_t> label) {
  std::vector<std::uint32_t> vertices;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [one, other] = surface.sides(e);
    if (other.valid() &&
        label[polygon[mesh::face_of(one).value()]] != label[polygon[mesh::face_of(other).value()]]) {
      vertices.push_back(surface.vertex(one).value());
      vertices.push_back(surface.vertex(mesh::next(one)).value());
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Length of the shortest way along edges from each vertex to the nearest of some (Dijkstra).
std::vector<double> distances(const mesh::Surface& surface, std::span<const std::uint32_t> from) {
  std::vector<double> distance(surface.vertex_count(), unreached);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const std::uint32_t v : from) {
    distance[v] = 0.0;
    open.push({0.0, v});
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) {
      continue;
    }
    for (const CornerId c : surface.corners_at(VertexId(v))) {
      // Both sides at the corner, since at a border an edge belongs to one face only.
      for (const CornerId side : {c, mesh::previous(c)}) {
        const VertexId w = side == c ? surface.vertex(mesh::next(c)) : surface.vertex(side);
        const double reached = d + surface.length(surface.edge(side));
        if (reached < distance[w.value()]) {
          distance[w.value()] = reached;
          open.push({reached, w.value()});
        }
      }
    }
  }
  return distance;
}

/// Mean distance of the faces' centres from the centroid of the surface, weighted by area.
double mean_radius(const mesh::Surface& surface) {
  const auto center = [&](FaceId f) {
    const auto [a, b, c] = surface.vertices(f);
    return (1.0 / 3.0) * (surface.point(a) + surface.point(b) + surface.point(c));
  };
  Vec3 centroid{0.0, 0.0, 0.0};
  double area = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    centroid = centroid + surface.area(f) * center(f);
    area += surface.area(f);
  }
  if (!(area > 0.0)) {
    return 0.0;
  }
  centroid = (1.0 / area) * centroid;
  double sum = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    sum += surface.area(f) * length(center(f) - centroid);
  }
  return sum / area;
}

double sum_at(std::span<const double> value, std::span<const std::uint32_t> where) {
  double sum = 0.0;
  for (const std::uint32_t v : where) {
    sum += value[v];
  }
  return sum;
}

std::optional<double> cut_discrepancy(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                      std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  const std::vector<std::uint32_t> on_a = cut_vertices(surface, polygon, a);
  const std::vector<std::uint32_t> on_b = cut_vertices(surface, polygon, b);
  if (on_a.empty() && on_b.empty()) {
    return 0.0;
  }
  const double radius = mean_radius(surface);
  if (on_a.empty() || on_b.empty() || !(radius > 0.0)) {
    return std::nullopt;
  }
  const double sum = sum_at(distances(surface, on_b), on_a) + sum_at(distances(surface, on_a), on_b);
  const double mean = sum / static_cast<double>(on_a.size() + on_b.size());
  return mean < unreached ? std::optional(mean / radius) : std::nullopt;
}

}  // namespace

double enclosed_volume(const mesh::Surface& surface) {
  if (surface.face_count() == 0) {
    return 0.0;
  }
  const Vec3 origin = surface.bounds().low + 0.5 * surface.bounds().size();
  double sum = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    sum += dot(surface.point(a) - origin, cross(surface.point(b) - origin, surface.point(c) - origin));
  }
  return sum / 6.0;
}

double hull_volume_ratio(const mesh::Surface& surface, std::span<const std::uint32_t> label, unsigned rays,
                         const Context& context) {
  RIDGECRAFT_ASSERT(label.size() == surface.face_count());
  const double enclosed = enclosed_volume(surface);
  if (!(enclosed > 0.0)) {
    return 0.0;
  }
  const ScaledSurface scaled = scale_surface(surface, {});
  std::map<std::uint32_t, std::vector<std::uint32_t>> vertices;
  for (std::uint32_t f = 0; f < label.size(); ++f) {
    auto& list = vertices[label[f]];
    list.insert(list.end(), scaled.corners[f].begin(), scaled.corners[f].end());
  }
  const RayGrid grid(rays);
  std::vector<std::vector<Interval>> along(grid.cell_count());
  HullBuilder builder(scaled.points);
  Hull hull;
  for (auto& [part, list] : vertices) {
    context.check();
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    builder.build(list, hull);
    add_hull(hull, scaled.points, grid, along);
  }
  double sum = 0.0;
  for (auto& intervals : along) {
    sum += union_length(intervals);
  }
  return sum * grid.step() * grid.step() * scaled.unit * scaled.unit * scaled.unit / enclosed;
}

double rand_error(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  RIDGECRAFT_ASSERT(a.size() == b.size());
  return a.size() < 2 ? 0.0 : rand_error_of(compact(a), compact(b));
}

Disagreement compare(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                     std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  RIDGECRAFT_ASSERT(polygon.size() == surface.face_count() && a.size() == b.size());
  const Parts parts_a = compact(a);
  const Parts parts_b = compact(b);
  std::vector<double> area(a.size(), 0.0);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    area[polygon[f.value()]] += surface.area(f);
  }
  Disagreement result;
  result.rand_error = a.size() < 2 ? 0.0 : rand_error_of(parts_a, parts_b);
  compare_areas(parts_a, parts_b, area, result);
  result.cut_discrepancy = cut_discrepancy(surface, polygon, a, b);
  return result;
}

}  // namespace ridgecraft::segment
