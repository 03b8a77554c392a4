// SPDX-License-Identifier: GPL-3.0-or-later
// Exact numbers for the union of bodies. For .cpp files of prepare/skin/ only.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <type_traits>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#ifdef CGAL_DISABLE_GMP
#include <CGAL/Lazy_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost_mp.h>
#endif

#include "base/vector.hpp"

namespace ridgecraft::prepare {

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;  ///< for points of the input
#ifndef CGAL_DISABLE_GMP
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;  ///< for points that are found
#else
/// Without GMP (wasm/) CGAL's own choice are fractions that nobody reduces: they grow beyond all doubles,
/// where CGAL divides infinity by infinity.
using Exact = CGAL::Lazy_kernel<CGAL::Simple_cartesian<boost::multiprecision::cpp_rational>>;
#endif

[[nodiscard]] inline Filtered::Point_3 filtered(Vec3 p) {
  return {p.x, p.y, p.z};
}
[[nodiscard]] inline Exact::Point_3 exact(Vec3 p) {
  return {p.x, p.y, p.z};
}
/// The double nearest to an exact number, the lower of two. CGAL::to_double depends on how far the number was
/// computed before and on the library that computes exactly; the same model is to give the same points
/// everywhere.
[[nodiscard]] inline double nearest(const Exact::FT& number) {
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
[[nodiscard]] inline Vec3 rounded(const Exact::Point_3& p) {
  return {nearest(p.x()), nearest(p.y()), nearest(p.z())};
}

/// Points by number: those of the soup become exact when they are used first; others are added after them.
/// References stay good.
class ExactPoints {
 public:
  explicit ExactPoints(const std::vector<Vec3>& soup)
      : soup_(soup), exact_(soup.size()), ready_(soup.size(), 0) {}

  [[nodiscard]] const Exact::Point_3& operator[](std::uint32_t number) {
    if (ready_[number] == 0) {
      exact_[number] = exact(soup_[number]);
      ready_[number] = 1;
    }
    return exact_[number];
  }
  void add(const Exact::Point_3& p) {
    exact_.push_back(p);
    ready_.push_back(1);
  }

 private:
  const std::vector<Vec3>& soup_;
  std::deque<Exact::Point_3> exact_;
  std::vector<std::uint8_t> ready_;
};

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
[[nodiscard]] inline View view_along(Vec3 normal) {
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  if (size.x >= size.y && size.x >= size.z) {
    return {0, normal.x < 0.0};
  }
  return size.y >= size.z ? View{1, normal.y < 0.0} : View{2, normal.z < 0.0};
}

}  // namespace ridgecraft::prepare
