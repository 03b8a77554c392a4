// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of a surface as it was read, apart from every change that is made to its faces later: its sharp
// edges, and what hides them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/boxes.hpp"
#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// A sharp edge or a border.
struct Crease {
  std::array<Vec3, 2> ends;
  std::array<Vec3, 2> normals;  ///< of the faces at it; of the same face twice at a border
};

/// All faces and creases of a surface.
struct ReliefParts {
  std::vector<std::array<Vec3, 3>> faces;  ///< their corners
  std::vector<Crease> creases;
};

/// Edges that are folded by so much are creases, radians (40 degrees): those between the facets of round
/// bodies are mostly less.
inline constexpr double crease_angle = 40.0 * 3.14159265358979323846 / 180.0;

/// All faces that have an area, and the creases between them. Nothing where there are no creases. O(n).
[[nodiscard]] std::optional<ReliefParts> relief_of(const Surface& surface);

/// Finds creases, and faces that are in the way of a look.
class Relief {
 public:
  /// Of a surface whose points have become factor * p + shift since. O(n log n).
  explicit Relief(ReliefParts parts, double factor = 1.0, Vec3 shift = {});

  [[nodiscard]] const std::vector<Crease>& creases() const { return parts_.creases; }
  /// Calls visit(i) for creases()[i] whose boxes meet this one.
  template <class Visit>
  void near_box(const Box3& box, Visit visit) const {
    crease_tree_.search([&](std::uint32_t node) { return meet(crease_tree_.box(node), box); },
                        [&](std::uint32_t place) { visit(crease_tree_.order()[place]); });
  }
  /// Whether a face lies on the way from a point to from + way, seen from either side. O(log n) where faces
  /// lie sensibly.
  [[nodiscard]] bool hides(Vec3 from, Vec3 way) const;

 private:
  ReliefParts parts_;
  BoxTree<Box3> face_tree_;
  BoxTree<Box3> crease_tree_;
};

/// A line on a face of another surface.
struct FaceLine {
  FaceId face;
  std::array<Vec3, 2> ends;
};

}  // namespace ridgecraft::mesh
