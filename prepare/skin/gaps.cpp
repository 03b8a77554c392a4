// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/gaps.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "base/boxes.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {
namespace {

/// The nearest place of a face is straight before it where its distance from the plane is this share of all.
constexpr double straight = 0.999;
/// With fewer corners no face of a body lies before the other one.
constexpr std::size_t fewest_corners = 3;
/// Edges that run into a face at less than this (its sine, 30 degrees) lead too far.
constexpr double steep = 0.5;

class Closer {
 public:
  Closer(const mesh::Surface& surface, const std::vector<bool>& solid, double least, double most)
      : surface_(surface),
        least_(least),
        most_(most),
        faces_(faces_of(surface, solid)),
        tree_(
            faces_.size(), [&](std::uint32_t i) { return surface.bounds(faces_[i]); },
            [&](std::uint32_t i) { return surface.point(surface.vertices(faces_[i])[0]); }),
        size_(surface.component_count()) {
    std::vector<Box3> boxes(surface.component_count());
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      for (const VertexId v : surface.vertices(f)) {
        boxes[surface.component(f).value()].add(surface.point(v));
      }
    }
    for (std::size_t c = 0; c < boxes.size(); ++c) {
      size_[c] = boxes[c].diagonal();
    }
  }

  [[nodiscard]] ClosedGaps run(const std::vector<bool>& solid, const Context& context) const {
    struct Move {
      VertexId vertex;
      ComponentId own, other;
      Vec3 place;
    };
    std::vector<Move> moves;
    std::map<std::pair<ComponentId, ComponentId>, std::size_t> corners;
    for (const VertexId v : ids<VertexId>(surface_.vertex_count())) {
      if (v.value() % 4096 == 0) {
        context.check();
      }
      const ComponentId own = surface_.component(mesh::face_of(surface_.corners_at(v)[0]));
      const auto target = solid[own.value()] ? moved(v, own) : std::nullopt;
      if (target) {
        moves.push_back({v, own, target->component, target->place});
        ++corners[{own, target->component}];
      }
    }
    ClosedGaps result;
    result.points.assign(surface_.points().begin(), surface_.points().end());
    for (const Move& move : moves) {
      if (corners[{move.own, move.other}] >= fewest_corners) {
        result.points[move.vertex.value()] = move.place;
        ++result.moved;
      }
    }
    return result;
  }

 private:
  static std::vector<FaceId> faces_of(const mesh::Surface& surface, const std::vector<bool>& solid) {
    std::vector<FaceId> faces;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      if (solid[surface.component(f).value()] && surface.normal(f) != Vec3{}) {
        faces.push_back(f);
      }
    }
    return faces;
  }
  [[nodiscard]] bool is_smaller(ComponentId a, ComponentId b) const {
    return std::tuple(size_[a.value()], a) < std::tuple(size_[b.value()], b);
  }

  struct Nearest {
    double squared = 0.0;  ///< nothing farther counts
    FaceId face;
  };

  /// The nearest face of another component.
  [[nodiscard]] Nearest nearest(Vec3 p, ComponentId own) const {
    return tree_.nearest_first(
        p, Nearest{most_ * most_, FaceId()},
        [](const Nearest& found, std::uint32_t, double squared) { return squared <= found.squared; },
        [&](Nearest& found, std::uint32_t place) {
          const FaceId f = faces_[tree_.order()[place]];
          if (surface_.component(f) == own) {
            return;
          }
          const auto [a, b, c] = surface_.vertices(f);
          const double squared =
              mesh::squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), p);
          if (squared <= found.squared) {
            found = {squared, f};
          }
        });
  }

  struct Target {
    ComponentId component;
    Vec3 place;
  };

  [[nodiscard]] std::optional<Target> moved(VertexId v, ComponentId own) const {
    const Vec3 p = surface_.point(v);
    const Nearest found = nearest(p, own);
    const double distance = std::sqrt(found.squared);
    if (!found.face.valid() || distance <= least_ || !is_smaller(own, surface_.component(found.face))) {
      return std::nullopt;
    }
    const Vec3 normal = surface_.normal(found.face);
    const double before = dot(p - surface_.point(surface_.vertices(found.face)[0]), normal);
    if (before < straight * distance) {
      return std::nullopt;
    }
    // An edge that leads there keeps the planes beside it.
    Vec3 way = -normal;
    double best = steep;
    for (const CornerId c : surface_.corners_at(v)) {
      for (const CornerId other : {mesh::next(c), mesh::previous(c)}) {
        const Vec3 along = normalized(p - surface_.point(surface_.vertex(other)));
        if (-dot(along, normal) > best) {
          best = -dot(along, normal);
          way = along;
        }
      }
    }
    return Target{surface_.component(found.face), p + (before + least_) / -dot(way, normal) * way};
  }

  const mesh::Surface& surface_;
  double least_;
  double most_;
  std::vector<FaceId> faces_;
  BoxTree<Box3> tree_;
  std::vector<double> size_;  ///< of each component
};

}  // namespace

ClosedGaps close_gaps(const mesh::Surface& surface, const std::vector<bool>& solid, double least, double most,
                      const Context& context) {
  return Closer(surface, solid, least, most).run(solid, context);
}

}  // namespace ridgecraft::prepare
