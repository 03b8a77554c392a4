// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/t_junctions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/point_cells.hpp"

namespace ridgecraft::mesh {
namespace {

/// Steps along one edge when looking for points; longer edges are left alone rather than taking all the time.
constexpr double most_steps = 10000.0;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// One pass: each triangle is divided at one side at most.
class Pass {
 public:
  Pass(TriangleList& list, double distance) : list_(list), distance_(distance) {
    const std::vector<EdgeUse> uses = edge_uses(list.triangles);
    for_each_edge(uses, [&](std::size_t i, std::size_t j) {
      if (j - i == 1) {
        border_.push_back(uses[i]);
        edges_.emplace_back(uses[i].low, uses[i].high);
        points_.push_back(uses[i].low);
        points_.push_back(uses[i].high);
        total_ += length(list_.points[uses[i].high] - list_.points[uses[i].low]);
      }
    });
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
  }

  std::size_t run(const Context& context) {
    if (border_.empty()) {
      return 0;
    }
    cell_ = std::max(total_ / static_cast<double>(border_.size()), 2.0 * distance_);
    const PointCells cells(list_.points, points_, cell_);
    std::vector<bool> divided(list_.triangles.size(), false);
    std::size_t count = 0;
    for (std::size_t i = 0; i < border_.size(); ++i) {
      if (i % 256 == 0) {
        context.check();
      }
      if (!divided[border_[i].triangle]) {
        const std::vector<std::uint32_t> on = points_on(border_[i], cells);
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
  [[nodiscard]] std::vector<std::uint32_t> points_on(const EdgeUse& use, const PointCells& cells) const {
    const Triangle& t = list_.triangles[use.triangle];
    const Vec3 a = list_.points[t.points[use.side]];
    const Vec3 b = list_.points[t.points[(use.side + 1U) % 3]];
    const double size = length(b - a);
    if (!(size > 2.0 * distance_) || size > most_steps * cell_) {
      return {};
    }
    const Vec3 along = (b - a) / size;
    std::vector<std::pair<double, std::uint32_t>> found;
    const double steps = std::ceil(size / cell_);
    for (double step = 0.0; step <= steps; step += 1.0) {
      cells.near(a + step / steps * (b - a), [&](std::uint32_t p) {
        const double t_along = dot(list_.points[p] - a, along);
        if (std::find(t.points.begin(), t.points.end(), p) == t.points.end() && t_along > distance_ &&
            t_along < size - distance_ && length(list_.points[p] - a - t_along * along) <= distance_) {
          found.emplace_back(t_along, p);
        }
      });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
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
  double cell_ = 1.0;
  double total_ = 0.0;
  std::vector<EdgeUse> border_;
  std::vector<Edge> edges_;  ///< of the border, sorted as edge_uses() sorts
  std::vector<std::uint32_t> points_;
};

}  // namespace

std::size_t join_t_junctions(TriangleList& list, double distance, const Context& context) {
  // Three sides need three passes; more are for parts of what was divided.
  constexpr int passes = 6;
  std::size_t count = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const std::size_t now = Pass(list, distance).run(context);
    if (now == 0) {
      break;
    }
    count += now;
  }
  return count;
}

}  // namespace ridgecraft::mesh
