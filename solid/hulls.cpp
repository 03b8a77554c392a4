// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/hulls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

/// Half the thickness of a part without volume, as a share of the surface's diagonal: thick enough for the
/// tolerances of physics engines, too thin to be seen.
constexpr double least_thickness = 5e-5;

std::vector<Vec3> part_points(const mesh::Surface& surface, const segment::Part& part) {
  std::vector<VertexId> vertices;
  for (const FaceId f : part.faces) {
    for (const VertexId v : surface.vertices(f)) {
      vertices.push_back(v);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Vec3> points;
  for (const VertexId v : vertices) {
    points.push_back(surface.point(v));
  }
  return points;
}

/// A corner nearer to the hull than this share of its size isn't worth a plane.
constexpr double near_enough = 1e-6;
/// Each round adds a point for each side that has any beyond it: about ten are enough.
constexpr unsigned most_rounds = 64;

/// A bounded convex polyhedron by the loops of its faces.
struct Polytope {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> loops;
};

Polytope polytope_of(const Box& box) {
  Polytope body;
  for (unsigned i = 0; i < 8; ++i) {
    body.points.push_back(box.corner(i));
  }
  body.loops = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return body;
}

/// Cuts a polytope by a half space.
class Clip {
 public:
  Clip(const Polytope& body, const HalfSpace& half)
      : body_(body), kept_(body.points.size(), std::numeric_limits<std::uint32_t>::max()) {
    for (const Vec3 p : body.points) {
      outside_.push_back(dot(half.normal, p) - half.offset);
    }
  }

  /// What is left; none where rounding leaves no closed polytope.
  std::optional<Polytope> run() {
    for (std::size_t i = 0; i < body_.points.size(); ++i) {
      if (outside_[i] <= 0.0) {
        kept_[i] = add(body_.points[i]);
      }
    }
    for (const auto& loop : body_.loops) {
      clip_face(loop);
    }
    return close() ? std::optional(std::move(result_)) : std::nullopt;
  }

 private:
  std::uint32_t add(Vec3 p) {
    result_.points.push_back(p);
    return static_cast<std::uint32_t>(result_.points.size() - 1);
  }

  /// Where the plane meets an edge.
  std::uint32_t cut_point(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const auto at = on_edge_.find({low, high});
    if (at != on_edge_.end()) {
      return at->second;
    }
    const double t = outside_[low] / (outside_[low] - outside_[high]);
    return on_edge_[{low, high}] = add(body_.points[low] + t * (body_.points[high] - body_.points[low]));
  }

  void clip_face(const std::vector<std::uint32_t>& loop) {
    std::vector<std::uint32_t> rest;
    std::optional<std::uint32_t> leaves;
    std::optional<std::uint32_t> enters;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i];
      const std::uint32_t b = loop[(i + 1) % loop.size()];
      if (outside_[a] <= 0.0) {
        rest.push_back(kept_[a]);
      }
      if ((outside_[a] <= 0.0) != (outside_[b] <= 0.0)) {
        rest.push_back(cut_point(a, b));
        (outside_[a] <= 0.0 ? leaves : enters) = rest.back();
      }
    }
    if (leaves && enters) {
      cap_[*enters] = *leaves;
    }
    if (rest.size() >= 3) {
      result_.loops.push_back(std::move(rest));
    }
  }

  /// Adds the face in the plane. Returns false where its edges form no single loop.
  bool close() {
    std::vector<std::uint32_t> loop;
    for (auto at = cap_.begin(); at != cap_.end() && loop.size() < cap_.size(); at = cap_.find(at->second)) {
      loop.push_back(at->first);
    }
    if (loop.size() < 3 || loop.size() != cap_.size()) {
      return false;
    }
    result_.loops.push_back(std::move(loop));
    return true;
  }

  const Polytope& body_;
  Polytope result_;
  std::vector<double> outside_;      ///< per point of the body
  std::vector<std::uint32_t> kept_;  ///< per point of the body: in the result
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> on_edge_;  ///< cut points
  std::map<std::uint32_t, std::uint32_t> cap_;  ///< the new face's edges, against the old faces' direction
};

/// The point of a triangle that is nearest to p (Ericson, "Real-Time Collision Detection", 2005,
/// section 5.1.5).
Vec3 nearest_in_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const double square = dot(n, n);
  if (square > 0.0) {
    const double u = dot(n, cross(b - p, c - p)) / square;
    const double v = dot(n, cross(c - p, a - p)) / square;
    const double w = 1.0 - u - v;
    if (u >= 0.0 && v >= 0.0 && w >= 0.0) {
      return u * a + v * b + w * c;
    }
  }
  Vec3 best = nearest_on_segment(p, a, b);
  for (const Vec3 q : {nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)}) {
    best = length(q - p) < length(best - p) ? q : best;
  }
  return best;
}

Vec3 nearest_on(const Body& hull, Vec3 p) {
  Vec3 best = hull.points.front();
  for (const auto& [a, b, c] : hull.triangles) {
    const Vec3 q = nearest_in_triangle(p, hull.points[a], hull.points[b], hull.points[c]);
    best = length(q - p) < length(best - p) ? q : best;
  }
  return best;
}

/// The half space with this outer normal that the hull touches from inside.
HalfSpace touching(const Body& hull, Vec3 normal) {
  double offset = -std::numeric_limits<double>::infinity();
  for (const Vec3 p : hull.points) {
    offset = std::fmax(offset, dot(normal, p));
  }
  return {normal, offset};
}

/// Clips what is around the hull where it stands out farthest, as long as it has few vertices enough.
Polytope clipped_to(const Body& hull, Polytope body, std::size_t max_vertices, const Context& context) {
  const double size = length(body.points[7] - body.points[0]);
  std::map<std::array<double, 3>, Vec3> nearest;  // corners live through many cuts
  while (true) {
    context.check();
    Vec3 farthest{0.0, 0.0, 0.0};
    double distance = 0.0;
    for (const Vec3 corner : body.points) {
      const auto [at, fresh] = nearest.try_emplace({corner.x, corner.y, corner.z});
      if (fresh) {
        context.check();
        at->second = nearest_on(hull, corner);
      }
      const Vec3 away = corner - at->second;
      if (length(away) > distance) {
        distance = length(away);
        farthest = away;
      }
    }
    if (distance <= near_enough * size) {
      return body;
    }
    auto smaller = Clip(body, touching(hull, (1.0 / distance) * farthest)).run();
    if (!smaller || smaller->points.size() > max_vertices) {
      return body;
    }
    body = std::move(*smaller);
  }
}

/// More of the hull's triangles as sides hardly make the box smaller.
constexpr std::size_t most_sides = 128;
/// A box must be smaller by this share to be preferred: boxes along the coordinate axes stay so.
constexpr double saving = 1e-9;

Box box_along(const std::array<Vec3, 3>& axes, const Body& hull) {
  Box box{axes, {}};
  for (const Vec3 p : hull.points) {
    box.along.add({dot(axes[0], p), dot(axes[1], p), dot(axes[2], p)});
  }
  return box;
}

Vec3 doubled_area(const Body& hull, const std::array<std::uint32_t, 3>& t) {
  return cross(hull.points[t[1]] - hull.points[t[0]], hull.points[t[2]] - hull.points[t[0]]);
}

}  // namespace

std::vector<Body> part_hulls(const mesh::Surface& surface, const segment::Segmentation& parts,
                             const HullOptions& options, const Context& context) {
  const double thickness = least_thickness * surface.bounds().diagonal();
  std::vector<Body> bodies;
  for (const segment::Part& part : parts.parts) {
    context.check();
    const std::vector<Vec3> points = part_points(surface, part);
    Body hull = convex_hull(points, thickness, context);
    if (options.max_vertices != 0 && hull.points.size() > options.max_vertices) {
      hull = enclosing_polytope(hull, options.max_vertices, context);
    }
    bodies.push_back(std::move(hull));
  }
  return bodies;
}

Body nearly_convex_hull(std::span<const Vec3> points, double tolerance, double thickness,
                        const Context& context) {
  const auto [low_x, high_x] = std::minmax_element(points.begin(), points.end(), [](Vec3 a, Vec3 b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  std::vector<Vec3> chosen{*low_x, *high_x};
  std::vector<Vec3> open(points.begin(), points.end());
  for (unsigned round = 0; round < most_rounds; ++round) {
    context.check();
    Body hull = convex_hull(chosen, thickness, context);
    std::vector<HalfSpace> sides;
    for (const auto& t : hull.triangles) {
      const Vec3 normal = normalized(doubled_area(hull, t));
      sides.push_back({normal, dot(normal, hull.points[t[0]])});
    }
    std::vector<std::pair<double, Vec3>> farthest(sides.size(), {tolerance, {}});
    std::erase_if(open, [&](Vec3 p) {
      std::size_t best = 0;
      double distance = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const double d = dot(sides[i].normal, p) - sides[i].offset;
        if (d > distance) {
          distance = d;
          best = i;
        }
      }
      if (distance > farthest[best].first) {
        farthest[best] = {distance, p};
      }
      return distance <= tolerance;
    });
    if (open.empty()) {
      return hull;
    }
    for (const auto& [distance, p] : farthest) {
      if (distance > tolerance) {
        chosen.push_back(p);
      }
    }
  }
  return convex_hull(points, thickness, context);
}

Body enclosing_polytope(const Body& hull, std::size_t max_vertices, const Context& context) {
  RIDGECRAFT_ASSERT(max_vertices >= 8);
  Body best;
  double least = std::numeric_limits<double>::infinity();
  // With few planes the box is what counts, with many either may lead to the better ones.
  for (const Box& box : {box_along_axes(hull), smallest_box(hull, context)}) {
    const Polytope body = clipped_to(hull, polytope_of(box), max_vertices, context);
    Body candidate = convex_hull(body.points, near_enough * length(box.along.size()), context);
    grow_until_enclosing(candidate, hull.points, context);
    if (const double volume = mass_properties(candidate).volume; volume < least) {
      least = volume;
      best = std::move(candidate);
    }
  }
  return best;
}

Vec3 Box::corner(unsigned i) const {
  const double x = (i & 1U) != 0 ? along.high.x : along.low.x;
  const double y = (i & 2U) != 0 ? along.high.y : along.low.y;
  const double z = (i & 4U) != 0 ? along.high.z : along.low.z;
  return x * axes[0] + y * axes[1] + z * axes[2];
}

double Box::volume() const {
  const Vec3 size = along.size();
  return size.x * size.y * size.z;
}

Box box_along_axes(const Body& hull) {
  return box_along({Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}, hull);
}

Box smallest_box(const Body& hull, const Context& context) {
  Box best = box_along_axes(hull);
  std::vector<std::size_t> order(hull.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> area;
  for (const auto& t : hull.triangles) {
    area.push_back(length(doubled_area(hull, t)));
  }
  const std::size_t sides = std::min(most_sides, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(sides), order.end(),
      [&](std::size_t a, std::size_t b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
  for (std::size_t i = 0; i < sides; ++i) {
    context.check();
    const auto& t = hull.triangles[order[i]];
    const Vec3 normal = normalized(doubled_area(hull, t));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = normalized(hull.points[t[(k + 1) % 3]] - hull.points[t[k]]);
      if (normal == Vec3{} || edge == Vec3{}) {
        continue;
      }
      const Box box = box_along({edge, normalized(cross(normal, edge)), normal}, hull);
      if (box.volume() < (1.0 - saving) * best.volume()) {
        best = box;
      }
    }
  }
  return best;
}

}  // namespace ridgecraft::solid
