// SPDX-License-Identifier: GPL-3.0-or-later
// Hulls for a whole model.
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "solid/cover.hpp"
#include "solid/cuts.hpp"
#include "solid/hulls.hpp"
#include "solid/solid.hpp"

namespace ridgecraft::solid {
namespace {

/// Two bodies whose hull is larger than they are by no more than this share are as good as one.
constexpr double free_share = 1e-3;
/// Hulls that hold no more air than this share of the solid are near enough: planes aren't tried.
constexpr double near_as_can_be = 0.02;
/// Pieces are cut until their hulls hold less air than this share of the solid, or they are so many times as
/// many as there may be: the more there are, the better what is joined of them.
constexpr double air_of_pieces = 0.02;
constexpr std::size_t pieces_a_hull = 4;
constexpr std::size_t fewest_pieces = 24;
constexpr std::size_t most_pieces = 72;
/// Half the thickness of a flat piece, as a share of the surface's diagonal.
constexpr double piece_thickness = 1e-9;

/// Hulls of the parts, and what fills between them.
HullSet hulls_of_parts(const mesh::Surface& surface, std::vector<Body> bodies, const HullOptions& options,
                       const Context& context) {
  HullSet set;
  const std::size_t of_parts = bodies.size();
  set.fit = cover_volume(surface, bodies, context);
  set.filling = bodies.size() - of_parts;
  if (set.filling > 0) {
    // Much of what was filled goes with the parts around it into one.
    bodies = joined(std::move(bodies), {.most = options.max_hulls, .free_share = free_share}, context);
  } else if (options.max_hulls > 0 && bodies.size() > options.max_hulls) {
    bodies = joined(std::move(bodies), {.most = options.max_hulls, .free_share = -1.0}, context);
  }
  set.bodies = std::move(bodies);
  return set;
}

/// No more hulls than `most`, of pieces of the solid that planes cut off; what encloses nothing keeps the
/// hulls of its parts.
std::vector<Body> hulls_of_cuts(const mesh::Surface& surface, const segment::Segmentation& parts,
                                const std::vector<Body>& of_parts, std::size_t most, const Context& context) {
  std::vector<bool> open(parts.parts.size(), true);
  for (const FaceId f : closed_faces(surface)) {
    open[parts.part[f].value()] = false;
  }
  const Body solid = closed_body_of(surface);
  const std::size_t pieces = std::clamp(pieces_a_hull * most, fewest_pieces, most_pieces);
  std::vector<Body> bodies;
  for (const Body& piece : cut_by_planes(solid, air_of_pieces, pieces, context)) {
    bodies.push_back(convex_hull(piece.points, piece_thickness * surface.bounds().diagonal(), context));
  }
  for (std::size_t i = 0; i < of_parts.size(); ++i) {
    if (open[i]) {
      bodies.push_back(of_parts[i]);
    }
  }
  return joined(std::move(bodies), {.most = most, .free_share = free_share}, context);
}

double air_of(const Fit& fit) {
  return fit.union_volume - (1.0 - fit.uncovered) * fit.solid_volume;
}

}  // namespace

HullSet model_hulls(const mesh::Surface& surface, const segment::Segmentation& parts,
                    const HullOptions& options, const Context& context) {
  const std::vector<Body> of_parts = part_hulls(surface, parts, {}, context);
  HullSet set = hulls_of_parts(surface, of_parts, options, context);
  set.fit = fit_of(surface, set.bodies, context);
  if (set.bodies.size() > 1 && air_of(set.fit) > near_as_can_be * set.fit.solid_volume) {
    std::vector<Body> cut = hulls_of_cuts(surface, parts, of_parts, set.bodies.size(), context);
    const Fit fit = fit_of(surface, cut, context);
    if (fit.uncovered <= most_uncovered && air_of(fit) < air_of(set.fit)) {
      set = {.bodies = std::move(cut), .fit = fit, .filling = 0, .of_cuts = true};
    }
  }
  for (Body& body : set.bodies) {
    if (options.max_vertices != 0 && body.points.size() > options.max_vertices) {
      body = enclosing_polytope(body, options.max_vertices, context);
    }
  }
  if (options.max_vertices != 0) {
    set.fit = fit_of(surface, set.bodies, context);
  }
  return set;
}

}  // namespace ridgecraft::solid
