// SPDX-License-Identifier: GPL-3.0-or-later
// Overlap of two triangles of the plane as a depth: the shortest translation that separates them.
//
// Source: the separating axis theorem for convex polygons (S. Gottschalk, M. Lin, D. Manocha, "OBBTree",
// SIGGRAPH 1996, section 5, in the plane); the greatest of the signed separations over all edge normals is
// minus the depth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "base/no_index.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_constraints.hpp"

namespace ridgecraft::unfold {

/// Corners counterclockwise. Triangles without area are allowed: they are segments or points.
using Triangle = std::array<Vec2, 3>;

/// Of a counterclockwise triangle, in the corners' unit squared.
[[nodiscard]] constexpr double area_of(const Triangle& t) {
  return 0.5 * cross(t[1] - t[0], t[2] - t[0]);
}

/// The greatest signed separation of a and b over the normals of a's edges: for each edge the distance from
/// a's farthest point along its outward normal to b's nearest. Edges without length have no normal and are
/// passed over.
[[nodiscard]] inline double separation(const Triangle& a, const Triangle& b) {
  double best = -INFINITY;
  for (unsigned k = 0; k < 3; ++k) {
    const Vec2 p = a[k];
    const Vec2 along = a[(k + 1) % 3] - p;
    const double size = length(along);
    if (!(size > 0.0)) {
      continue;
    }
    const Vec2 out{along.y / size, -along.x / size};
    const double nearest = std::min(dot(out, b[0] - p), std::min(dot(out, b[1] - p), dot(out, b[2] - p)));
    // The third corner lies on the inner side but for rounding; counting it keeps the bound where the edge is
    // so short that its direction means nothing.
    best = std::max(best, nearest - std::max(0.0, dot(out, a[(k + 2) % 3] - p)));
  }
  return best;
}

/// Penetration depth, in the unit of the corners: the length of the shortest translation that leaves the
/// interiors disjoint; 0 where the triangles touch, negative where they are apart (then it is minus a lower
/// bound of their distance). No case is special: neighbours along an edge, corner to corner, contained and
/// equal triangles all get their true depth.
///
/// Error: with corners that are exact and at most C away from the origin the result is off by less than 2^-49
/// C, because each separation is one scalar product of differences, and any unit vector, however wrong its
/// direction, is an axis that proves the separation measured along it. In a net the corners themselves carry
/// the error of the chain of folds, near 1e-15 of the net's size for thousands of faces.
[[nodiscard]] inline double penetration(const Triangle& a, const Triangle& b) {
  return -std::max(separation(a, b), separation(b, a));
}

/// penetration(a, b) > tolerance, but stops at the first axis that tells. A negative tolerance asks for a
/// clearance of that size between the triangles, measured along edge normals (never more than their
/// distance).
[[nodiscard]] inline bool overlap(const Triangle& a, const Triangle& b, double tolerance) {
  const double squared = tolerance * tolerance;
  const auto apart = [tolerance, squared](const Triangle& s, const Triangle& t) {
    for (unsigned k = 0; k < 3; ++k) {
      const Vec2 p = s[k];
      const Vec2 along = s[k == 2 ? 0 : k + 1] - p;
      // Depths of t's corners inside the edge, times its length.
      const double d0 = cross(along, t[0] - p);
      const double d1 = cross(along, t[1] - p);
      const double d2 = cross(along, t[2] - p);
      const double deeper = d0 > d1 ? d0 : d1;
      const double deepest = deeper > d2 ? deeper : d2;
      const double size_squared = dot(along, along);
      // Most axes fail at once, without a square root.
      if (deepest > 0.0 && deepest * deepest > squared * size_squared) {
        continue;
      }
      const double own = cross(along, s[k == 0 ? 2 : k - 1] - p);
      if (size_squared > 0.0 && deepest - (own < 0.0 ? own : 0.0) <= tolerance * std::sqrt(size_squared)) {
        return true;
      }
    }
    return false;
  };
  return !(apart(a, b) || apart(b, a));
}

// What lies beside a side, laid against it.

/// The neighbour's frame seen from the face's own: the neighbour's side (other_from, other_to) comes to lie
/// on the face's (from, to), turned round. Middles of the sides are matched, so that a difference of lengths
/// by rounding is shared by both ends.
[[nodiscard]] inline Rigid lay_across(Vec2 from, Vec2 to, Vec2 other_from, Vec2 other_to) {
  const Vec2 along = from - to;
  const Vec2 other = other_to - other_from;
  const double size = length(along) * length(other);
  Rigid r;
  if (size > 0.0) {
    r.cosine = dot(other, along) / size;
    r.sine = cross(other, along) / size;
    const double norm = std::sqrt(r.cosine * r.cosine + r.sine * r.sine);
    r.cosine /= norm;
    r.sine /= norm;
  }
  r.shift = 0.5 * (from + to) - r.turn(0.5 * (other_from + other_to));
  return r;
}

// A connected set of faces in the form that the search works on: local numbers, each face flat in a frame of
// its own.

/// Patch::frozen of sides whose faces count as one flat region, and of those across a strip that stays one,
/// which count as a region more.
inline constexpr std::uint8_t frozen_in_panel = 1;
inline constexpr std::uint8_t frozen_in_band = 2;

/// Faces 0 .. size()-1; side 3 f + k of face f runs from its corner k to its corner k + 1.
struct Patch {
  std::vector<FaceId> face;  ///< of the surface, ascending
  std::vector<std::uint32_t>
      twin;  ///< per side: the side on the other face; nothing at a border of the patch
  std::vector<std::uint8_t> frozen;  ///< per side: 0, or always a fold, since both its faces lie in one
                                     ///< panel or one strip, or a user wants it
  std::vector<Triangle> shape;       ///< per face: its corners in its own frame, mm
  std::vector<Rigid>
      across;  ///< per side: the neighbour's frame seen from this face's, laid flat over the side
  std::vector<double> length;             ///< per side, mm
  std::vector<double> fold_angle;         ///< per side: as mesh::Surface::fold_angle
  std::vector<std::uint8_t> labels_meet;  ///< per side: 1 where the labels of its two faces differ, in the
                                          ///< patch or beyond it
  double extent = 0.0;  ///< largest extent of the whole surface, mm: the unit of search_tolerance

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(face.size()); }
};

/// The sides of its face that follow and precede a side, counterclockwise.
[[nodiscard]] inline std::uint32_t next_side(std::uint32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}
[[nodiscard]] inline std::uint32_t previous_side(std::uint32_t side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

/// Makes a patch of these faces (ascending). Sides between faces of the set are twins, all others border; a
/// side that is to be cut is border, too, and one that is to be kept is frozen. `constraints`: per edge, or
/// empty; `labels`: per face of the surface (Options::labels), or empty. O(n log n).
[[nodiscard]] Patch make_patch(const mesh::Surface& surface, const prepare::Panels& panels,
                               std::span<const FaceId> faces,
                               std::span<const EdgeConstraint> constraints = {},
                               std::span<const std::uint32_t> labels = {});

/// The connected components (over twins) of a set of faces of the surface, each ascending, in the order of
/// their first faces; edges that are to be cut don't connect. O(n log n).
[[nodiscard]] std::vector<std::vector<FaceId>> connected(const mesh::Surface& surface,
                                                         std::span<const FaceId> faces,
                                                         std::span<const EdgeConstraint> constraints = {});

/// 1 where the faces on both sides of a side count as one flat region, otherwise 0.
[[nodiscard]] inline std::size_t within_panel(const Patch& patch, std::uint32_t side) {
  return patch.frozen[side] == frozen_in_panel ? 1 : 0;
}

/// Whether the model's author has set the faces on both sides of a side apart. Inside a flat region that
/// counts for nothing: it stays whole.
[[nodiscard]] inline bool is_border_of_labels(const Patch& patch, std::uint32_t side) {
  return patch.labels_meet[side] != 0 && patch.frozen[side] == 0;
}

/// One flag per side: is it a fold? Both sides of an edge have the same flag. The folds of a patch make a
/// forest.
using Folds = std::vector<std::uint8_t>;

/// Pairs of faces.
using FacePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The surface's edge at a side of a patch.
[[nodiscard]] inline EdgeId edge_of(const mesh::Surface& surface, const Patch& patch, std::uint32_t side) {
  return surface.edge(mesh::corner(patch.face[side / 3], side % 3));
}

/// The sets of faces that hang together, of one part each where the part of each face is given. O(n).
[[nodiscard]] DisjointSets connected_faces(const Patch& patch, std::span<const PartId> part = {});

/// Paper that these faces take, mm2.
[[nodiscard]] double area_of(const Patch& patch, std::span<const std::uint32_t> faces);

/// Paper that the whole patch takes, mm2.
[[nodiscard]] double area_of(const Patch& patch);

/// A face laid flat from the length of its sides: corner k at shape[k], counterclockwise.
[[nodiscard]] Triangle flat_shape(Vec3 a, Vec3 b, Vec3 c);

// A part of a patch as a patch of its own, and its folds there and back.

/// The patch of these faces (ascending): face i of it is faces[i]. Sides between two of them are twins, all
/// others border. O(size of the patch).
[[nodiscard]] Patch sub_patch(const Patch& patch, std::span<const std::uint32_t> faces);

/// The folds between these faces, by their numbers in the sub-patch.
[[nodiscard]] Folds sub_folds(const Patch& patch, const Folds& folds, std::span<const std::uint32_t> faces);

/// Replaces the folds between these faces by those of the sub-patch; folds to other faces stay.
void put_back(const Patch& patch, std::span<const std::uint32_t> faces, const Folds& sub, Folds& folds);

}  // namespace ridgecraft::unfold
