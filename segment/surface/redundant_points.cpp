// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/surface/redundant_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::segment {
namespace {

/// Folds and turns of less, radians, may be those of a file's digits; places decide.
constexpr double hardly = 1e-3;
constexpr double straight_cosine = 1.0 - 0.5 * hardly * hardly;
/// What was divided lies within this share of the diagonal where it should.
constexpr double in_place = 1e-6;
/// Straight lines that lead to no corner are followed for so many steps an edge, all in all.
constexpr std::size_t steps_per_edge = 4;

struct Way {
  VertexId to;
  EdgeId edge;
};

/// Finds the triangles that were divided.
class TriangleFinder {
 public:
  TriangleFinder(const mesh::Surface& surface, std::span<const std::uint32_t> label)
      : surface_(surface),
        label_(label),
        tolerance_(in_place * surface.bounds().diagonal()),
        corner_(surface.vertex_count(), true),
        separates_(surface.edge_count(), false) {}

  /// False where no vertex is one that a division may have made.
  bool find_corners() {
    // Of each vertex: how many sides end there, and where two of them lead.
    std::vector<std::uint32_t> sides(surface_.vertex_count(), 0);
    std::vector<std::array<VertexId, 2>> beyond(surface_.vertex_count());
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      separates_[e.value()] = is_crease(e);
      if (separates_[e.value()]) {
        const CornerId c = surface_.sides(e)[0];
        const std::array ends{surface_.vertex(c), surface_.vertex(mesh::next(c))};
        for (const std::size_t k : {0U, 1U}) {
          const std::size_t v = ends[k].value();
          beyond[v][sides[v]++ % 2] = ends[1 - k];
        }
      }
    }
    for (const VertexId v : ids<VertexId>(surface_.vertex_count())) {
      const std::size_t i = v.value();
      corner_[i] = sides[i] != 0 && (sides[i] != 2 || !goes_straight(beyond[i][0], v, beyond[i][1]));
    }
    return std::find(corner_.begin(), corner_.end(), false) != corner_.end();
  }

  /// Marks the straight chains of edges from corner to corner. False where that takes too long.
  bool find_sides() {
    std::size_t steps = 0;
    std::vector<EdgeId> chain;
    for (const VertexId v : ids<VertexId>(surface_.vertex_count())) {
      if (!corner_[v.value()]) {
        continue;
      }
      for (const Way& first : ways_from(v)) {
        chain.assign(1, first.edge);
        if (follow(v, first.to, chain)) {
          for (const EdgeId e : chain) {
            separates_[e.value()] = true;
          }
        }
        steps += chain.size();
        if (steps > steps_per_edge * (surface_.edge_count() + 1)) {
          return false;
        }
      }
    }
    return true;
  }

  [[nodiscard]] bool is_kept(VertexId v) const { return corner_[v.value()]; }
  [[nodiscard]] bool separates(EdgeId e) const { return separates_[e.value()]; }

  /// The triangle that these faces fill, if they fill one.
  [[nodiscard]] std::optional<std::array<VertexId, 3>> triangle_of(std::span<const FaceId> faces) const {
    if (faces.size() == 1) {
      const std::array<VertexId, 3> own = surface_.vertices(faces[0]);
      return std::all_of(own.begin(), own.end(), [&](VertexId v) { return is_kept(v); }) ? std::optional(own)
                                                                                         : std::nullopt;
    }
    std::vector<VertexId> corners;
    Vec3 doubled;
    double area = 0.0;
    for (const FaceId f : faces) {
      for (const VertexId v : surface_.vertices(f)) {
        if (is_kept(v) && std::find(corners.begin(), corners.end(), v) == corners.end()) {
          corners.push_back(v);
        }
      }
      if (corners.size() > 3) {
        return std::nullopt;
      }
      doubled += (2.0 * surface_.area(f)) * surface_.normal(f);
      area += surface_.area(f);
    }
    if (corners.size() != 3) {
      return std::nullopt;
    }
    std::array<VertexId, 3> t{corners[0], corners[1], corners[2]};
    const auto normal_of = [&] {
      return cross(surface_.point(t[1]) - surface_.point(t[0]), surface_.point(t[2]) - surface_.point(t[0]));
    };
    if (dot(normal_of(), doubled) < 0.0) {
      std::swap(t[1], t[2]);
    }
    return fills(faces, t, normal_of(), area) ? std::optional(t) : std::nullopt;
  }

 private:
  [[nodiscard]] bool is_crease(EdgeId e) const {
    if (surface_.is_border(e) || std::abs(surface_.fold_angle(e)) > hardly) {
      return true;
    }
    const auto [c, t] = surface_.sides(e);
    return !label_.empty() && label_[mesh::face_of(c).value()] != label_[mesh::face_of(t).value()];
  }

  /// The edges at a vertex, each once.
  [[nodiscard]] std::vector<Way> ways_from(VertexId v) const {
    std::vector<Way> ways;
    for (const CornerId c : surface_.corners_at(v)) {
      ways.push_back({surface_.vertex(mesh::next(c)), surface_.edge(c)});
      if (const CornerId before = mesh::previous(c); !surface_.twin(before).valid()) {
        ways.push_back({surface_.vertex(before), surface_.edge(before)});
      }
    }
    return ways;
  }

  [[nodiscard]] bool goes_straight(VertexId from, VertexId over, VertexId to) const {
    const Vec3 in = surface_.point(over) - surface_.point(from);
    const Vec3 out = surface_.point(to) - surface_.point(over);
    return dot(in, out) >= straight_cosine * length(in) * length(out);
  }

  /// Adds the edges straight on to the next corner; false where there is none.
  bool follow(VertexId from, VertexId at, std::vector<EdgeId>& chain) const {
    while (!is_kept(at)) {
      const std::vector<Way> ways = ways_from(at);
      const auto on = std::find_if(ways.begin(), ways.end(), [&](const Way& way) {
        return way.to != from && goes_straight(from, at, way.to);
      });
      if (on == ways.end() || chain.size() > surface_.edge_count()) {
        return false;
      }
      chain.push_back(on->edge);
      from = std::exchange(at, on->to);
    }
    return true;
  }

  /// Whether the faces lie in the triangle, their outer sides on its sides, and cover it.
  [[nodiscard]] bool fills(std::span<const FaceId> faces, const std::array<VertexId, 3>& triangle,
                           Vec3 doubled, double area) const {
    const double size = length(doubled);
    const std::array<Vec3, 3> at{surface_.point(triangle[0]), surface_.point(triangle[1]),
                                 surface_.point(triangle[2])};
    const double perimeter = length(at[1] - at[0]) + length(at[2] - at[1]) + length(at[0] - at[2]);
    if (!(size > tolerance_ * perimeter) || std::abs(0.5 * size - area) > tolerance_ * perimeter) {
      return false;
    }
    const Vec3 normal = doubled / size;
    const auto on_side = [&](Vec3 p) {
      return std::min({distance_to_segment(p, at[0], at[1]), distance_to_segment(p, at[1], at[2]),
                       distance_to_segment(p, at[2], at[0])}) <= tolerance_;
    };
    return std::all_of(faces.begin(), faces.end(), [&](FaceId f) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(f, k);
        const Vec3 p = surface_.point(surface_.vertex(c));
        if (std::abs(dot(p - at[0], normal)) > tolerance_ ||
            (separates(surface_.edge(c)) &&
             !(on_side(p) && on_side(surface_.point(surface_.vertex(mesh::next(c))))))) {
          return false;
        }
      }
      return true;
    });
  }

  const mesh::Surface& surface_;
  std::span<const std::uint32_t> label_;
  double tolerance_;
  std::vector<bool> corner_;     ///< of each vertex
  std::vector<bool> separates_;  ///< of each edge: sides of triangles
};

/// Faces with no side of a triangle between them, by the smallest of each.
std::vector<std::vector<FaceId>> cells_of(const mesh::Surface& surface, const TriangleFinder& finder) {
  DisjointSets sets(surface.face_count());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, t] = surface.sides(e);
    if (!finder.separates(e)) {
      sets.join(mesh::face_of(c).value(), mesh::face_of(t).value());
    }
  }
  std::vector<std::vector<FaceId>> cells;
  std::vector<std::uint32_t> number(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const std::uint32_t first = sets.find(f.value());
    if (first == f.value()) {
      number[first] = static_cast<std::uint32_t>(cells.size());
      cells.emplace_back();
    }
    cells[number[first]].push_back(f);
  }
  return cells;
}

/// No two faces run the same way along an edge.
bool has_each_side_once(const std::vector<std::array<VertexId, 3>>& faces) {
  std::vector<std::pair<VertexId, VertexId>> sides;
  for (const auto& [a, b, c] : faces) {
    sides.insert(sides.end(), {{a, b}, {b, c}, {c, a}});
  }
  std::sort(sides.begin(), sides.end());
  return std::adjacent_find(sides.begin(), sides.end()) == sides.end();
}

/// Faces of one polygon, and polygons of one face, stay together.
std::vector<std::uint32_t> polygons_of(std::span<const std::uint32_t> polygon,
                                       const std::vector<FaceId>& face_of, std::size_t face_count) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> of_polygon;
  for (std::size_t f = 0; f < polygon.size(); ++f) {
    of_polygon.emplace_back(polygon[f], face_of[f].value());
  }
  std::sort(of_polygon.begin(), of_polygon.end());
  DisjointSets together(face_count);
  for (std::size_t i = 1; i < of_polygon.size(); ++i) {
    if (of_polygon[i].first == of_polygon[i - 1].first) {
      together.join(of_polygon[i].second, of_polygon[i - 1].second);
    }
  }
  std::vector<std::uint32_t> result(face_count);
  for (std::uint32_t f = 0; f < face_count; ++f) {
    result[f] = together.find(f);
  }
  return result;
}

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

void Undivided::to_given_numbers(Part& part) const {
  std::vector<bool> in_part(surface.face_count(), false);
  for (const FaceId f : part.faces) {
    in_part[f.value()] = true;
  }
  part.faces.clear();
  for (const FaceId f : ids<FaceId>(face_of.size())) {
    if (in_part[face_of[f.value()].value()]) {
      part.faces.push_back(f);
    }
  }
  for (VertexId& v : part.hull_vertices) {
    v = vertex_of[v.value()];
  }
}

Undivided undivide(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                   std::span<const std::uint32_t> label) {
  TriangleFinder finder(surface, label);
  if (!finder.find_corners() || !finder.find_sides()) {
    return {};
  }
  const std::vector<std::vector<FaceId>> cells = cells_of(surface, finder);
  std::vector<std::optional<std::array<VertexId, 3>>> triangles;
  std::vector<bool> stays(surface.component_count(), false);
  for (const std::vector<FaceId>& cell : cells) {
    triangles.push_back(finder.triangle_of(cell));
    if (!triangles.back()) {
      stays[surface.component(cell[0]).value()] = true;
    }
  }
  std::vector<std::array<VertexId, 3>> faces;
  Undivided result;
  result.face_of.resize(surface.face_count());
  const auto add = [&](const std::array<VertexId, 3>& face, std::span<const FaceId> pieces) {
    for (const FaceId f : pieces) {
      result.face_of[f.value()] = FaceId(faces.size());
    }
    faces.push_back(face);
    if (!label.empty()) {
      result.label.push_back(label[pieces[0].value()]);
    }
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!stays[surface.component(cells[i][0]).value()]) {
      add(*triangles[i], cells[i]);
    } else {
      for (const FaceId& f : cells[i]) {
        add(surface.vertices(f), {&f, 1});
      }
    }
  }
  if (faces.size() == surface.face_count() || !has_each_side_once(faces)) {
    return {};
  }
  IdVector<VertexId, VertexId> number(surface.vertex_count());
  for (const auto& face : faces) {
    for (const VertexId v : face) {
      number[v] = v;  // any: it stays
    }
  }
  std::vector<Vec3> points;
  for (const VertexId v : ids<VertexId>(surface.vertex_count())) {
    if (number[v].valid()) {
      number[v] = VertexId(points.size());
      points.push_back(surface.point(v));
      result.vertex_of.push_back(v);
    }
  }
  for (auto& face : faces) {
    for (VertexId& v : face) {
      v = number[v];
    }
  }
  result.polygon = polygons_of(polygon, result.face_of, faces.size());
  result.surface = mesh::Surface(std::move(points), std::move(faces));
  return result;
}

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
