// SPDX-License-Identifier: GPL-3.0-or-later
// The concavity that is reported, measured once more by slow and simple code of its own: gift wrapping,
// Dijkstra on an explicit graph of the part, distances by the definitions in docs/design/segmentation.md,
// "Rules".
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "segment/concavity/valleys.hpp"
#include "segment/segment.hpp"
#include "segment/surface/scaled_surface.hpp"
#include "segmented.hpp"
#include "support/concave_shapes.hpp"
#include "support/shapes.hpp"

namespace ridgecraft {
namespace {

using test::tolerance;
/// How far openings may be, whatever the tolerance.
constexpr double opening_scale = 0.1;

constexpr double infinite = std::numeric_limits<double>::infinity();
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// One part of a surface in general position (no four points in a plane, no two equal paths).
class SlowMeasure {
 public:
  SlowMeasure(const mesh::Surface& surface, const segment::Segmentation& s, PartId part)
      : surface_(surface), segmentation_(s), part_(part) {
    const auto ball = segment::smallest_enclosing_ball(surface.points());
    for (const Vec3 p : surface.points()) {
      points_.push_back((p - ball.center) / ball.radius);
    }
    std::set<std::uint32_t> used;
    for (const FaceId f : s.parts[part].faces) {
      for (const VertexId v : surface.vertices(f)) {
        used.insert(v.value());
      }
    }
    vertices_.assign(used.begin(), used.end());
    build_graph();
    find_cut_loops();
    find_normals();
    wrap();
  }

  [[nodiscard]] double concavity() {
    double greatest = 0.0;
    std::set<Edge> bridges;
    for (const auto& [a, b, c] : hull_) {
      bridges.insert(std::minmax(a, b));
      bridges.insert(std::minmax(b, c));
      bridges.insert(std::minmax(c, a));
    }
    for (const auto& [a, b] : bridges) {
      const double jump = jump_length(a, b);
      if (arcs_[a].count(b) == 0 && !std::isfinite(jump)) {
        greatest = std::max(greatest, valley_concavity(shortest_path(a, b)));
      }
    }
    return greatest;
  }
  /// Times that an opening made a vertex less deep.
  [[nodiscard]] std::size_t openings() const { return openings_; }
  [[nodiscard]] std::size_t hull_vertex_count() const {
    std::set<std::uint32_t> used;
    for (const auto& f : hull_) {
      used.insert(f.begin(), f.end());
    }
    return used.size();
  }

 private:
  [[nodiscard]] bool inside(FaceId f) const { return f.valid() && segmentation_.part[f] == part_; }

  void add_arc(std::uint32_t a, std::uint32_t b, double length) {
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, a}}) {
      const auto [it, fresh] = arcs_[from].try_emplace(to, length);
      if (!fresh) {
        it->second = std::min(it->second, length);
      }
    }
  }

  void build_graph() {
    for (const FaceId f : segmentation_.parts[part_].faces) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(f, k);
        const std::uint32_t a = surface_.vertex(c).value();
        const std::uint32_t b = surface_.vertex(mesh::next(c)).value();
        add_arc(a, b, length(points_[b] - points_[a]));
        if (!inside(surface_.neighbor(c))) {
          continue;
        }
        const std::uint32_t p = surface_.vertex(mesh::previous(c)).value();
        const std::uint32_t q = surface_.vertex(mesh::previous(surface_.twin(c))).value();
        // Unfold: a at the origin, b on the x axis, p above, q below.
        const Vec3 along = normalized(points_[b] - points_[a]);
        const auto flat = [&](std::uint32_t v) {
          const double x = dot(points_[v] - points_[a], along);
          return Vec2{x, length(points_[v] - points_[a] - x * along)};
        };
        const Vec2 fp = flat(p);
        const Vec2 fq = flat(q);
        const double x = fp.x + (fq.x - fp.x) * fp.y / (fp.y + fq.y);
        const double size = length(points_[b] - points_[a]);
        const Vec3 crossing = points_[a] + x * along;
        const Vec3 way = points_[q] - points_[p];
        const double t = std::fmin(1.0, std::fmax(0.0, dot(crossing - points_[p], way) / dot(way, way)));
        const double sagitta = length(crossing - points_[p] - t * way);
        if (x > 0.0 && x < size && sagitta <= 0.25 * tolerance) {
          add_arc(p, q, std::hypot(fp.x - fq.x, fp.y + fq.y));
        }
      }
    }
  }

  void find_cut_loops() {
    std::map<std::uint32_t, std::set<std::uint32_t>> cut;
    for (const FaceId f : segmentation_.parts[part_].faces) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(f, k);
        if (surface_.neighbor(c).valid() && !inside(surface_.neighbor(c))) {
          const std::uint32_t a = surface_.vertex(c).value();
          const std::uint32_t b = surface_.vertex(mesh::next(c)).value();
          cut[a].insert(b);
          cut[b].insert(a);
        }
      }
    }
    int loops = 0;
    for (const auto& [start, around] : cut) {
      if (loop_.count(start) != 0) {
        continue;
      }
      std::vector<std::uint32_t> stack{start};
      loop_[start] = loops;
      while (!stack.empty()) {
        const std::uint32_t v = stack.back();
        stack.pop_back();
        for (const std::uint32_t w : cut[v]) {
          if (loop_.try_emplace(w, loops).second) {
            stack.push_back(w);
          }
        }
      }
      ++loops;
    }
  }

  void find_normals() {
    for (const std::uint32_t v : vertices_) {
      Vec3 sum;
      for (const CornerId c : surface_.corners_at(VertexId(v))) {
        const Vec3 p = points_[surface_.vertex(mesh::next(c)).value()] - points_[v];
        const Vec3 q = points_[surface_.vertex(mesh::previous(c)).value()] - points_[v];
        sum += std::atan2(length(cross(p, q)), dot(p, q)) * normalized(cross(p, q));
      }
      normals_[v] = normalized(sum);
    }
  }

  [[nodiscard]] double jump_length(std::uint32_t a, std::uint32_t b) {
    if (loop_.count(a) == 0 || loop_.count(b) == 0 || loop_[a] != loop_[b]) {
      return INFINITY;
    }
    const Vec3 way = normalized(points_[b] - points_[a]);
    return dot(normals_[a], way) <= 0.3 && -dot(normals_[b], way) <= 0.3 ? length(points_[b] - points_[a])
                                                                         : infinite;
  }

  /// Gift wrapping.
  void wrap() {
    std::set<Edge> open;
    std::set<Edge> done;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      hull_.push_back({a, b, c});
      for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
        done.insert({from, to});
        open.erase({from, to});
        if (done.count({to, from}) == 0) {
          open.insert({to, from});
        }
      }
    };
    const auto beyond = [&](std::uint32_t a, std::uint32_t b) {
      std::uint32_t best = a;
      for (const std::uint32_t c : vertices_) {
        if (c == a || c == b) {
          continue;
        }
        if (best == a ||
            dot(cross(points_[b] - points_[a], points_[best] - points_[a]), points_[c] - points_[a]) > 0.0) {
          best = c;
        }
      }
      return best;
    };
    // First edge: of the shadow on the xy plane, through its leftmost point.
    std::uint32_t a = vertices_.front();
    for (const std::uint32_t v : vertices_) {
      a = points_[v].x < points_[a].x ? v : a;
    }
    std::uint32_t b = a;
    for (const std::uint32_t v : vertices_) {
      const auto flat = [&](std::uint32_t w) {
        return Vec2{points_[w].x - points_[a].x, points_[w].y - points_[a].y};
      };
      if (v != a && (b == a || cross(flat(b), flat(v)) < 0.0)) {
        b = v;
      }
    }
    add(a, b, beyond(a, b));
    while (!open.empty()) {
      const auto [from, to] = *open.begin();
      add(from, to, beyond(from, to));
      REQUIRE(hull_.size() < 2 * vertices_.size());
    }
  }

  std::vector<std::uint32_t> shortest_path(std::uint32_t from, std::uint32_t to) {
    std::map<std::uint32_t, double> distance{{from, 0.0}};
    std::map<std::uint32_t, std::uint32_t> before;
    std::set<std::pair<double, std::uint32_t>> queue{{0.0, from}};
    const auto relax = [&](std::uint32_t v, std::uint32_t w, double key) {
      const auto known = distance.find(w);
      if (known == distance.end() || key < known->second) {
        if (known != distance.end()) {
          queue.erase({known->second, w});
        }
        distance[w] = key;
        before[w] = v;
        queue.insert({key, w});
      }
    };
    while (!queue.empty()) {
      const auto [key, v] = *queue.begin();
      queue.erase(queue.begin());
      if (v == to) {
        break;
      }
      for (const auto& [w, arc] : arcs_[v]) {
        relax(v, w, key + arc);
      }
      if (loop_.count(v) != 0) {
        for (const auto& [w, loop] : loop_) {
          const double jump = w == v ? infinite : jump_length(v, w);
          if (std::isfinite(jump)) {
            relax(v, w, key + jump);
          }
        }
      }
    }
    std::vector<std::uint32_t> path{to};
    while (path.back() != from) {
      path.push_back(before.at(path.back()));
    }
    return {path.rbegin(), path.rend()};
  }

  double depth_along_normal(std::uint32_t v) {
    double depth = INFINITY;
    for (const auto& [a, b, c] : hull_) {
      if (v == a || v == b || v == c) {
        return 0.0;
      }
      const Vec3 n = normalized(cross(points_[b] - points_[a], points_[c] - points_[a]));
      const double cosine = dot(n, normals_[v]);
      if (cosine > 1e-9) {
        depth = std::fmin(depth, std::fmax(0.0, dot(n, points_[a] - points_[v])) / cosine);
      }
    }
    return depth;
  }

  /// Beside an opening: a facet that the surface doesn't turn its back on, of a hull eight times as thick as
  /// an opening may be far.
  double depth_beside_opening(std::uint32_t v) {
    double depth = INFINITY;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      if (thickness_.size() == i) {
        thickness_.push_back(thickness(i));
      }
      const Vec3 n = normal(i);
      if (dot(n, normals_[v]) > -0.3 && thickness_[i] >= 8.0 * opening_scale) {
        depth = std::fmin(depth, std::fmax(0.0, dot(n, points_[hull_[i][0]] - points_[v])));
      }
    }
    return depth;
  }
  [[nodiscard]] Vec3 normal(std::size_t i) const {
    const auto& [a, b, c] = hull_[i];
    return normalized(cross(points_[b] - points_[a], points_[c] - points_[a]));
  }
  [[nodiscard]] double thickness(std::size_t i) const {
    double thickness = 0.0;
    for (const std::uint32_t w : vertices_) {
      thickness = std::fmax(thickness, dot(normal(i), points_[hull_[i][0]] - points_[w]));
    }
    return thickness;
  }

  double hull_depth(std::uint32_t v) {
    const double along = depth_along_normal(v);
    const double beside = depth_beside_opening(v);
    openings_ += beside <= opening_scale && beside < along ? 1U : 0U;
    return beside <= opening_scale ? std::fmin(beside, along) : along;
  }

  double valley_concavity(const std::vector<std::uint32_t>& path) {
    std::vector<Vec3> valley;
    for (const std::uint32_t v : path) {
      valley.push_back(points_[v]);
    }
    std::vector<Vec2> chain;
    std::vector<double> depth;
    segment::project_valley(valley, chain);
    segment::chain_concavity(chain, depth);
    double greatest = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      greatest = std::max(greatest, std::fmin(depth[i], hull_depth(path[i])));
    }
    return greatest;
  }

  const mesh::Surface& surface_;
  const segment::Segmentation& segmentation_;
  PartId part_;
  std::vector<double> thickness_;  ///< of the hull's triangles, as far as it was asked for
  std::size_t openings_ = 0;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> vertices_;
  std::map<std::uint32_t, std::map<std::uint32_t, double>> arcs_;
  std::map<std::uint32_t, int> loop_;
  std::map<std::uint32_t, Vec3> normals_;
  std::vector<std::array<std::uint32_t, 3>> hull_;
};

/// Moves every point a little, so that nothing is in a plane and no two paths are equally long.
mesh::Surface roughened(const mesh::Surface& surface) {
  Random random(11);
  const double size = 1e-3 * surface.bounds().diagonal();
  return test::mapped(surface, [&](Vec3 p) {
    return p + size * Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
  });
}

}  // namespace

TEST_CASE("What is reported is what a slow and independent measurement finds") {
  const std::vector<mesh::Surface> shapes{
      test::voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 4),
      test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}}, 3),
      test::torus(1.0, 0.3, 12, 32),
      test::star_shaped([](Vec3 p) { return 1.0 + 0.35 * std::sin(4.0 * p.x) * std::cos(5.0 * p.y); }, 40,
                        20),
      test::spiked_sphere(4, 0.05, 40, 20),
      test::uneven_cup()};
  std::size_t parts = 0;
  std::size_t openings = 0;
  for (const mesh::Surface& smooth : shapes) {
    const mesh::Surface surface = roughened(smooth);
    const auto s = segment::segment(surface, {}, {tolerance}, Context{});
    for (const PartId id : ids<PartId>(s.parts.size())) {
      CAPTURE(parts, id.value(), s.parts[id].faces.size());
      if (s.parts[id].faces.size() < 3) {
        continue;
      }
      SlowMeasure slow(surface, s, id);
      CHECK(slow.hull_vertex_count() == s.parts[id].hull_vertices.size());
      const double concavity = slow.concavity();
      CHECK(concavity <= tolerance + 1e-6);
      CHECK(concavity == Approx(s.parts[id].concavity).margin(1e-5));
      ++parts;
      openings += slow.openings();
    }
  }
  CHECK(parts > 12);
  CHECK(openings > 0);
}

TEST_CASE("The concavity of a part is its own, whatever tolerance it was found with") {
  for (const mesh::Surface& surface : {test::uneven_cup(), test::torus(1.0, 0.3, 12, 32)}) {
    std::vector<double> known;
    for (const double limit : {2.0, 0.5, 0.2, 0.1, 0.07}) {
      const auto s = segment::segment(surface, {}, {limit}, Context{});
      CHECK(s.max_concavity() <= limit);
      if (s.parts.size() == 1) {
        known.push_back(s.max_concavity());
        CHECK(known.back() == Approx(known.front()).epsilon(0.01));
      }
    }
    CHECK(known.size() >= 2);
  }
}

}  // namespace ridgecraft
