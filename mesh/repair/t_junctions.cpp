// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/t_junctions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/repair/border_points.hpp"
#include "mesh/repair/weld.hpp"

namespace ridgecraft::mesh {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Whether the line from a, `size` long, meets the box.
bool meets(Vec3 a, Vec3 along, double size, const Box3& box) {
  double first = 0.0;
  double last = size;
  const auto clip = [&](double from, double step, double low, double high) {
    if (step == 0.0) {
      return low <= from && from <= high;
    }
    const double s = (low - from) / step;
    const double t = (high - from) / step;
    first = std::max(first, std::min(s, t));
    last = std::min(last, std::max(s, t));
    return first <= last;
  };
  return clip(a.x, along.x, box.low.x, box.high.x) && clip(a.y, along.y, box.low.y, box.high.y) &&
         clip(a.z, along.z, box.low.z, box.high.z);
}

/// One pass: each triangle is divided at one side at most.
class Pass {
 public:
  Pass(TriangleList& list, const std::vector<EdgeUse>& uses, double distance)
      : list_(list), distance_(distance), reach_(list.points.size(), distance) {
    for_each_edge(uses, [&](std::size_t i, std::size_t j) {
      if (j - i == 1) {
        border_.push_back(uses[i]);
        edges_.emplace_back(uses[i].low, uses[i].high);
        points_.push_back(uses[i].low);
        points_.push_back(uses[i].high);
        const double near = near_of_edge * length(list_.points[uses[i].high] - list_.points[uses[i].low]);
        for (const std::uint32_t p : {uses[i].low, uses[i].high}) {
          reach_[p] = std::min(reach_[p], near);
        }
      }
    });
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  std::size_t run(const Context& context) {
    if (border_.empty()) {
      return 0;
    }
    const BorderPoints near(list_.points, points_, reach_);
    std::vector<bool> divided(list_.triangles.size(), false);
    std::size_t count = 0;
    for (std::size_t i = 0; i < border_.size(); ++i) {
      if (i % 256 == 0) {
        context.check();
      }
      if (!divided[border_[i].triangle]) {
        const std::vector<std::uint32_t> on = points_on(border_[i], near);
        if (closes_seam(border_[i], on)) {
          divided[border_[i].triangle] = true;
          divide(border_[i], on);
          count += on.size();
        }
      }
    }
    return count;
  }

 private:
  /// Border points strictly between the ends, in order from corner `side` on.
  [[nodiscard]] std::vector<std::uint32_t> points_on(const EdgeUse& use, const BorderPoints& near) const {
    const Triangle& t = list_.triangles[use.triangle];
    const Vec3 a = list_.points[t.points[use.side]];
    const Vec3 b = list_.points[t.points[(use.side + 1U) % 3]];
    const double size = length(b - a);
    if (!(size > 2.0 * distance_)) {
      return {};
    }
    const Vec3 along = (b - a) / size;
    std::vector<std::pair<double, std::uint32_t>> found;
    near.tree.search(
        [&](std::uint32_t node) {
          // Twice the reach: computed distances may be a little too small.
          const double reach = 2.0 * near.reach[node];
          const Box3& box = near.tree.box(node);
          const Vec3 wider{reach, reach, reach};
          return meets(a, along, size, {box.low - wider, box.high + wider});
        },
        [&](std::uint32_t place) {
          const std::uint32_t p = near.points[place];
          const double t_along = dot(list_.points[p] - a, along);
          if (std::find(t.points.begin(), t.points.end(), p) == t.points.end() && t_along > distance_ &&
              t_along < size - distance_ && length(list_.points[p] - a - t_along * along) <= reach_[p]) {
            found.emplace_back(t_along, p);
          }
        });
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> on;
    for (const auto& [place, p] : found) {
      on.push_back(p);
    }
    return on;
  }

  [[nodiscard]] bool is_border(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(edges_.begin(), edges_.end(), edge(a, b));
  }

  [[nodiscard]] bool closes_seam(const EdgeUse& use, const std::vector<std::uint32_t>& on) const {
    if (on.empty()) {
      return false;
    }
    const Triangle& t = list_.triangles[use.triangle];
    std::uint32_t from = t.points[use.side];
    for (const std::uint32_t p : on) {
      if (is_border(from, p)) {
        return true;
      }
      from = p;
    }
    return is_border(from, t.points[(use.side + 1U) % 3]);
  }

  void divide(const EdgeUse& use, const std::vector<std::uint32_t>& on) {
    const Triangle whole = list_.triangles[use.triangle];
    const std::size_t second = (use.side + 1U) % 3;
    Triangle part = whole;
    part.points[second] = on.front();
    list_.triangles[use.triangle] = part;
    for (std::size_t i = 0; i < on.size(); ++i) {
      part.points[use.side] = on[i];
      part.points[second] = i + 1 < on.size() ? on[i + 1] : whole.points[second];
      list_.triangles.push_back(part);
    }
  }

  TriangleList& list_;
  double distance_;
  std::vector<double> reach_;  ///< of each point of the list: how near to an edge it lies on it
  std::vector<EdgeUse> border_;
  std::vector<Edge> edges_;  ///< of the border, sorted as edge_uses() sorts
  std::vector<std::uint32_t> points_;
};

}  // namespace

std::size_t join_t_junctions(TriangleList& list, std::vector<EdgeUse>& uses, double distance,
                             const Context& context) {
  // Three sides need three passes; more are for parts of what was divided.
  constexpr int passes = 6;
  std::size_t count = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const std::size_t now = Pass(list, uses, distance).run(context);
    if (now == 0) {
      break;
    }
    uses = edge_uses(list.triangles);
    count += now;
  }
  return count;
}

}  // namespace ridgecraft::mesh
