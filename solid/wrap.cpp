// SPDX-License-Identifier: GPL-3.0-or-later
// Cages and shells: closed surfaces around others, by alpha wrapping.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "base/error.hpp"
#include "solid/hulls.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WrapMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The probes that a cage's search tries, as shares of the diagonal: the coarsest still finds the shape's
/// place, the finest makes some 10^5 faces.
constexpr double coarsest_probe = 0.5;
constexpr double finest_probe = 0.01;
/// The search ends when the probe's size is known to this ratio.
constexpr double probe_ratio = 1.03;
/// Distance of a cage from the bodies as a share of the probe: smaller makes more faces at edges, larger
/// rounds them.
constexpr double offset_share = 0.2;

/// Triangles over points, as CGAL takes them.
struct Wrapped {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  double diagonal = 0.0;
};

Wrapped all_of(const std::vector<Body>& bodies) {
  Wrapped all;
  Box3 bounds;
  for (const Body& body : bodies) {
    const std::size_t first = all.points.size();
    for (const Vec3 p : body.points) {
      all.points.emplace_back(p.x, p.y, p.z);
      bounds.add(p);
    }
    for (const auto& [a, b, c] : body.triangles) {
      all.triangles.push_back({first + a, first + b, first + c});
    }
  }
  all.diagonal = bounds.diagonal();
  return all;
}

Body wrap(const Wrapped& input, double probe, double offset) {
  WrapMesh mesh;
  CGAL::alpha_wrap_3(input.points, input.triangles, probe, offset, mesh);
  return body_of(mesh);
}

}  // namespace

Body cage(const std::vector<Body>& bodies, const CageOptions& options, const Context& context) {
  RIDGECRAFT_ASSERT(!bodies.empty());
  const Wrapped input = all_of(bodies);
  const auto wrap_at = [&](double share) {
    context.check();
    return wrap(input, share * input.diagonal, offset_share * share * input.diagonal);
  };
  Body best = wrap_at(coarsest_probe);
  double coarse = coarsest_probe;
  double fine = finest_probe;
  while (best.triangles.size() <= options.faces && coarse > probe_ratio * fine) {
    const double probe = std::sqrt(coarse * fine);
    Body body = wrap_at(probe);
    if (body.triangles.size() <= options.faces) {
      best = std::move(body);
      coarse = probe;
    } else {
      fine = probe;
    }
  }
  return best;
}

Body shell(const mesh::Surface& surface, const ShellOptions& options, const Context& context) {
  Wrapped input;
  for (const Vec3 p : surface.points()) {
    input.points.emplace_back(p.x, p.y, p.z);
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    input.triangles.push_back({a.value(), b.value(), c.value()});
  }
  input.diagonal = surface.bounds().diagonal();
  context.check();
  return wrap(input, options.opening * input.diagonal, options.offset * input.diagonal);
}

}  // namespace ridgecraft::solid
