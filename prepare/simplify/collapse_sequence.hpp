// SPDX-License-Identifier: GPL-3.0-or-later
// Simplification as a sequence of edge collapses that is worked out once and can be stopped anywhere. Private
// to prepare/.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {

/// One edge becomes a vertex.
struct Collapse {
  std::uint32_t gone;   ///< this vertex is no more ...
  std::uint32_t stays;  ///< ... and this one, its neighbour, moves
  Vec3 place;           ///< to here
  std::uint32_t faces;  ///< so many are left afterwards
};

/// What the faces stand for, where they are a share of a symmetric whole (SymmetricShare).
struct PointRules {
  static constexpr std::uint32_t none = 0xffffffffU;
  std::vector<MirrorPlane> planes;
  /// Of each point: the plane that it stays on, since the other half is its mirror image; or none. Border
  /// edges between two such points are no border of the whole.
  std::vector<std::uint32_t> plane;
  std::vector<std::uint32_t> copies;  ///< of each point: faces in the whole for each of its faces
  /// A point that the cut made on an edge, and that no collapse has touched: it goes along with the ends of
  /// the edge, so that flat and straight places across the plane stay so.
  struct Crossing {
    std::uint32_t point = 0;
    std::uint32_t end = 0;           ///< of the edge, on the side that is kept
    std::uint32_t image_of_end = 0;  ///< the other end's mirror image
  };
  std::vector<Crossing> crossings;
};

/// What guides and limits the collapses besides the quadric error.
struct CollapseRules {
  /// The error is multiplied by (length / short_edge)^power: with a power above 0 short edges go first.
  double short_edge = 1.0;
  double power = 0.0;
  /// Where given, the surface may not leave this field around the original one, nor move farther from any
  /// part of the original than largest_deviation.
  mesh::NearField* field = nullptr;
  double largest_deviation = 0.0;
};

/// Collapses by least quadric error (Garland, Heckbert: mesh::Surface simplification using quadric error
/// metrics, 1997; CGAL's implementation) down to `faces` faces, or until no collapse is left that keeps the
/// surface manifold without flipping or folding faces. Borders and sharp edges stay by the planes they add.
/// Of a share of a symmetric whole the errors are those of the whole, and no edge or face comes to lie
/// between points of a plane but its border. Faces are counted in the whole. The input must fulfil
/// mesh::Surface's invariants. O(n log n).
[[nodiscard]] std::vector<Collapse> collapse_sequence(const mesh::LooseFaces& loose, const PointRules& points,
                                                      std::size_t faces, const CollapseRules& rules,
                                                      const Context& context);

/// Where the edge from a point to another one's mirror image crosses the plane; some point of the plane where
/// both lie on it.
[[nodiscard]] Vec3 crossing(const MirrorPlane& plane, Vec3 end, Vec3 image_of_end);

/// What became of each of `count` points: itself, or the point that it is part of now.
[[nodiscard]] std::vector<std::uint32_t> points_after(std::size_t count, std::span<const Collapse> collapses);

/// The plane of each point after some collapses.
[[nodiscard]] std::vector<std::uint32_t> planes_after(const PointRules& points,
                                                      std::span<const Collapse> collapses);

/// What is left after the first `count` collapses. Faces keep their material and, where no corner moved,
/// their polygon. O(faces).
[[nodiscard]] mesh::LooseFaces replay(const mesh::LooseFaces& loose, std::span<const Collapse> collapses);

}  // namespace ridgecraft::prepare
