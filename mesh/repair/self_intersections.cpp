// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/self_intersections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "mesh/foundation/near_boxes.hpp"

namespace ridgecraft::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Points at one place get one number: corners of different vertices may lie there, as where an edge with
/// more than two faces was cut open.
std::vector<std::uint32_t> number_places(std::span<const Vec3> points) {
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  const auto key = [&](std::uint32_t i) { return std::tie(points[i].x, points[i].y, points[i].z); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
  std::vector<std::uint32_t> place(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = k > 0 && points[order[k]] == points[order[k - 1]] ? place[order[k - 1]] : order[k];
  }
  return place;
}

struct Face {
  std::array<std::uint32_t, 3> places;
  std::array<Vec3, 3> points;
  Vec3 normal;         ///< not normalised
  double bound = 0.0;  ///< of the rounding of normal . (p - points[0]), for p within the model
};

bool share_a_place(const Face& f, const Face& g) {
  for (const std::uint32_t p : f.places) {
    if (p == g.places[0] || p == g.places[1] || p == g.places[2]) {
      return true;
    }
  }
  return false;
}

/// Whether g lies surely on one side of f's plane: true for nearly all pairs of faces that are near each
/// other.
bool beside_plane(const Face& f, const Face& g) {
  int above = 0;
  int below = 0;
  for (const Vec3 p : g.points) {
    const double height = dot(f.normal, p - f.points[0]);
    above += height > f.bound ? 1 : 0;
    below += height < -f.bound ? 1 : 0;
  }
  return above == 3 || below == 3;
}

bool intersect(const Face& f, const Face& g) {
  const auto triangle = [](const Face& face) {
    const auto at = [&](std::size_t k) {
      return Kernel::Point_3(face.points[k].x, face.points[k].y, face.points[k].z);
    };
    return Kernel::Triangle_3(at(0), at(1), at(2));
  };
  return Kernel().do_intersect_3_object()(triangle(f), triangle(g));
}

}  // namespace

std::size_t count_self_intersections(const Surface& surface) {
  if (surface.face_count() > most_faces_for_self_intersections) {
    return 0;
  }
  // Differences are at most the diagonal d, their rounding eps of it; products of three with cancellation
  // stay within 30 eps d^3 (hull.cpp counts the same), taken with a margin of 30.
  constexpr double rounding = 1e-13;
  const double diagonal = surface.bounds().diagonal();
  const std::vector<std::uint32_t> place = number_places(surface.points());
  std::vector<Face> faces;
  std::vector<Box3> boxes;
  faces.reserve(surface.face_count());
  boxes.reserve(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    // Faces without area have no plane that CGAL could cut with.
    if (surface.normal(f) == Vec3{}) {
      continue;
    }
    const auto [a, b, c] = surface.vertices(f);
    Face face{{place[a.value()], place[b.value()], place[c.value()]},
              {surface.point(a), surface.point(b), surface.point(c)},
              {},
              0.0};
    const Vec3 u = face.points[1] - face.points[0];
    const Vec3 v = face.points[2] - face.points[0];
    face.normal = cross(u, v);
    face.bound = rounding * diagonal * length(u) * length(v);
    Box3 box;
    for (const Vec3 p : face.points) {
      box.add(p);
    }
    boxes.push_back(box);
    faces.push_back(face);
  }
  std::size_t count = 0;
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    const Face& f = faces[i];
    const Face& g = faces[j];
    if (!share_a_place(f, g) && !beside_plane(f, g) && !beside_plane(g, f) && intersect(f, g)) {
      ++count;
    }
  });
  return count;
}

}  // namespace ridgecraft::mesh
