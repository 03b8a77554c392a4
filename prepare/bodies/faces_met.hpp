// SPDX-License-Identifier: GPL-3.0-or-later
// Which face is met on a straight way. Private to prepare/.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/boxes.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {

/// Some faces of a surface, which must outlive it, as what is in the way.
class FacesMet {
 public:
  struct Met {
    FaceId face;
    double at = 0.0;  ///< as a share of the way
  };

  /// `hair`: what faces are larger on all sides than they are, as a share of a way. O(n log n).
  FacesMet(const mesh::Surface& surface, std::vector<FaceId> faces, double hair)
      : surface_(surface),
        faces_(std::move(faces)),
        hair_(hair),
        tree_(
            faces_.size(), [&](std::uint32_t i) { return surface.bounds(faces_[i]); },
            [&](std::uint32_t i) { return centre(surface.bounds(faces_[i])); }) {}

  /// The nearest face that the way from p to p + way meets, p left out, among those that `counts` says so of.
  /// O(log n) where faces lie sensibly.
  template <class Counts>
  [[nodiscard]] std::optional<Met> find(Vec3 p, Vec3 way, const Counts& counts) const {
    Box3 box;
    box.add(p);
    box.add(p + way);
    box = grown(box, hair_ * length(way));
    std::optional<Met> nearest;
    tree_.search([&](std::uint32_t node) { return meet(box, tree_.box(node)); },
                 [&](std::uint32_t place) {
                   const FaceId f = faces_[tree_.order()[place]];
                   const std::optional<double> at = counts(f) ? meets_at(f, p, way) : std::nullopt;
                   if (at && (!nearest || *at < nearest->at)) {
                     nearest = Met{f, *at};
                   }
                 });
    return nearest;
  }

 private:
  [[nodiscard]] std::optional<double> meets_at(FaceId f, Vec3 p, Vec3 way) const {
    const auto [a, b, c] = surface_.vertices(f);
    const double along = dot(surface_.normal(f), way);
    const double at = dot(surface_.normal(f), surface_.point(a) - p) / along;
    if (along == 0.0 || !(at > 0.0 && at <= 1.0)) {
      return std::nullopt;
    }
    const double off =
        mesh::squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), p + at * way);
    const double hair = hair_ * length(way);
    return off <= hair * hair ? std::optional(at) : std::nullopt;
  }

  const mesh::Surface& surface_;
  std::vector<FaceId> faces_;
  double hair_;
  BoxTree<Box3> tree_;
};

}  // namespace ridgecraft::prepare
