// SPDX-License-Identifier: GPL-3.0-or-later
// Cutting off what stands out of a plane. Private to prepare/.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "mesh/model/model.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/features/wall_loops.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// A plane of which one side is its front.
struct PlaneSide {
  Wall plane;
  double sign = 1.0;  ///< -1: what the normal looks away from is in front

  [[nodiscard]] double height(Vec3 p) const { return sign * plane.height(p); }
};

/// What becomes of faces that are cut along a plane.
struct PlaneCut {
  std::vector<FaceId> faces;  ///< that are gone
  Caps rests;                 ///< of them, behind the plane
  Caps caps;                  ///< the plane, where something was cut off
  std::size_t first_point = 0;
};

/// Cuts parts of a model off along planes, one after the other; no face is cut twice.
class PlaneCuts {
 public:
  /// What is no farther from a plane than `in_plane` lies in it. The model stays where it is.
  PlaneCuts(const mesh::Model& model, double in_plane);

  [[nodiscard]] bool is_gone(FaceId f) const { return gone_[f.value()]; }
  [[nodiscard]] bool stands_out(const PlaneSide& side, FaceId f) const;
  /// What hangs together with a face in front of the plane: faces, some of them only with a part. None where
  /// a corner in front of it may not go, or a face is gone. `tried`: faces that were looked at, which aren't
  /// looked at again. O(n log n) for n faces.
  [[nodiscard]] std::vector<FaceId> in_front(const PlaneSide& side, FaceId start,
                                             const std::function<bool(VertexId)>& may_go,
                                             std::set<std::uint32_t>& tried) const;
  /// The faces without what is in front; none where the line along which they are cut isn't closed. `like`:
  /// the face that the caps are like. Until it is made or dropped no other can be looked at.
  [[nodiscard]] std::optional<PlaneCut> look_at(const PlaneSide& side, const std::vector<FaceId>& faces,
                                                FaceId like);
  /// The area of the plane that takes the place of what was cut off.
  [[nodiscard]] double covered(const PlaneCut& cut) const;
  void make(const PlaneCut& cut);
  void drop(const PlaneCut& cut) { all_.points.resize(cut.first_point); }

  /// The model with all of that; false, and as it was, where it would be no surface any more.
  [[nodiscard]] bool finish(mesh::Model& model);

 private:
  struct Line {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> crossing;  ///< of each edge: where the plane is
    std::vector<std::array<std::uint32_t, 2>> sides;  ///< in the plane, as what is cut off runs along it
  };

  std::uint32_t crossing(const PlaneSide& side, VertexId a, VertexId b, Line& line);
  void divide(const PlaneSide& side, FaceId f, PlaneCut& cut, Line& line);
  [[nodiscard]] bool cap(const PlaneSide& side, const Line& line, std::size_t like, Caps& caps) const;

  const mesh::Surface& surface_;
  mesh::LooseFaces all_;  ///< with points where edges cross planes
  double in_plane_;
  std::vector<bool> gone_;
  Caps rests_;
  Caps caps_;
};

}  // namespace ridgecraft::prepare
