// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/closing.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/boxes.hpp"
#include "base/delaunay.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {
namespace {

/// Less volume than this share of area times diagonal is none: the opening was a sheet's outline.
constexpr double least_volume = 1e-4;
/// Bent openings with more corners than this stay open: their cube is the time that closing takes.
constexpr std::size_t most_bent_corners = 60;

/// Vertices along an opening, in the direction in which a cap's faces have it: against the surface's sides.
using Rim = std::vector<VertexId>;

/// All faces at a vertex form one fan, so an opening comes to a vertex once.
std::vector<Rim> find_rims(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  std::set<CornerId> open;
  for (const FaceId f : faces) {
    for (unsigned k = 0; k < 3; ++k) {
      if (!surface.twin(mesh::corner(f, k)).valid()) {
        open.insert(mesh::corner(f, k));
      }
    }
  }
  std::vector<Rim> rims;
  while (!open.empty()) {
    const CornerId start = *open.begin();
    Rim rim;
    CornerId at = start;
    do {
      open.erase(at);
      rim.push_back(surface.vertex(mesh::next(at)));
      // Around the first vertex of this side to the side that ends there.
      CornerId before = mesh::previous(at);
      while (surface.twin(before).valid()) {
        before = mesh::previous(surface.twin(before));
      }
      at = before;
    } while (at != start);
    rims.push_back(std::move(rim));
  }
  return rims;
}

/// Newell's normal, as long as twice the area.
Vec3 normal_of(const mesh::Surface& surface, const Rim& rim) {
  const Vec3 origin = surface.point(rim[0]);
  Vec3 normal;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    normal += cross(surface.point(rim[i]) - origin, surface.point(rim[(i + 1) % rim.size()]) - origin);
  }
  return normal;
}

std::optional<Cap> cap_of(const mesh::Surface& surface, const Rim& rim, double flat) {
  const Vec3 normal = normalized(normal_of(surface, rim));
  if (normal == Vec3{}) {
    return std::nullopt;
  }
  Vec3 middle;
  for (const VertexId v : rim) {
    middle += surface.point(v) / static_cast<double>(rim.size());
  }
  const PlaneFrame frame(middle, normal);
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (std::uint32_t i = 0; i < rim.size(); ++i) {
    const Vec3 p = surface.point(rim[i]);
    if (std::abs(dot(p - middle, normal)) > flat) {
      return std::nullopt;
    }
    points.push_back(frame.flat(p));
    sides.push_back({i, i + 1 < rim.size() ? i + 1 : 0});
  }
  const auto triangles = triangulate_inside(points, sides);
  if (!triangles) {
    return std::nullopt;
  }
  Cap cap;
  for (const auto& [a, b, c] : *triangles) {
    cap.triangles.push_back({rim[a], rim[b], rim[c]});
  }
  return cap;
}

/// The triangles over the corners of a bent opening with the least area.
std::optional<Cap> bent_cap_of(const mesh::Surface& surface, const Rim& rim) {
  const std::size_t n = rim.size();
  if (n > most_bent_corners) {
    return std::nullopt;
  }
  const auto area = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Vec3 a = surface.point(rim[i]);
    return length(cross(surface.point(rim[j]) - a, surface.point(rim[k]) - a));
  };
  // Of the corners i .. k: the least area over them, and the corner between them that it takes.
  std::vector<std::vector<double>> least(n, std::vector<double>(n, 0.0));
  std::vector<std::vector<std::size_t>> between(n, std::vector<std::size_t>(n, 0));
  for (std::size_t span = 2; span < n; ++span) {
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t k = i + span;
      for (std::size_t j = i + 1; j < k; ++j) {
        const double sum = least[i][j] + least[j][k] + area(i, j, k);
        if (j == i + 1 || sum < least[i][k]) {
          least[i][k] = sum;
          between[i][k] = j;
        }
      }
    }
  }
  Cap cap;
  cap.bent = true;
  std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i > 1) {
      const std::size_t j = between[i][k];
      cap.triangles.push_back({rim[i], rim[j], rim[k]});
      open.push_back({i, j});
      open.push_back({j, k});
    }
  }
  return cap;
}

/// Is what faces and caps enclose more than a sheet?
bool holds_something(const mesh::Surface& surface, const std::vector<FaceId>& faces,
                     const std::vector<Cap>& caps) {
  const Vec3 origin = surface.point(surface.vertices(faces[0])[0]);
  double volume = 0.0;
  double area = 0.0;
  Box3 box;
  const auto add = [&](const std::array<VertexId, 3>& t) {
    const Vec3 a = surface.point(t[0]) - origin;
    const Vec3 b = surface.point(t[1]) - origin;
    const Vec3 c = surface.point(t[2]) - origin;
    volume += dot(a, cross(b, c)) / 6.0;
    area += 0.5 * length(cross(b - a, c - a));
    box.add(a);
    box.add(b);
    box.add(c);
  };
  for (const FaceId f : faces) {
    add(surface.vertices(f));
  }
  for (const Cap& cap : caps) {
    for (const auto& t : cap.triangles) {
      add(t);
    }
  }
  return std::abs(volume) > least_volume * area * box.diagonal();
}

}  // namespace

std::vector<Cap> find_caps(const mesh::Surface& surface, const std::vector<FaceId>& faces, double flat) {
  std::vector<Cap> caps;
  for (const Rim& rim : find_rims(surface, faces)) {
    std::optional<Cap> cap = cap_of(surface, rim, flat);
    if (!cap) {
      cap = bent_cap_of(surface, rim);
    }
    if (!cap) {
      return {};
    }
    caps.push_back(std::move(*cap));
  }
  return holds_something(surface, faces, caps) ? caps : std::vector<Cap>();
}

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
