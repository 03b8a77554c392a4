// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <type_traits>

#include <CGAL/Constrained_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#ifdef CGAL_DISABLE_GMP
#include <CGAL/Lazy_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost_mp.h>
#endif

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/order.hpp"
#include "base/random.hpp"

namespace ridgecraft::prepare {
namespace {

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;  ///< for points of the input
#ifndef CGAL_DISABLE_GMP
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;  ///< for points that are found
#else
/// Without GMP (wasm/) CGAL's own choice are fractions that nobody reduces: they grow beyond all doubles,
/// where CGAL divides infinity by infinity.
using Exact = CGAL::Lazy_kernel<CGAL::Simple_cartesian<boost::multiprecision::cpp_rational>>;
#endif

constexpr std::uint32_t none = 0xffffffffU;
/// Pairs of triangles, and rays, between two questions whether to stop.
constexpr std::size_t pairs_per_check = 1U << 12U;

using Corners = std::array<std::uint32_t, 3>;

Filtered::Point_3 filtered(Vec3 p) {
  return {p.x, p.y, p.z};
}
Exact::Point_3 exact(Vec3 p) {
  return {p.x, p.y, p.z};
}
/// The double nearest to an exact number, the lower of two. CGAL::to_double depends on how far the number was
/// computed before and on the library that computes exactly; the same model is to give the same points
/// everywhere.
double nearest(const Exact::FT& number) {
  const auto& exact = number.exact();
  using Number = std::decay_t<decltype(exact)>;
  const double near = CGAL::to_double(exact);
  double best = near;
  Number least = abs(Number(exact - Number(near)));
  for (const double other : {std::nextafter(near, -INFINITY), std::nextafter(near, INFINITY)}) {
    const Number distance = abs(Number(exact - Number(other)));
    if (distance < least || (distance == least && other < best)) {
      best = other;
      least = distance;
    }
  }
  return best;
}
Vec3 rounded(const Exact::Point_3& p) {
  return {nearest(p.x()), nearest(p.y()), nearest(p.z())};
}

Box3 box_of(const std::vector<Vec3>& points, const Corners& t) {
  Box3 box;
  for (const std::uint32_t p : t) {
    box.add(points[p]);
  }
  return box;
}

/// The axis along which a plane is looked at, and whether it is seen from behind: coordinates in the plane
/// are two of space, so they are exact.
struct View {
  int axis = 2;
  bool behind = false;

  template <class Point>
  [[nodiscard]] auto first(const Point& p) const {
    return p[behind ? (axis + 2) % 3 : (axis + 1) % 3];
  }
  template <class Point>
  [[nodiscard]] auto second(const Point& p) const {
    return p[behind ? (axis + 1) % 3 : (axis + 2) % 3];
  }
};

/// Seen from where the normal points to; the normal needn't be exact but for its largest coordinate's sign.
View view_along(Vec3 normal) {
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  if (size.x >= size.y && size.x >= size.z) {
    return {0, normal.x < 0.0};
  }
  return size.y >= size.z ? View{1, normal.y < 0.0} : View{2, normal.z < 0.0};
}

/// How two triangles with given corners (by place) meet beyond what they share as neighbours.
class Contacts {
 public:
  explicit Contacts(const std::vector<Vec3>& points) : points_(points) {
    Box3 box;
    std::for_each(points.begin(), points.end(), [&](Vec3 p) { box.add(p); });
    diagonal_ = box.diagonal();
  }

  [[nodiscard]] bool has_area(const Corners& t) const {
    return t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && !CGAL::collinear(at(t[0]), at(t[1]), at(t[2]));
  }

  /// Do they share more than a corner or a side? Both have an area.
  [[nodiscard]] bool meet(const Corners& f, const Corners& g) const {
    Corners own_f, own_g;  // those shared first
    const std::size_t shared = split(f, g, own_f, own_g);
    switch (shared) {
      case 0:
        return !beside_plane(f, g) && !beside_plane(g, f) && CGAL::do_intersect(triangle(f), triangle(g));
      case 1:
        return !beside_plane(f, g) && !beside_plane(g, f) && meet_beyond_corner(own_f, own_g);
      case 2:
        return CGAL::orientation(at(f[0]), at(f[1]), at(f[2]), at(own_g[2])) == CGAL::COPLANAR &&
               CGAL::coplanar_orientation(at(own_f[0]), at(own_f[1]), at(own_f[2]), at(own_g[2])) ==
                   CGAL::POSITIVE;
      default:
        return true;
    }
  }
  [[nodiscard]] static bool share_a_corner(const Corners& f, const Corners& g) {
    return std::any_of(f.begin(), f.end(),
                       [&](std::uint32_t p) { return p == g[0] || p == g[1] || p == g[2]; });
  }

 private:
  [[nodiscard]] Filtered::Point_3 at(std::uint32_t p) const { return filtered(points_[p]); }
  [[nodiscard]] Filtered::Triangle_3 triangle(const Corners& t) const {
    return {at(t[0]), at(t[1]), at(t[2])};
  }

  static std::size_t split(const Corners& f, const Corners& g, Corners& own_f, Corners& own_g) {
    std::size_t shared = 0;
    std::size_t last = 3;
    for (const std::uint32_t p : f) {
      const bool both = p == g[0] || p == g[1] || p == g[2];
      (both ? own_f[shared++] : own_f[--last]) = p;
    }
    std::size_t n = 0;
    last = 3;
    for (const std::uint32_t p : g) {
      const bool both = p == f[0] || p == f[1] || p == f[2];
      (both ? own_g[n++] : own_g[--last]) = p;
    }
    // Shared ones in one order.
    if (shared >= 2 && own_g[0] != own_f[0]) {
      std::swap(own_g[0], own_g[1]);
    }
    return shared;
  }

  /// Whether g lies surely on one side of f's plane, corners on it that are f's own left aside.
  [[nodiscard]] bool beside_plane(const Corners& f, const Corners& g) const {
    constexpr double rounding = 1e-13;  // as in mesh/repair/self_intersections.cpp
    const Vec3 origin = points_[f[0]];
    const Vec3 u = points_[f[1]] - origin;
    const Vec3 v = points_[f[2]] - origin;
    const Vec3 normal = cross(u, v);
    const double bound = rounding * diagonal_ * length(u) * length(v);
    int above = 0;
    int below = 0;
    int own = 0;
    for (const std::uint32_t p : g) {
      if (p == f[0] || p == f[1] || p == f[2]) {
        ++own;
        continue;
      }
      const double height = dot(normal, points_[p] - origin);
      above += height > bound ? 1 : 0;
      below += height < -bound ? 1 : 0;
    }
    return above + own == 3 || below + own == 3;
  }

  /// Two triangles with one common corner, the first of each.
  [[nodiscard]] bool meet_beyond_corner(const Corners& f, const Corners& g) const {
    const bool flat = CGAL::orientation(at(f[0]), at(f[1]), at(f[2]), at(g[1])) == CGAL::COPLANAR &&
                      CGAL::orientation(at(f[0]), at(f[1]), at(f[2]), at(g[2])) == CGAL::COPLANAR;
    if (flat) {
      return sectors_meet(f, g);
    }
    return CGAL::do_intersect(Filtered::Segment_3(at(f[1]), at(f[2])), triangle(g)) ||
           CGAL::do_intersect(Filtered::Segment_3(at(g[1]), at(g[2])), triangle(f));
  }

  /// In one plane: do they share more than the corner?
  [[nodiscard]] bool sectors_meet(const Corners& f, const Corners& g) const {
    const Vec3 origin = points_[f[0]];
    const View view = view_along(cross(points_[f[1]] - origin, points_[f[2]] - origin));
    const auto flat = [&](std::uint32_t p) {
      const Filtered::Point_3 q = at(p);
      return Filtered::Point_2(view.first(q), view.second(q));
    };
    const Filtered::Point_2 o = flat(f[0]);
    const auto turn = [&](const Filtered::Point_2& a, const Filtered::Point_2& b) {
      return CGAL::orientation(o, a, b);
    };
    std::array<Filtered::Point_2, 2> s{flat(f[1]), flat(f[2])};
    std::array<Filtered::Point_2, 2> t{flat(g[1]), flat(g[2])};
    for (auto* sector : {&s, &t}) {
      if (turn((*sector)[0], (*sector)[1]) == CGAL::RIGHT_TURN) {
        std::swap((*sector)[0], (*sector)[1]);
      }
    }
    // Sides count: those that lie along each other may end at different points.
    const auto within = [&](const Filtered::Point_2& p, const std::array<Filtered::Point_2, 2>& sector) {
      const auto left = turn(sector[0], p);
      const auto right = turn(p, sector[1]);
      if (left == CGAL::COLLINEAR) {
        return CGAL::angle(sector[0], o, p) == CGAL::ACUTE;
      }
      if (right == CGAL::COLLINEAR) {
        return CGAL::angle(sector[1], o, p) == CGAL::ACUTE;
      }
      return left == CGAL::LEFT_TURN && right == CGAL::LEFT_TURN;
    };
    return within(s[0], t) || within(s[1], t) || within(t[0], s) || within(t[1], s);
  }

  const std::vector<Vec3>& points_;
  double diagonal_ = 0.0;
};

/// Of a point in space.
struct Number {
  std::uint32_t value = none;
};
/// Plane triangulation of what lies in one plane; vertices know the number of their point in space.
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<Number, Exact>;
using Faces = CGAL::Constrained_triangulation_face_base_2<Exact>;
using Flat = CGAL::Constrained_triangulation_2<Exact, CGAL::Triangulation_data_structure_2<Vertices, Faces>,
                                               CGAL::Exact_intersections_tag>;

class Arranger {
 public:
  Arranger(const BodySoup& soup, const Context& context) : soup_(soup), context_(context) {}

  std::optional<Arrangement> run(std::size_t most_pairs) {
    place_ = first_at_place(soup_.points);
    for (const Corners& t : soup_.triangles) {
      triangles_.push_back({place_[t[0]], place_[t[1]], place_[t[2]]});
    }
    result_.points = soup_.points;
    result_.new_points = soup_.points.size();
    if (!find_pairs(most_pairs)) {
      return std::nullopt;
    }
    exact_.resize(soup_.points.size());
    ready_.assign(soup_.points.size(), 0);
    meet_all();
    divide_all();
    find_patches();
    find_windings();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_solid(std::uint32_t t) const { return soup_.solid[soup_.body[t]] != 0; }

  bool find_pairs(std::size_t most_pairs) {
    const Contacts contacts(soup_.points);
    std::vector<Box3> boxes;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (contacts.has_area(triangles_[t])) {
        whole_.push_back(t);
        boxes.push_back(box_of(soup_.points, triangles_[t]));
      }
    }
    std::size_t asked = 0;
    bool too_many = false;
    NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
      if (++asked % pairs_per_check == 0) {
        context_.check();
      }
      const std::uint32_t s = whole_[std::min(i, j)];
      const std::uint32_t t = whole_[std::max(i, j)];
      if (too_many || (!is_solid(s) && !is_solid(t)) || !contacts.meet(triangles_[s], triangles_[t])) {
        return;
      }
      too_many = pairs_.size() >= most_pairs;
      pairs_.push_back({s, t});
    });
    std::sort(pairs_.begin(), pairs_.end());
    return !too_many;
  }

  /// By number; references stay good.
  [[nodiscard]] const Exact::Point_3& point(std::uint32_t number) {
    if (ready_[number] == 0) {
      exact_[number] = exact(soup_.points[number]);
      ready_[number] = 1;
    }
    return exact_[number];
  }
  [[nodiscard]] Exact::Triangle_3 triangle(std::uint32_t t) {
    return {point(triangles_[t][0]), point(triangles_[t][1]), point(triangles_[t][2])};
  }
  std::uint32_t number_of(const Exact::Point_3& p) {
    const auto [at, fresh] = number_.try_emplace(p, static_cast<std::uint32_t>(result_.points.size()));
    if (fresh) {
      CGAL::exact(p);  // numbers that wait to be computed would hang on each other in long chains
      result_.points.push_back(rounded(p));
      exact_.push_back(p);
      ready_.push_back(1);
    }
    return at->second;
  }

  /// What lies in a triangle besides its sides.
  struct Marks {
    std::vector<std::uint32_t> points;
    std::vector<std::array<std::uint32_t, 2>> lines;
  };

  void meet_all() {
    // Corners first, so that what is found at one of them is that corner.
    for (const auto& [s, t] : pairs_) {
      for (const std::uint32_t f : {s, t}) {
        for (const std::uint32_t p : triangles_[f]) {
          number_.try_emplace(point(p), p);
        }
      }
    }
    marks_.resize(triangles_.size());
    planes_.reset(triangles_.size());
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (i % pairs_per_check == 0) {
        context_.check();
      }
      meet(pairs_[i][0], pairs_[i][1]);
    }
  }

  void meet(std::uint32_t s, std::uint32_t t) {
    const auto common = CGAL::intersection(triangle(s), triangle(t));
    if (!common) {
      return;
    }
    std::vector<std::uint32_t> outline;
    if (const auto* p = boost::get<Exact::Point_3>(&*common)) {
      outline = {number_of(*p)};
    } else if (const auto* segment = boost::get<Exact::Segment_3>(&*common)) {
      outline = {number_of(segment->source()), number_of(segment->target())};
    } else if (const auto* part = boost::get<Exact::Triangle_3>(&*common)) {
      outline = {number_of(part->vertex(0)), number_of(part->vertex(1)), number_of(part->vertex(2))};
    } else if (const auto* polygon = boost::get<std::vector<Exact::Point_3>>(&*common)) {
      for (const Exact::Point_3& q : *polygon) {
        outline.push_back(number_of(q));
      }
    }
    const auto mark = [&](std::uint32_t f) {
      if (outline.size() == 1) {
        marks_[f].points.push_back(outline[0]);
      }
      for (std::size_t k = 0; outline.size() > 1 && k < (outline.size() == 2 ? 1 : outline.size()); ++k) {
        marks_[f].lines.push_back({outline[k], outline[(k + 1) % outline.size()]});
      }
    };
    if (is_solid(t)) {
      mark(s);
    }
    if (is_solid(s)) {
      mark(t);
    }
    if (outline.size() > 2 && is_solid(s) && is_solid(t)) {
      planes_.join(s, t);
    }
  }

  /// Triangles that lie on each other are divided together; those that nothing meets stay whole.
  void divide_all() {
    std::vector<std::vector<std::uint32_t>> together(triangles_.size());
    for (const std::uint32_t t : whole_) {
      together[planes_.find(t)].push_back(t);
    }
    std::size_t done = 0;
    for (const std::vector<std::uint32_t>& group : together) {
      if (group.empty()) {
        continue;
      }
      if (++done % 64 == 0) {
        context_.check();
      }
      if (group.size() == 1 && marks_[group[0]].points.empty() && marks_[group[0]].lines.empty()) {
        add_facet(triangles_[group[0]], {{group[0], true}});
      } else {
        divide(group);
      }
    }
  }

  void add_facet(const Corners& corners, const std::vector<Source>& sources) {
    const auto first = static_cast<std::uint32_t>(result_.sources.size());
    result_.sources.insert(result_.sources.end(), sources.begin(), sources.end());
    result_.facets.push_back({corners, none, first, static_cast<std::uint32_t>(result_.sources.size())});
  }

  [[nodiscard]] Vec3 rough_normal(std::uint32_t t) const {
    const Corners& c = triangles_[t];
    const Vec3 a = soup_.points[c[0]];
    return cross(soup_.points[c[1]] - a, soup_.points[c[2]] - a);
  }

  void divide(const std::vector<std::uint32_t>& group) {
    const Exact::Plane_3 plane = triangle(group[0]).supporting_plane();
    const View view = exact_view(plane);
    Flat flat;
    const auto put = [&](std::uint32_t number) {
      const Exact::Point_3& p = point(number);
      const auto vertex = flat.insert(Exact::Point_2(view.first(p), view.second(p)));
      vertex->info().value = number;
      return vertex;
    };
    std::vector<std::array<std::uint32_t, 2>> lines;
    for (const std::uint32_t t : group) {
      for (std::size_t k = 0; k < 3; ++k) {
        lines.push_back({triangles_[t][k], triangles_[t][(k + 1) % 3]});
      }
      lines.insert(lines.end(), marks_[t].lines.begin(), marks_[t].lines.end());
    }
    for (auto& [a, b] : lines) {
      if (a > b) {
        std::swap(a, b);
      }
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    // All known points first, so that lines through them are divided there.
    std::map<std::uint32_t, Flat::Vertex_handle> known;
    for (const auto& line : lines) {
      for (const std::uint32_t p : line) {
        if (!known.contains(p)) {
          known[p] = put(p);
        }
      }
    }
    for (const std::uint32_t t : group) {
      for (const std::uint32_t p : marks_[t].points) {
        if (!known.contains(p)) {
          known[p] = put(p);
        }
      }
    }
    for (const auto& [a, b] : lines) {
      if (a != b) {
        flat.insert_constraint(known[a], known[b]);
      }
    }
    number_crossings(flat, plane, view);
    const std::vector<Outline> outlines =
        group.size() == 1 ? std::vector<Outline>() : outlines_of(group, view);
    std::vector<std::pair<Corners, Flat::Face_handle>> facets;
    for (const Flat::Face_handle f : flat.finite_face_handles()) {
      Corners corners{f->vertex(0)->info().value, f->vertex(1)->info().value, f->vertex(2)->info().value};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      facets.emplace_back(corners, f);
    }
    std::sort(facets.begin(), facets.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [corners, f] : facets) {
      const std::vector<Source> sources =
          group.size() == 1 ? std::vector<Source>{{group[0], true}} : sources_of(f, outlines);
      if (!sources.empty()) {
        add_facet(corners, sources);
        divided_.resize(result_.facets.size(), 0);
        divided_.back() = 1;
      }
    }
  }

  /// Gives numbers to the points where lines cross, in the order of the points: that of a triangulation's
  /// vertices and faces depends on the machine.
  void number_crossings(const Flat& flat, const Exact::Plane_3& plane, View view) {
    std::vector<Flat::Vertex_handle> crossings;
    for (const Flat::Vertex_handle v : flat.finite_vertex_handles()) {
      if (v->info().value == none) {
        crossings.push_back(v);
      }
    }
    std::sort(crossings.begin(), crossings.end(),
              [](Flat::Vertex_handle a, Flat::Vertex_handle b) { return a->point() < b->point(); });
    for (const Flat::Vertex_handle v : crossings) {
      v->info().value = number_of(lifted(v->point(), plane, view));
    }
  }

  [[nodiscard]] static View exact_view(const Exact::Plane_3& plane) {
    return view_along({nearest(plane.a()), nearest(plane.b()), nearest(plane.c())});
  }
  [[nodiscard]] static Exact::Point_3 lifted(const Exact::Point_2& p, const Exact::Plane_3& plane,
                                             View view) {
    const int i = view.behind ? (view.axis + 2) % 3 : (view.axis + 1) % 3;
    const int j = view.behind ? (view.axis + 1) % 3 : (view.axis + 2) % 3;
    const std::array<Exact::FT, 3> factor{plane.a(), plane.b(), plane.c()};
    std::array<Exact::FT, 3> at;
    const auto index = [](int k) { return static_cast<std::size_t>(k); };
    at[index(i)] = p.x();
    at[index(j)] = p.y();
    at[index(view.axis)] =
        -(factor[index(i)] * p.x() + factor[index(j)] * p.y() + plane.d()) / factor[index(view.axis)];
    return {at[0], at[1], at[2]};
  }

  /// A triangle of a group in its plane.
  struct Outline {
    std::uint32_t triangle;
    std::array<Exact::Point_2, 3> corners;
    CGAL::Orientation turn;
    Box2 box;  ///< a little too large
  };
  std::vector<Outline> outlines_of(const std::vector<std::uint32_t>& group, View view) {
    std::vector<Outline> outlines;
    for (const std::uint32_t t : group) {
      Outline outline{t, {}, CGAL::COLLINEAR, {}};
      for (std::size_t k = 0; k < 3; ++k) {
        const Exact::Point_3& p = point(triangles_[t][k]);
        outline.corners[k] = {view.first(p), view.second(p)};
        outline.box.add(roughly(outline.corners[k]));
      }
      const double margin = 1e-9 * length(outline.box.high - outline.box.low);
      outline.box.low = outline.box.low - Vec2{margin, margin};
      outline.box.high = outline.box.high + Vec2{margin, margin};
      outline.turn = CGAL::orientation(outline.corners[0], outline.corners[1], outline.corners[2]);
      outlines.push_back(outline);
    }
    return outlines;
  }
  /// Enough for boxes that are a little too large.
  static Vec2 roughly(const Exact::Point_2& p) { return {CGAL::to_double(p.x()), CGAL::to_double(p.y())}; }

  /// The triangles of a group that a face of its triangulation lies in.
  static std::vector<Source> sources_of(Flat::Face_handle f, const std::vector<Outline>& outlines) {
    const Exact::Point_2 middle =
        CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
    const Vec2 rough = roughly(middle);
    std::vector<Source> sources;
    for (const Outline& o : outlines) {
      if (rough.x < o.box.low.x || rough.x > o.box.high.x || rough.y < o.box.low.y ||
          rough.y > o.box.high.y) {
        continue;
      }
      const auto left_of = [&](std::size_t k) {
        return CGAL::orientation(o.corners[k], o.corners[(k + 1) % 3], middle) == o.turn;
      };
      if (left_of(0) && left_of(1) && left_of(2)) {
        sources.push_back({o.triangle, o.turn == CGAL::LEFT_TURN});
      }
    }
    return sources;
  }

  // Patches.

  struct Side {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t facet;
    bool solid;
  };

  /// Whose facet: bodies with the side that they face, ascending.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, bool>> owners(const Facet& facet) const {
    std::vector<std::pair<std::uint32_t, bool>> all;
    for (std::uint32_t i = facet.first_source; i < facet.last_source; ++i) {
      const Source& s = result_.sources[i];
      all.emplace_back(soup_.body[s.triangle], s.same_side);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  void find_patches() {
    std::vector<Side> sides;
    for (std::uint32_t f = 0; f < result_.facets.size(); ++f) {
      const Facet& facet = result_.facets[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = facet.corners[k];
        const std::uint32_t q = facet.corners[(k + 1) % 3];
        sides.push_back(
            {std::min(p, q), std::max(p, q), f, is_solid(result_.sources[facet.first_source].triangle)});
      }
    }
    const std::vector<Side> ordered = in_edge_order(std::span<const Side>(sides));
    DisjointSets sets(result_.facets.size());
    for (std::size_t i = 0; i < ordered.size();) {
      std::size_t j = i + 1;
      while (j < ordered.size() && ordered[j].low == ordered[i].low && ordered[j].high == ordered[i].high) {
        ++j;
      }
      // Sheets divide no solids, so solids needn't have an edge where a sheet ends in them: pieces of a
      // sheet's triangle are patches of their own.
      std::vector<std::uint32_t> here;
      for (std::size_t k = i; k < j; ++k) {
        if (ordered[k].solid == ordered[i].solid || ordered[k].solid) {
          here.push_back(ordered[k].facet);
        }
      }
      std::erase_if(here, [&](std::uint32_t f) {
        return !is_solid(result_.sources[result_.facets[f].first_source].triangle) &&
               (f < divided_.size() && divided_[f] != 0);
      });
      if (here.size() == 2 && runs_on(here[0], here[1], ordered[i].low, ordered[i].high)) {
        sets.join(here[0], here[1]);
      }
      i = j;
    }
    std::vector<std::uint32_t> number(result_.facets.size(), none);
    for (std::uint32_t f = 0; f < result_.facets.size(); ++f) {
      const std::uint32_t root = sets.find(f);
      if (number[root] == none) {
        number[root] = static_cast<std::uint32_t>(result_.patches.size());
        result_.patches.emplace_back();
        largest_.push_back(f);
      }
      result_.facets[f].patch = number[root];
      if (rough_area(f) > rough_area(largest_[number[root]])) {
        largest_[number[root]] = f;
      }
    }
  }

  [[nodiscard]] double rough_area(std::uint32_t f) const {
    const Corners& c = result_.facets[f].corners;
    const Vec3 a = result_.points[c[0]];
    return length(cross(result_.points[c[1]] - a, result_.points[c[2]] - a));
  }

  /// Two facets at an edge that nothing else meets: are they of the same bodies, facing alike?
  [[nodiscard]] bool runs_on(std::uint32_t f, std::uint32_t g, std::uint32_t low, std::uint32_t high) const {
    const auto forward = [&](std::uint32_t h) {
      const Corners& c = result_.facets[h].corners;
      return (c[0] == low && c[1] == high) || (c[1] == low && c[2] == high) || (c[2] == low && c[0] == high);
    };
    return forward(f) != forward(g) && owners(result_.facets[f]) == owners(result_.facets[g]);
  }

  // Windings.

  void find_windings() {
    std::vector<std::uint32_t> solids;
    std::copy_if(whole_.begin(), whole_.end(), std::back_inserter(solids),
                 [&](std::uint32_t t) { return is_solid(t); });
    Box3 all;
    for (const std::uint32_t t : whole_) {
      const Box3 box = box_of(soup_.points, triangles_[t]);
      all.add(box.low);
      all.add(box.high);
    }
    const BoxTree<Box3> tree(
        solids.size(), [&](std::uint32_t i) { return box_of(soup_.points, triangles_[solids[i]]); },
        [&](std::uint32_t i) {
          const Corners& c = triangles_[solids[i]];
          return (soup_.points[c[0]] + soup_.points[c[1]] + soup_.points[c[2]]) / 3.0;
        });
    Random random(1);
    for (std::size_t p = 0; p < result_.patches.size(); ++p) {
      if (p % 64 == 0) {
        context_.check();
      }
      // A direction that nothing comes in the way of is found at once; the bound is for what can't be.
      constexpr int most_tries = 100;
      for (int i = 0; i < most_tries && !shoot(result_.patches[p], largest_[p], tree, solids, all, random);
           ++i) {
      }
    }
  }

  /// Does a segment come near a box? Never no where it does.
  static bool comes_near(Vec3 from, Vec3 way, const Box3& box, double margin) {
    double enters = 0.0;
    double leaves = 1.0;
    const auto clip = [&](double start, double step, double low, double high) {
      const double a = (low - margin - start) / step;
      const double b = (high + margin - start) / step;
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    };
    clip(from.x, way.x, box.low.x, box.high.x);
    clip(from.y, way.y, box.low.y, box.high.y);
    clip(from.z, way.z, box.low.z, box.high.z);
    return enters <= leaves + 1e-9;
  }

  /// Counts what a ray from the patch meets. False where it comes through a side or a corner of something:
  /// then another direction tells.
  bool shoot(Patch& patch, std::uint32_t f, const BoxTree<Box3>& tree,
             const std::vector<std::uint32_t>& solids, const Box3& all, Random& random) {
    const Corners& c = result_.facets[f].corners;
    const Exact::Point_3 from = CGAL::centroid(point(c[0]), point(c[1]), point(c[2]));
    const double far = 4.0 * all.diagonal();
    const auto draw = [&] { return (random.below(2) == 0 ? -1.0 : 1.0) * (0.2 + random.unit()); };
    const Vec3 way{far * draw(), far * draw(), far * draw()};
    const Exact::Point_3 to = from + Exact::Vector_3(way.x, way.y, way.z);
    const auto facing = CGAL::orientation(point(c[0]), point(c[1]), point(c[2]), to);
    if (facing == CGAL::COPLANAR) {
      return false;
    }
    const bool to_front = facing == CGAL::POSITIVE;
    std::map<std::uint32_t, std::int32_t> ahead;    // around the side that the ray leaves to
    std::map<std::uint32_t, std::int32_t> through;  // what the front has less than the back
    bool sure = true;
    const Vec3 start{CGAL::to_double(from.x()), CGAL::to_double(from.y()), CGAL::to_double(from.z())};
    const double margin = 1e-9 * all.diagonal();
    tree.search([&](std::uint32_t node) { return comes_near(start, way, tree.box(node), margin); },
                [&](std::uint32_t place) {
                  if (sure) {
                    const std::uint32_t t = solids[tree.order()[place]];
                    sure = count(t, c, from, to, ahead, through);
                  }
                });
    if (!sure) {
      return false;
    }
    std::map<std::uint32_t, std::int32_t> behind = ahead;
    for (const auto& [body, number] : through) {
      behind[body] += to_front ? number : -number;
    }
    const auto listed = [](const std::map<std::uint32_t, std::int32_t>& windings) {
      std::vector<Winding> list;
      std::copy_if(windings.begin(), windings.end(), std::back_inserter(list),
                   [](const Winding& w) { return w.second != 0; });
      return list;
    };
    patch.front = listed(to_front ? ahead : behind);
    patch.back = listed(to_front ? behind : ahead);
    return true;
  }

  /// Counts one triangle for a ray that begins on the facet with these corners.
  bool count(std::uint32_t t, const Corners& facet, const Exact::Point_3& from, const Exact::Point_3& to,
             std::map<std::uint32_t, std::int32_t>& ahead, std::map<std::uint32_t, std::int32_t>& through) {
    const Exact::Point_3& a = point(triangles_[t][0]);
    const Exact::Point_3& b = point(triangles_[t][1]);
    const Exact::Point_3& c = point(triangles_[t][2]);
    const auto side = CGAL::orientation(a, b, c, from);
    const auto other = CGAL::orientation(a, b, c, to);
    const auto first = CGAL::orientation(from, to, a, b);
    const auto second = CGAL::orientation(from, to, b, c);
    const auto third = CGAL::orientation(from, to, c, a);
    const bool left = first != CGAL::NEGATIVE && second != CGAL::NEGATIVE && third != CGAL::NEGATIVE;
    const bool right = first != CGAL::POSITIVE && second != CGAL::POSITIVE && third != CGAL::POSITIVE;
    if (side == other || (!left && !right)) {
      return side != CGAL::COPLANAR || side != other;  // a ray within the plane tells nothing
    }
    if (first == CGAL::COPLANAR || second == CGAL::COPLANAR || third == CGAL::COPLANAR ||
        other == CGAL::COPLANAR) {
      return false;
    }
    const std::uint32_t body = soup_.body[t];
    if (side == CGAL::COPLANAR) {
      // The facet lies on it.
      const bool same_side = alike(facet, a, b, c);
      through[body] += same_side ? 1 : -1;
    } else {
      ahead[body] += side == CGAL::NEGATIVE ? 1 : -1;
    }
    return true;
  }

  /// Do a facet and a triangle in its plane face the same way?
  bool alike(const Corners& facet, const Exact::Point_3& a, const Exact::Point_3& b,
             const Exact::Point_3& c) {
    const auto normal = CGAL::cross_product(b - a, c - a);
    const Exact::Point_3& p = point(facet[0]);
    const auto own = CGAL::cross_product(point(facet[1]) - p, point(facet[2]) - p);
    return CGAL::sign(normal * own) == CGAL::POSITIVE;
  }

  const BodySoup& soup_;
  const Context& context_;
  std::vector<std::uint32_t> place_;
  std::vector<Corners> triangles_;    ///< by place
  std::vector<std::uint32_t> whole_;  ///< those with an area
  std::vector<std::array<std::uint32_t, 2>> pairs_;
  std::deque<Exact::Point_3> exact_;  ///< of all points, those of the soup once they are asked for
  std::vector<std::uint8_t> ready_;
  std::map<Exact::Point_3, std::uint32_t> number_;  ///< of points where triangles meet, and their corners
  std::vector<Marks> marks_;
  DisjointSets planes_;
  std::vector<std::uint32_t> largest_;  ///< facet of each patch
  std::vector<std::uint8_t> divided_;   ///< facets that are no whole triangle
  Arrangement result_;
};

}  // namespace

std::optional<Arrangement> arrange(const BodySoup& soup, std::size_t most_pairs, const Context& context) {
  return Arranger(soup, context).run(most_pairs);
}

bool has_crossings(const std::vector<Vec3>& points, const std::vector<Corners>& triangles,
                   const Context& context) {
  const std::vector<std::uint32_t> place = first_at_place(points);
  const Contacts contacts(points);
  std::vector<Corners> placed;
  std::vector<Box3> boxes;
  for (const Corners& t : triangles) {
    const Corners p{place[t[0]], place[t[1]], place[t[2]]};
    if (contacts.has_area(p)) {
      placed.push_back(p);
      boxes.push_back(box_of(points, p));
    }
  }
  std::size_t asked = 0;
  bool found = false;
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    if (++asked % pairs_per_check == 0) {
      context.check();
    }
    found = found || (!Contacts::share_a_corner(placed[i], placed[j]) && contacts.meet(placed[i], placed[j]));
  });
  return found;
}

}  // namespace ridgecraft::prepare
