// SPDX-License-Identifier: GPL-3.0-or-later
// Edge collapses as values, and what they make of points and faces. Private to prepare/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
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
