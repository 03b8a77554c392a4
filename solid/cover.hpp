// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of convex bodies as a whole: what they leave uncovered of a solid, bodies to fill that, fewer bodies
// in place of many. Private to solid/.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {

/// Of the faces that enclose something: those of the components without border.
[[nodiscard]] std::vector<FaceId> closed_faces(const mesh::Surface& surface);

/// A body of these.
[[nodiscard]] Body closed_body_of(const mesh::Surface& surface);

/// Adds bodies until what none covers of the solid is at most `most_uncovered`, and says how well they fit
/// then. A surface that encloses nothing is left alone. Each round takes
/// O(faces + rays + bodies' triangles) and a hull for each connected uncovered region, or several where one
/// would add too much air.
[[nodiscard]] Fit cover_volume(const mesh::Surface& surface, std::vector<Body>& bodies,
                               const Context& context);

/// Volume, first and second moments about the origin.
struct Moments {
  double volume = 0.0;
  Vec3 first{0.0, 0.0, 0.0};
  std::array<double, 6> second{};  ///< xx, yy, zz, xy, xz, yz
};

/// Of what the closed components of a surface enclose, on rays: space that they share counts once.
[[nodiscard]] Moments moments_on_rays(const mesh::Surface& surface, const Context& context);
/// Of the union of convex bodies.
[[nodiscard]] Moments moments_on_rays(const std::vector<Body>& bodies, const Context& context);

/// How well bodies fit.
[[nodiscard]] Fit fit_of(const mesh::Surface& surface, const std::vector<Body>& bodies,
                         const Context& context);

/// How far bodies are joined.
struct JoinRules {
  /// Until there are no more than these; 0: no such limit.
  std::size_t most = 0;
  /// As long as a union's hull adds no more than this share of its volume, however few there are.
  double free_share = 0.0;
};

/// Replaces two bodies by the hull of both, those first whose hull adds least air, which no body held at
/// first, and again, as far as the rules say. Each body is enclosed by one that is left; they are in the
/// order of their first members.
[[nodiscard]] std::vector<Body> joined(std::vector<Body> bodies, const JoinRules& rules,
                                       const Context& context);

}  // namespace ridgecraft::solid
