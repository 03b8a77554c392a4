// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/divided_valleys.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "base/elementary.hpp"

namespace ridgecraft::segment {
namespace {

/// What is folded up by less is no notch of its own.
constexpr double least_fold = 5.0 * std::numbers::pi / 180.0;
/// A fold of less is none.
constexpr double flat = 1e-3;
/// A valley goes on at a vertex along another concave edge that turns by at most this much.
const double goes_on = elementary::cos(60.0 * std::numbers::pi / 180.0);

std::array<VertexId, 2> ends_of(const mesh::Surface& surface, EdgeId e) {
  const CornerId c = surface.sides(e)[0];
  return {surface.vertex(c), surface.vertex(mesh::next(c))};
}

class Valleys {
 public:
  Valleys(const mesh::Surface& surface, double shortest)
      : surface_(surface), shortest_(shortest * 0.5 * surface.bounds().diagonal()) {}

  /// Vertices at the ends of lonely valleys.
  [[nodiscard]] std::vector<VertexId> ends() const {
    std::vector<VertexId> result;
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      if (is_lonely(e)) {
        const auto [a, b] = ends_of(surface_, e);
        result.push_back(a);
        result.push_back(b);
      }
    }
    return result;
  }

 private:
  [[nodiscard]] bool is_lonely(EdgeId e) const {
    return is_valley(e) && surface_.length(e) > shortest_ && ends_at(e, 0) && ends_at(e, 1);
  }

  [[nodiscard]] bool is_valley(EdgeId e) const { return surface_.fold_angle(e) >= least_fold; }

  [[nodiscard]] bool ends_at(EdgeId e, std::size_t end) const {
    const auto both = ends_of(surface_, e);
    const VertexId v = both[end];
    const Vec3 here = normalized(surface_.point(v) - surface_.point(both[1 - end]));
    const auto continues = [&](CornerId side) {
      const EdgeId other = surface_.edge(side);
      if (other == e || !is_valley(other)) {
        return false;
      }
      const auto [a, b] = ends_of(surface_, other);
      const Vec3 there = normalized(surface_.point(a == v ? b : a) - surface_.point(v));
      return dot(here, there) >= goes_on;
    };
    const auto corners = surface_.corners_at(v);
    return std::none_of(corners.begin(), corners.end(),
                        [&](CornerId c) { return continues(c) || continues(mesh::previous(c)); });
  }

  const mesh::Surface& surface_;
  double shortest_;
};

/// The pieces of a triangle with a point, or none, in the middle of each of its sides.
std::vector<std::array<VertexId, 3>> pieces(const std::array<VertexId, 3>& v,
                                            const std::array<VertexId, 3>& middle) {
  const auto count = std::count_if(middle.begin(), middle.end(), [](VertexId m) { return m.valid(); });
  if (count == 0) {
    return {v};
  }
  if (count == 3) {
    return {{v[0], middle[0], middle[2]}, {middle[0], v[1], middle[1]}, {middle[2], middle[1], v[2]}, middle};
  }
  // Turned so that side 0 has a point, and side 2 has none.
  std::size_t k = 0;
  while (!middle[k].valid() || middle[(k + 2) % 3].valid()) {
    ++k;
  }
  const auto [a, b, c] = std::array{v[k], v[(k + 1) % 3], v[(k + 2) % 3]};
  const VertexId ab = middle[k];
  const VertexId bc = middle[(k + 1) % 3];
  if (!bc.valid()) {
    return {{a, ab, c}, {ab, b, c}};
  }
  return {{ab, b, bc}, {a, ab, bc}, {a, bc, c}};
}

/// Halves the edges whose both ends are in valleys and that aren't convex: the valleys, and what leads from
/// one to the next. Along a wall of many faces these points would have no way between each other but the
/// rims.
void halve(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
           const std::vector<bool>& in_valley, DividedValleys& divided) {
  std::vector<Vec3> points(surface.points().begin(), surface.points().end());
  IdVector<EdgeId, VertexId> middle;
  middle.resize(surface.edge_count());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [a, b] = ends_of(surface, e);
    if (in_valley[a.value()] && in_valley[b.value()] && surface.fold_angle(e) > -flat) {
      middle[e] = VertexId(points.size());
      points.push_back(0.5 * (surface.point(a) + surface.point(b)));
    }
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto on_side = [&](unsigned k) { return middle[surface.edge(mesh::corner(f, k))]; };
    for (const std::array<VertexId, 3>& piece :
         pieces(surface.vertices(f), {on_side(0), on_side(1), on_side(2)})) {
      faces.push_back(piece);
      divided.face_of.push_back(f);
      divided.polygon.push_back(polygon.empty() ? f.value() : polygon[f.value()]);
    }
  }
  divided.surface = mesh::Surface(std::move(points), std::move(faces));
}

}  // namespace

void DividedValleys::to_given_numbers(Part& part) const {
  for (FaceId& f : part.faces) {
    f = face_of[f.value()];
  }
  part.faces.erase(std::unique(part.faces.begin(), part.faces.end()), part.faces.end());
  std::erase_if(part.hull_vertices, [&](VertexId v) { return v.value() >= given_vertices; });
}

DividedValleys divide_valleys(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                              double shortest) {
  const std::vector<VertexId> ends = Valleys(surface, shortest).ends();
  DividedValleys divided;
  if (ends.empty()) {
    return divided;
  }
  divided.given_vertices = surface.vertex_count();
  std::vector<bool> in_valley(surface.vertex_count(), false);
  for (const VertexId v : ends) {
    in_valley[v.value()] = true;
  }
  halve(surface, polygon, in_valley, divided);
  return divided;
}

}  // namespace ridgecraft::segment
