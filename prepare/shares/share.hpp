// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a model that is simplified when the rest follows from it. Private to prepare/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/id.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/shares/collapse.hpp"
#include "prepare/symmetry/isometry.hpp"

namespace ridgecraft::prepare {

/// Faces of a model and what they stand for. Where the model is mirrored onto itself these are the faces on
/// one side of the plane, cut where they cross it, and sheets that lie in the plane; else all of them. Of
/// components that are twins it is the first one.
struct SymmetricShare {
  /// What a face and its mirror image carry.
  struct Origin {
    std::uint32_t face = 0;   ///< of the model
    std::uint32_t image = 0;  ///< face of the model that the mirror image lies on; PointRules::none: nothing
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

/// The share after some collapses.
[[nodiscard]] SymmetricShare collapsed(const SymmetricShare& share, std::span<const Collapse> collapses);

}  // namespace ridgecraft::prepare
