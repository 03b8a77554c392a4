// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/contacts.hpp"

#include <algorithm>
#include <utility>

#include "base/boxes.hpp"
#include "base/order.hpp"
#include "prepare/skin/exact.hpp"

namespace ridgecraft::prepare {
namespace {

Filtered::Point_3 at(const std::vector<Vec3>& points, std::uint32_t p) {
  return filtered(points[p]);
}
Filtered::Triangle_3 triangle(const std::vector<Vec3>& points, const Corners& t) {
  return {at(points, t[0]), at(points, t[1]), at(points, t[2])};
}

/// Shared corners first; returns how many there are.
std::size_t split(const Corners& f, const Corners& g, Corners& own_f, Corners& own_g) {
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

bool share_a_corner(const Corners& f, const Corners& g) {
  return std::any_of(f.begin(), f.end(),
                     [&](std::uint32_t p) { return p == g[0] || p == g[1] || p == g[2]; });
}

}  // namespace

Box3 box_of(const std::vector<Vec3>& points, const Corners& t) {
  Box3 box;
  for (const std::uint32_t p : t) {
    box.add(points[p]);
  }
  return box;
}

Contacts::Contacts(const std::vector<Vec3>& points) : points_(points) {
  Box3 box;
  std::for_each(points.begin(), points.end(), [&](Vec3 p) { box.add(p); });
  diagonal_ = box.diagonal();
}

bool Contacts::has_area(const Corners& t) const {
  return t[0] != t[1] && t[1] != t[2] && t[2] != t[0] &&
         !CGAL::collinear(at(points_, t[0]), at(points_, t[1]), at(points_, t[2]));
}

bool Contacts::meet(const Corners& f, const Corners& g) const {
  Corners own_f, own_g;  // those shared first
  const std::size_t shared = split(f, g, own_f, own_g);
  switch (shared) {
    case 0:
      return !beside_plane(f, g) && !beside_plane(g, f) &&
             CGAL::do_intersect(triangle(points_, f), triangle(points_, g));
    case 1:
      return !beside_plane(f, g) && !beside_plane(g, f) && meet_beyond_corner(own_f, own_g);
    case 2:
      return CGAL::orientation(at(points_, f[0]), at(points_, f[1]), at(points_, f[2]),
                               at(points_, own_g[2])) == CGAL::COPLANAR &&
             CGAL::coplanar_orientation(at(points_, own_f[0]), at(points_, own_f[1]), at(points_, own_f[2]),
                                        at(points_, own_g[2])) == CGAL::POSITIVE;
    default:
      return true;
  }
}
/// Whether g lies surely on one side of f's plane, corners on it that are f's own left aside.
bool Contacts::beside_plane(const Corners& f, const Corners& g) const {
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
bool Contacts::meet_beyond_corner(const Corners& f, const Corners& g) const {
  const bool flat = CGAL::orientation(at(points_, f[0]), at(points_, f[1]), at(points_, f[2]),
                                      at(points_, g[1])) == CGAL::COPLANAR &&
                    CGAL::orientation(at(points_, f[0]), at(points_, f[1]), at(points_, f[2]),
                                      at(points_, g[2])) == CGAL::COPLANAR;
  if (flat) {
    return sectors_meet(f, g);
  }
  return CGAL::do_intersect(Filtered::Segment_3(at(points_, f[1]), at(points_, f[2])),
                            triangle(points_, g)) ||
         CGAL::do_intersect(Filtered::Segment_3(at(points_, g[1]), at(points_, g[2])), triangle(points_, f));
}

/// In one plane: do they share more than the corner?
bool Contacts::sectors_meet(const Corners& f, const Corners& g) const {
  const Vec3 origin = points_[f[0]];
  const View view = view_along(cross(points_[f[1]] - origin, points_[f[2]] - origin));
  const auto flat = [&](std::uint32_t p) {
    const Filtered::Point_3 q = at(points_, p);
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
    found = found || (!share_a_corner(placed[i], placed[j]) && contacts.meet(placed[i], placed[j]));
  });
  return found;
}

}  // namespace ridgecraft::prepare
