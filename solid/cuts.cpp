// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "base/disjoint_sets.hpp"
#include "base/no_index.hpp"
#include "base/rays.hpp"
#include "solid/hulls.hpp"

namespace ridgecraft::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct Number {
  std::uint32_t v = no_index;
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Plane = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>, CGAL::Exact_predicates_tag>;

bool before(Vec3 a, Vec3 b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

class Clipper {
 public:
  Clipper(const Body& body, const HalfSpace& half)
      : body_(body), half_(half), kept_(body.points.size(), no_index) {
    for (const Vec3 p : body.points) {
      outside_.push_back(dot(half.normal, p) - half.offset);
    }
  }

  Body run() {
    for (const auto& triangle : body_.triangles) {
      clip(triangle);
    }
    cap();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_in(std::uint32_t v) const { return outside_[v] < 0.0; }

  std::uint32_t keep(std::uint32_t v) {
    if (kept_[v] == no_index) {
      kept_[v] = static_cast<std::uint32_t>(result_.points.size());
      result_.points.push_back(body_.points[v]);
    }
    return kept_[v];
  }

  /// Where the plane meets the edge of a point within and one without.
  std::uint32_t meeting(std::uint32_t in, std::uint32_t out) {
    if (outside_[out] == 0.0) {
      return keep(out);
    }
    const auto [at, fresh] = on_edge_.try_emplace(std::minmax(in, out), 0);
    if (fresh) {
      // From the same end for both sides of the plane.
      const bool turned = before(body_.points[out], body_.points[in]);
      const std::uint32_t a = turned ? out : in;
      const std::uint32_t b = turned ? in : out;
      const double t = outside_[a] / (outside_[a] - outside_[b]);
      at->second = static_cast<std::uint32_t>(result_.points.size());
      result_.points.push_back(body_.points[a] + t * (body_.points[b] - body_.points[a]));
    }
    return at->second;
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) {
      result_.triangles.push_back({a, b, c});
    }
  }

  void clip(const std::array<std::uint32_t, 3>& t) {
    const int in = (is_in(t[0]) ? 1 : 0) + (is_in(t[1]) ? 1 : 0) + (is_in(t[2]) ? 1 : 0);
    if (in == 0) {
      return;
    }
    if (in == 3) {
      add(keep(t[0]), keep(t[1]), keep(t[2]));
      return;
    }
    // First the corner that is alone on its side.
    unsigned k = 0;
    while (is_in(t[k]) != (in == 1)) {
      ++k;
    }
    const std::uint32_t a = t[k];
    const std::uint32_t b = t[(k + 1) % 3];
    const std::uint32_t c = t[(k + 2) % 3];
    if (in == 1) {
      const std::uint32_t ab = meeting(a, b);
      const std::uint32_t ac = meeting(a, c);
      add(keep(a), ab, ac);
      border(ab, ac);
    } else {
      const std::uint32_t ab = meeting(b, a);
      const std::uint32_t ac = meeting(c, a);
      add(ab, keep(b), keep(c));
      add(ab, keep(c), ac);
      border(ab, ac);
    }
  }

  /// An edge of the cap; what comes twice is none.
  void border(std::uint32_t a, std::uint32_t b) {
    if (a != b) {
      const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(a, b);
      if (!border_.insert(edge).second) {
        border_.erase(edge);
      }
    }
  }

  void cap() {
    if (border_.size() < 3) {
      return;
    }
    const std::array<double, 3> n{std::fabs(half_.normal.x), std::fabs(half_.normal.y),
                                  std::fabs(half_.normal.z)};
    const auto axis = static_cast<unsigned>(std::max_element(n.begin(), n.end()) - n.begin());
    const auto flat = [&](Vec3 p) {
      const std::array<double, 3> c{p.x, p.y, p.z};
      return Kernel::Point_2(c[(axis + 1) % 3], c[(axis + 2) % 3]);
    };
    Plane plane;
    std::map<std::uint32_t, Plane::Vertex_handle> vertices;
    const auto vertex = [&](std::uint32_t v) {
      const auto [at, fresh] = vertices.try_emplace(v);
      if (fresh) {
        at->second = plane.insert(flat(result_.points[v]));
        at->second->info().v = v;
      }
      return at->second;
    };
    for (const auto& [first, second] : border_) {
      const Plane::Vertex_handle a = vertex(first);
      const Plane::Vertex_handle b = vertex(second);
      if (a != b) {
        plane.insert_constraint(a, b);
      }
    }
    if (plane.dimension() < 2) {
      return;
    }
    mark(plane);
    for (auto f = plane.finite_faces_begin(); f != plane.finite_faces_end(); ++f) {
      if (f->info() % 2 == 1) {
        std::array<std::uint32_t, 3> corners{};
        for (int k = 0; k < 3; ++k) {
          corners[static_cast<std::size_t>(k)] = number(f->vertex(k), axis);
        }
        // Triangles turn to the left as seen from along the axis.
        const std::array<double, 3> along{half_.normal.x, half_.normal.y, half_.normal.z};
        if (along[axis] < 0.0) {
          std::swap(corners[1], corners[2]);
        }
        add(corners[0], corners[1], corners[2]);
      }
    }
  }

  /// How many times each face is surrounded.
  static void mark(Plane& plane) {
    for (auto f = plane.all_faces_begin(); f != plane.all_faces_end(); ++f) {
      f->info() = -1;
    }
    std::vector<std::pair<Plane::Face_handle, int>> open{{plane.infinite_face(), 0}};
    std::vector<std::pair<Plane::Face_handle, int>> next;
    while (!open.empty()) {
      while (!open.empty()) {
        const auto [face, depth] = open.back();
        open.pop_back();
        if (face->info() != -1) {
          continue;
        }
        face->info() = depth;
        for (int k = 0; k < 3; ++k) {
          if (face->neighbor(k)->info() == -1) {
            const bool is_border = face->is_constrained(k);
            (is_border ? next : open).emplace_back(face->neighbor(k), is_border ? depth + 1 : depth);
          }
        }
      }
      std::swap(open, next);
    }
  }

  /// Where borders cross there is a point that none of them had.
  std::uint32_t number(Plane::Vertex_handle v, unsigned axis) {
    const Kernel::Point_2 p = v->point();
    const std::uint32_t known = v->info().v;
    if (known < result_.points.size()) {
      const Vec3 q = result_.points[known];
      const std::array<double, 3> c{q.x, q.y, q.z};
      if (c[(axis + 1) % 3] == p.x() && c[(axis + 2) % 3] == p.y()) {
        return known;
      }
    }
    std::array<double, 3> c{};
    const std::array<double, 3> n{half_.normal.x, half_.normal.y, half_.normal.z};
    c[(axis + 1) % 3] = p.x();
    c[(axis + 2) % 3] = p.y();
    c[axis] = (half_.offset - n[(axis + 1) % 3] * p.x() - n[(axis + 2) % 3] * p.y()) / n[axis];
    v->info().v = static_cast<std::uint32_t>(result_.points.size());
    result_.points.push_back({c[0], c[1], c[2]});
    return v->info().v;
  }

  const Body& body_;
  HalfSpace half_;
  std::vector<double> outside_;
  std::vector<std::uint32_t> kept_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> on_edge_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> border_;
  Body result_;
};

/// Planes across each axis that are tried, and those of the largest flat sides.
constexpr int places = 5;
constexpr std::size_t sides_tried = 10;
/// The volume of a hull is that of its farthest points in so many directions, where it is only compared.
constexpr std::size_t directions = 32;
/// How much the air that is left in one piece counts beside what all have: cutting out what is hollow frees
/// nothing before the last cut.
constexpr double unevenness = 0.1;
/// A plane that leaves less of the body on one side than this share of its diagonal cuts nothing off.
constexpr double shallow = 1e-3;
/// Sides are in one plane whose normals and offsets (over the diagonal) are alike to one part in so many.
constexpr double alike_normals = 200.0;
constexpr double alike_offsets = 500.0;

double volume_of(const Body& body) {
  return std::fabs(mass_properties(body).volume);
}

/// A solid and how much larger its hull is.
struct Piece {
  Body solid;
  double air = 0.0;
};

class PlaneCutter {
 public:
  explicit PlaneCutter(const Context& context) : context_(context) {
    for (std::size_t i = 0; i < directions; ++i) {
      directions_[i] = even_direction(static_cast<int>(i), static_cast<int>(directions));
    }
  }

  std::vector<Body> run(const Body& solid, double air, std::size_t most) {
    const double allowed = air * volume_of(solid);
    std::vector<Piece> pieces = with_air(solid);
    for (;;) {
      double all = 0.0;
      std::size_t worst = 0;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        all += pieces[i].air;
        worst = pieces[i].air > pieces[worst].air ? i : worst;
      }
      if (all <= allowed || pieces.size() >= most || !cut(pieces, worst)) {
        break;
      }
    }
    std::vector<Body> result;
    for (Piece& piece : pieces) {
      result.push_back(std::move(piece.solid));
    }
    return result;
  }

 private:
  static Box3 box_of(const Body& body) {
    Box3 box;
    for (const Vec3 p : body.points) {
      box.add(p);
    }
    return box;
  }

  /// Of the hull of the farthest points.
  [[nodiscard]] double air_of(const Body& body) const {
    std::vector<Vec3> farthest;
    if (body.points.size() <= directions) {
      farthest = body.points;
    } else {
      for (const Vec3 d : directions_) {
        std::size_t best = 0;
        double reach = -INFINITY;
        for (std::size_t i = 0; i < body.points.size(); ++i) {
          if (const double x = dot(d, body.points[i]); x > reach) {
            reach = x;
            best = i;
          }
        }
        farthest.push_back(body.points[best]);
      }
    }
    return std::fmax(0.0, hull_volume(farthest, context_) - volume_of(body));
  }

  [[nodiscard]] std::vector<Piece> with_air(const Body& body) const {
    std::vector<Piece> pieces;
    for (Body& piece : pieces_of(body)) {
      context_.check();
      pieces.push_back({std::move(piece), 0.0});
      pieces.back().air = air_of(pieces.back().solid);
    }
    return pieces;
  }

  [[nodiscard]] std::vector<Piece> cut_by(const Body& body, const HalfSpace& half) const {
    std::vector<Piece> pieces = with_air(clipped(body, half));
    for (Piece& piece : with_air(clipped(body, {-1.0 * half.normal, -half.offset}))) {
      pieces.push_back(std::move(piece));
    }
    return pieces;
  }

  [[nodiscard]] std::vector<HalfSpace> candidates(const Body& body) const {
    std::vector<HalfSpace> planes;
    const Box3 box = box_of(body);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      for (int i = 1; i <= places; ++i) {
        const double share = static_cast<double>(i) / (places + 1);
        planes.push_back({axis, (1.0 - share) * dot(axis, box.low) + share * dot(axis, box.high)});
      }
    }
    // Flat sides, by their area; those of the hull cut nothing off.
    const double diagonal = length(box.size());
    std::map<std::array<long, 4>, std::pair<double, HalfSpace>> sides;
    for (const auto& [a, b, c] : body.triangles) {
      const Vec3 normal = cross(body.points[b] - body.points[a], body.points[c] - body.points[a]);
      const double area = length(normal);
      if (!(area > 0.0)) {
        continue;
      }
      Vec3 n = (1.0 / area) * normal;
      if (before(n, Vec3{})) {
        n = -1.0 * n;
      }
      const double offset = dot(n, body.points[a]);
      const std::array<long, 4> key{std::lround(alike_normals * n.x), std::lround(alike_normals * n.y),
                                    std::lround(alike_normals * n.z),
                                    std::lround(alike_offsets * offset / diagonal)};
      auto& side = sides.try_emplace(key, 0.0, HalfSpace{n, offset}).first->second;
      side.first += area;
    }
    std::vector<std::pair<double, HalfSpace>> order;
    for (const auto& [key, side] : sides) {
      order.push_back(side);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    const std::size_t enough = planes.size() + sides_tried;
    for (std::size_t i = 0; i < std::min(order.size(), 4 * sides_tried) && planes.size() < enough; ++i) {
      const HalfSpace& half = order[i].second;
      double low = INFINITY;
      double high = -INFINITY;
      for (const Vec3 p : body.points) {
        low = std::fmin(low, dot(half.normal, p) - half.offset);
        high = std::fmax(high, dot(half.normal, p) - half.offset);
      }
      if (low < -shallow * diagonal && high > shallow * diagonal) {
        planes.push_back(half);
      }
    }
    return planes;
  }

  bool cut(std::vector<Piece>& pieces, std::size_t which) {
    std::vector<Piece> best;
    double least = INFINITY;
    for (const HalfSpace& half : candidates(pieces[which].solid)) {
      std::vector<Piece> sides = cut_by(pieces[which].solid, half);
      double all = 0.0;
      double largest = 0.0;
      for (const Piece& side : sides) {
        all += side.air;
        largest = std::fmax(largest, side.air);
      }
      if (sides.size() > 1 && all + unevenness * largest < least) {
        least = all + unevenness * largest;
        best = std::move(sides);
      }
    }
    if (best.empty()) {
      return false;
    }
    pieces[which] = std::move(best.front());
    for (std::size_t i = 1; i < best.size(); ++i) {
      pieces.push_back(std::move(best[i]));
    }
    return true;
  }

  const Context& context_;
  std::array<Vec3, directions> directions_{};
};

}  // namespace

std::vector<Body> cut_by_planes(const Body& solid, double air, std::size_t most, const Context& context) {
  return PlaneCutter(context).run(solid, air, most);
}

Body clipped(const Body& solid, const HalfSpace& half) {
  return Clipper(solid, half).run();
}

std::vector<Body> pieces_of(const Body& body) {
  DisjointSets sets(body.points.size());
  for (const auto& [a, b, c] : body.triangles) {
    sets.join(a, b);
    sets.join(b, c);
  }
  std::map<std::uint32_t, std::size_t> place;
  std::vector<Body> pieces;
  std::vector<std::uint32_t> number(body.points.size(), no_index);
  for (const auto& triangle : body.triangles) {
    const auto [at, fresh] = place.try_emplace(sets.find(triangle[0]), pieces.size());
    if (fresh) {
      pieces.emplace_back();
    }
    Body& piece = pieces[at->second];
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& n = number[triangle[k]];
      if (n == no_index) {
        n = static_cast<std::uint32_t>(piece.points.size());
        piece.points.push_back(body.points[triangle[k]]);
      }
      corners[k] = n;
    }
    piece.triangles.push_back(corners);
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Body& a, const Body& b) { return a.triangles.size() > b.triangles.size(); });
  return pieces;
}

}  // namespace ridgecraft::solid
