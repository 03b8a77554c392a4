// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/polygon_list.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/delaunay.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "base/order.hpp"

namespace ridgecraft::mesh {

std::vector<EdgeUse> edge_uses(std::span<const Triangle> triangles) {
  std::vector<EdgeUse> uses(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t].points[k];
      const std::uint32_t to = triangles[t].points[(k + 1U) % 3];
      uses[3 * t + k] = {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t), k, from < to};
    }
  }
  return in_edge_order(std::span<const EdgeUse>(uses));
}

namespace {

/// A quad that is folded by more than this along either diagonal crosses itself (seen along any direction).
constexpr double crossed_fold = 150.0 * std::numbers::pi / 180.0;
/// Bends that differ by less are the same; then the better triangles decide.
constexpr double same_fold = 1.0 * std::numbers::pi / 180.0;

/// Twice the vector area (Newell): its direction is the mean normal, zero for what has no area or covers none
/// in sum.
Vec3 doubled_area(const std::vector<Vec3>& p) {
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < p.size(); ++k) {
    sum += cross(p[k] - p[0], p[k + 1] - p[0]);
  }
  return sum;
}

/// Greatest distance of a corner from the plane through the corners' mean.
double bend(const std::vector<Vec3>& p, Vec3 normal) {
  Vec3 mean;
  for (const Vec3 q : p) {
    mean += q;
  }
  mean = mean / static_cast<double>(p.size());
  double greatest = 0.0;
  for (const Vec3 q : p) {
    greatest = std::max(greatest, std::abs(dot(q - mean, normal)));
  }
  return greatest;
}

/// Smallest height over longest side, a measure of shape between 0 and 0.87.
double shape(Vec3 a, Vec3 b, Vec3 c) {
  const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  return longest > 0.0 ? length(cross(b - a, c - a)) / longest : 0.0;
}

/// What splitting a quad into (a, b, c) and (a, c, d) would give.
struct Split {
  double fold;   ///< angle between the halves
  double shape;  ///< of the worse half
  bool taken;    ///< the diagonal is an edge of the model already
};

Split judge(Vec3 a, Vec3 b, Vec3 c, Vec3 d, bool taken) {
  // Half of the smallest shape that still has an area in the sense of repair.
  constexpr double no_area = 1e-9;
  const Vec3 n = cross(b - a, c - a);
  const Vec3 m = cross(c - a, d - a);
  const double worse = std::min(shape(a, b, c), shape(a, c, d));
  const double fold = worse > no_area ? elementary::atan2(length(cross(n, m)), dot(n, m)) : 0.0;
  return {fold, worse, taken};
}

bool better(const Split& a, const Split& b) {
  constexpr double no_area = 1e-9;
  const bool a_crossed = a.fold > crossed_fold || a.shape <= no_area;
  const bool b_crossed = b.fold > crossed_fold || b.shape <= no_area;
  if (a_crossed != b_crossed) {
    return b_crossed;
  }
  if (a.taken != b.taken) {
    return b.taken;
  }
  if (std::abs(a.fold - b.fold) > same_fold) {
    return a.fold < b.fold;
  }
  // Equal up to rounding: the first, so that the corner that comes first decides.
  return a.shape > b.shape * (1.0 + 1e-9);
}

class Triangulator {
 public:
  Triangulator(PolygonList list, double flat, RepairReport& report)
      : list_(std::move(list)), flat_(flat), report_(report) {
    collect_edges();
  }

  TriangleList run(const Context& context) {
    result_.triangles.reserve(list_.corners.size() - 2 * list_.size());
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (i % 1024 == 0) {
        context.check();
      }
      const std::size_t n = list_.polygon(i).size();
      if (n == 3) {
        emit(i, 0, 1, 2);
      } else if (n == 4) {
        quad(i);
      } else {
        large(i);
      }
    }
    result_.points = std::move(list_.points);
    result_.reversed_copy = std::move(list_.reversed_copy);
    return std::move(result_);
  }

 private:
  using Edge = std::array<std::uint32_t, 2>;

  void collect_edges() {
    bool needed = false;
    for (std::size_t i = 0; i < list_.size() && !needed; ++i) {
      needed = list_.polygon(i).size() == 4;
    }
    if (!needed) {
      return;
    }
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const auto p = list_.polygon(i);
      for (std::size_t k = 0; k < p.size(); ++k) {
        const std::uint32_t q = p[(k + 1) % p.size()];
        edges_.push_back({std::min(p[k], q), std::max(p[k], q)});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }

  [[nodiscard]] bool is_edge(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(edges_.begin(), edges_.end(), Edge{std::min(a, b), std::max(a, b)}) ||
           diagonals_.contains(key(a, b));
  }

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b);
  }

  [[nodiscard]] std::vector<Vec3> places(std::size_t i) const {
    std::vector<Vec3> p;
    for (const std::uint32_t v : list_.polygon(i)) {
      p.push_back(list_.points[v]);
    }
    return p;
  }

  void emit(std::size_t i, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t first = list_.first[i];
    const auto& v = list_.corners;
    const auto& t = list_.textures;
    result_.triangles.push_back({{v[first + a], v[first + b], v[first + c]},
                                 {t[first + a], t[first + b], t[first + c]},
                                 list_.origin[i],
                                 list_.two_sided[i] != 0,
                                 false});
  }

  void remark_bend(std::size_t i, const std::vector<Vec3>& p, Vec3 normal) {
    if (bend(p, normal) > flat_) {
      report_.add(RepairKind::bent_polygons_split, 1, first_polygon(list_.origin[i]));
    }
  }

  void quad(std::size_t i) {
    const auto v = list_.polygon(i);
    const std::vector<Vec3> p = places(i);
    if (v[0] == v[2] || v[1] == v[3]) {  // there and back: what is left is no area at all
      report_.add(RepairKind::crossed_polygons_rebuilt, 1, first_polygon(list_.origin[i]));
      return;
    }
    const Split one = judge(p[0], p[1], p[2], p[3], is_edge(v[0], v[2]));
    const Split two = judge(p[1], p[2], p[3], p[0], is_edge(v[1], v[3]));
    const bool second = better(two, one);
    const Split& chosen = second ? two : one;
    if (chosen.fold > crossed_fold) {
      report_.add(RepairKind::crossed_polygons_rebuilt, 1, first_polygon(list_.origin[i]));
      return;
    }
    remark_bend(i, p, normalized(doubled_area(p)));
    if (second) {
      emit(i, 1, 2, 3);
      emit(i, 1, 3, 0);
      take(v[1], v[3]);
    } else {
      emit(i, 0, 1, 2);
      emit(i, 0, 2, 3);
      take(v[0], v[2]);
    }
  }

  /// A diagonal that is in use, so that the other side of a flat quad gets the other one.
  void take(std::uint32_t a, std::uint32_t b) { diagonals_.insert(key(a, b)); }

  void large(std::size_t i) {
    const auto v = list_.polygon(i);
    const std::vector<Vec3> p = places(i);
    const Vec3 normal = normalized(doubled_area(p));
    const PlaneFrame frame(p[0], normal);
    // A point that the outline visits twice is one point of the plane.
    std::vector<std::uint32_t> order(v.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) {
      order[k] = k;
    }
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return v[a] != v[b] ? v[a] < v[b] : a < b; });
    std::vector<std::uint32_t> corner(v.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool again = k > 0 && v[order[k]] == v[order[k - 1]];
      corner[order[k]] = again ? corner[order[k - 1]] : order[k];
    }
    std::vector<Vec2> flat;
    std::vector<std::array<std::uint32_t, 2>> sides;
    for (std::uint32_t k = 0; k < v.size(); ++k) {
      flat.push_back(frame.flat(p[k]));
      sides.push_back({corner[k], corner[(k + 1) % v.size()]});
    }
    auto triangles = triangulate_inside(flat, sides);
    if (!triangles || triangles->empty()) {
      report_.add(RepairKind::crossed_polygons_rebuilt, 1, first_polygon(list_.origin[i]));
      return;
    }
    std::sort(triangles->begin(), triangles->end());
    remark_bend(i, p, normal);
    for (const auto& t : *triangles) {
      emit(i, t[0], t[1], t[2]);
    }
  }

  PolygonList list_;
  double flat_;
  RepairReport& report_;
  std::vector<Edge> edges_;
  std::unordered_set<std::uint64_t> diagonals_;  ///< asked only whether it contains something
  TriangleList result_;
};

}  // namespace

TriangleList triangulate(PolygonList list, double flat, RepairReport& report, const Context& context) {
  return Triangulator(std::move(list), flat, report).run(context);
}

Surface surface_of(const std::vector<Vec3>& points, const std::vector<std::array<std::uint32_t, 3>>& faces) {
  std::vector<std::uint32_t> number(points.size(), Soup::none);
  for (const auto& face : faces) {
    for (const std::uint32_t p : face) {
      number[p] = 0;
    }
  }
  std::vector<Vec3> used;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == 0) {
      number[i] = static_cast<std::uint32_t>(used.size());
      used.push_back(points[i]);
    }
  }
  std::vector<std::array<VertexId, 3>> numbered;
  numbered.reserve(faces.size());
  for (const auto& [a, b, c] : faces) {
    numbered.push_back({VertexId(number[a]), VertexId(number[b]), VertexId(number[c])});
  }
  return Surface(std::move(used), std::move(numbered));
}

}  // namespace ridgecraft::mesh
