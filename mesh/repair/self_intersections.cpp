// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/self_intersections.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "base/boxes.hpp"
#include "base/order.hpp"

namespace ridgecraft::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Pairs of faces between two questions whether to stop: some milliseconds.
constexpr std::size_t pairs_per_check = 1U << 14U;

/// Points at one place have one number: corners of different vertices may lie there, as where an edge with
/// more than two faces was cut open.
using Places = std::array<std::uint32_t, 3>;

struct Face {
  std::array<Vec3, 3> points;
  Vec3 normal;         ///< not normalised
  double bound = 0.0;  ///< of the rounding of normal . (p - points[0]), for p within the model
};

bool share_a_place(const Places& f, const Places& g) {
  for (const std::uint32_t p : f) {
    if (p == g[0] || p == g[1] || p == g[2]) {
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

std::size_t count_self_intersections(const Surface& surface, const Context& context) {
  if (surface.face_count() > most_faces_for_self_intersections) {
    return 0;
  }
  // Differences are at most the diagonal d, their rounding eps of it; products of three with cancellation
  // stay within 30 eps d^3 (hull.cpp counts the same), taken with a margin of 30.
  constexpr double rounding = 1e-13;
  const double diagonal = surface.bounds().diagonal();
  const std::vector<std::uint32_t> place = first_at_place(surface.points());
  // Nearly all pairs share a place: what that takes lies close together.
  std::vector<Places> places;
  std::vector<Face> faces;
  std::vector<Box3> boxes;
  places.reserve(surface.face_count());
  faces.reserve(surface.face_count());
  boxes.reserve(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    // Faces without area have no plane that CGAL could cut with.
    if (surface.normal(f) == Vec3{}) {
      continue;
    }
    const auto [a, b, c] = surface.vertices(f);
    Face face{{surface.point(a), surface.point(b), surface.point(c)}, {}, 0.0};
    const Vec3 u = face.points[1] - face.points[0];
    const Vec3 v = face.points[2] - face.points[0];
    face.normal = cross(u, v);
    face.bound = rounding * diagonal * length(u) * length(v);
    Box3 box;
    for (const Vec3 p : face.points) {
      box.add(p);
    }
    boxes.push_back(box);
    places.push_back({place[a.value()], place[b.value()], place[c.value()]});
    faces.push_back(face);
  }
  std::size_t count = 0;
  std::size_t pairs = 0;
  NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    if (++pairs % pairs_per_check == 0) {
      context.check();
    }
    if (share_a_place(places[i], places[j])) {
      return;
    }
    const Face& f = faces[i];
    const Face& g = faces[j];
    if (!beside_plane(f, g) && !beside_plane(g, f) && intersect(f, g)) {
      ++count;
    }
  });
  return count;
}

}  // namespace ridgecraft::mesh
