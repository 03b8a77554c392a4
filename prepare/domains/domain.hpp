// SPDX-License-Identifier: GPL-3.0-or-later
// The faces from which symmetry makes all others, and edge collapses in them. Private to prepare/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "base/no_index.hpp"
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

/// What the faces stand for, where they are a domain of a symmetric whole (FundamentalDomain).
struct PointRules {
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

/// Faces of a model and what they stand for. Where the model is mirrored onto itself these are the faces on
/// one side of the plane, cut where they cross it, and sheets that lie in the plane; else all of them. Of
/// components that are twins it is the first one.
struct FundamentalDomain {
  /// What a face and its mirror image carry.
  struct Origin {
    std::uint32_t face = 0;   ///< of the model
    std::uint32_t image = 0;  ///< face of the model that the mirror image lies on; no_index: nothing
  };
  /// A twin of one of the bodies, moved.
  struct Copy {
    std::uint32_t body = 0;  ///< component of the model that it is a copy of
    Isometry motion;
    std::vector<Origin> origins;  ///< of the body's faces, by their rank
  };
  /// With numbers of origins for materials, so that what becomes of a face finds them.
  mesh::LooseFaces faces;
  PointRules points;  ///< one plane, or none
  std::vector<Origin> origins;
  std::vector<std::uint32_t> body;  ///< of each origin: the component of the model
  std::vector<std::uint32_t> rank;  ///< of each origin: how many of its body come before it
  std::vector<Copy> copies;         ///< each with a mirror image where the model is symmetric
  IdVector<FaceId, FaceId> image;   ///< of the faces of a symmetric model
  /// Greatest distance between a corner of the model and what its other side makes of it, in its unit.
  double deviation = 0.0;

  [[nodiscard]] bool symmetric() const { return !points.planes.empty(); }
  /// Of the whole, about: as if all points of the cut were gone.
  [[nodiscard]] std::size_t face_count() const;
};

/// The domain after some collapses.
[[nodiscard]] FundamentalDomain collapsed(const FundamentalDomain& domain,
                                          std::span<const Collapse> collapses);

/// All faces that a domain stands for, with the model's own materials and polygons. What lies on one side of
/// a plane has its mirror image, with mirrored coordinates exactly, on the other. Points of the cut are gone
/// where the faces across it are flat. O(n log n).
[[nodiscard]] mesh::LooseFaces expand(const FundamentalDomain& domain, const mesh::LooseFaces& model);

/// One domain for each component that is in the domain, in the order of the components' numbers; complete in
/// themselves, each with its own copies. O(n log n).
[[nodiscard]] std::vector<FundamentalDomain> divided(const FundamentalDomain& domain);

/// The domain of all that they are domains of. They must have the same planes. O(n).
[[nodiscard]] FundamentalDomain joined(const std::vector<FundamentalDomain>& domains);

}  // namespace ridgecraft::prepare
