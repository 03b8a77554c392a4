// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/delaunay.hpp"
#include "base/disjoint_sets.hpp"
#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/geometry.hpp"
#include "base/no_index.hpp"

namespace ridgecraft::mesh {

// By value: who gives the faces away needn't hold them beside the corners that they become.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
Surface::Surface(std::vector<Vec3> points, std::vector<std::array<VertexId, 3>> faces)
    : points_(std::move(points)) {
  corners_.reserve(3 * faces.size());
  for (const auto& face : faces) {
    corners_.insert(corners_.end(), face.begin(), face.end());
  }
  connect();
  measure();
  find_components();
}

void Surface::connect() {
  const std::size_t n = corners_.size();
  // Counting sort of the corners by vertex; the faces of each vertex come in ascending order.
  vertex_first_.assign(points_.size() + 1, 0);
  for (const VertexId v : corners_) {
    RIDGECRAFT_ASSERT(v.value() < points_.size());
    ++vertex_first_[v.value() + 1];
  }
  for (std::size_t v = 0; v < points_.size(); ++v) {
    vertex_first_[v + 1] += vertex_first_[v];
  }
  vertex_corners_.resize(n);
  std::vector<std::uint32_t> fill(vertex_first_.begin(), vertex_first_.end() - (points_.empty() ? 0 : 1));
  for (std::size_t c = 0; c < n; ++c) {
    vertex_corners_[fill[corners_[c].value()]++] = CornerId(c);
  }

  twins_.assign(n, CornerId());
  corner_edges_.assign(n, EdgeId());
  edges_.reserve(n / 2 + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const CornerId c(i);
    if (corner_edges_[i].valid()) {
      continue;
    }
    const VertexId from = vertex(c);
    const VertexId to = vertex(next(c));
    RIDGECRAFT_ASSERT(from != to);
    // Look from the end with fewer faces, so that the hub of a large fan costs no more than its rim.
    CornerId twin;
    if (corners_at(to).size() <= corners_at(from).size()) {
      for (const CornerId d : corners_at(to)) {
        if (vertex(next(d)) == from) {
          RIDGECRAFT_ASSERT(!twin.valid());
          twin = d;
        }
      }
    } else {
      for (const CornerId d : corners_at(from)) {
        if (vertex(previous(d)) == to) {
          RIDGECRAFT_ASSERT(!twin.valid());
          twin = previous(d);
        }
      }
    }
    const EdgeId e(edges_.size());
    edges_.push_back({c, twin});
    corner_edges_[i] = e;
    twins_[i] = twin;
    if (twin.valid()) {
      RIDGECRAFT_ASSERT(!corner_edges_[twin.value()].valid());
      corner_edges_[twin.value()] = e;
      twins_[twin.value()] = c;
    }
  }
}

void Surface::measure() {
  for (const Vec3 p : points_) {
    bounds_.add(p);
  }
  areas_.resize(face_count());
  normals_.resize(face_count());
  for (const FaceId f : ids<FaceId>(face_count())) {
    const auto [a, b, c] = vertices(f);
    const Vec3 doubled = ridgecraft::cross(point(b) - point(a), point(c) - point(a));
    areas_[f.value()] = 0.5 * ridgecraft::length(doubled);
    normals_[f.value()] = normalized(doubled);
  }
  lengths_.resize(edge_count());
  fold_angles_.resize(edge_count());
  for (const EdgeId e : ids<EdgeId>(edge_count())) {
    const auto [c, d] = sides(e);
    const Vec3 along = point(vertex(next(c))) - point(vertex(c));
    lengths_[e.value()] = ridgecraft::length(along);
    if (d.valid()) {
      const Vec3 n = normal(face_of(c));
      const Vec3 m = normal(face_of(d));
      // n x m points along the side of c where the edge is convex, against it where it is concave.
      const double sine = dot(ridgecraft::cross(n, m), normalized(along));
      const double cosine = dot(n, m);
      fold_angles_[e.value()] = sine == 0.0 && cosine == 0.0 ? 0.0 : -elementary::atan2(sine, cosine);
    }
  }
}

void Surface::find_components() {
  DisjointSets sets(face_count());
  for (const auto& [c, d] : edges_) {
    if (d.valid()) {
      sets.join(face_of(c).value(), face_of(d).value());
    }
  }
  components_.resize(face_count());
  for (const FaceId f : ids<FaceId>(face_count())) {
    const FaceId first(sets.find(f.value()));
    components_[f.value()] = first == f ? ComponentId(component_count_++) : components_[first.value()];
  }
}

Box3 Surface::bounds(FaceId f) const {
  Box3 box;
  for (const VertexId v : vertices(f)) {
    box.add(point(v));
  }
  return box;
}

std::vector<Box3> component_bounds(const Surface& surface) {
  std::vector<Box3> bounds(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    for (const VertexId v : surface.vertices(f)) {
      bounds[surface.component(f).value()].add(surface.point(v));
    }
  }
  return bounds;
}

double total_area(const Surface& surface) {
  double area = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    area += surface.area(f);
  }
  return area;
}

namespace {

// Whether points and triangles of others are a surface as they stand.

using Faces = std::span<const std::array<VertexId, 3>>;

template <typename... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> sentence, Values&&... values) {
  throw Error(ErrorKind::unusable_mesh, fmt::format(sentence, std::forward<Values>(values)...));
}

void check_points(std::span<const Vec3> points) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3 p = points[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      refuse("point {} has a coordinate that isn't a finite number", v);
    }
  }
}

void check_corners(std::size_t point_count, Faces faces) {
  std::vector<bool> named(point_count, false);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const VertexId v : faces[f]) {
      if (!v.valid() || v.value() >= point_count) {
        refuse("face {} names a vertex that isn't there; there are {}", f, point_count);
      }
      named[v.value()] = true;
    }
    const auto [a, b, c] = faces[f];
    if (a == b || b == c || c == a) {
      refuse("face {} has a vertex twice", f);
    }
  }
  const auto alone = std::find(named.begin(), named.end(), false);
  if (alone != named.end()) {
    refuse("point {} is no corner of a face", alone - named.begin());
  }
}

/// A face's side, under the vertices that it runs between.
struct Side {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t face = 0;
  std::uint32_t corner = 0;  ///< of the face, where it begins
};

std::vector<Side> sorted_sides(Faces faces) {
  std::vector<Side> sides;
  sides.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      sides.push_back({static_cast<std::uint32_t>(faces[f][k].value()),
                       static_cast<std::uint32_t>(faces[f][(k + 1) % 3].value()), f, k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tuple(a.from, a.to, a.face) < std::tuple(b.from, b.to, b.face);
  });
  return sides;
}

/// Two faces at one edge run along it in opposite directions; of three, two would run in the same.
void check_edges(const std::vector<Side>& sides) {
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side& a = sides[i - 1];
    const Side& b = sides[i];
    if (a.from == b.from && a.to == b.to) {
      refuse("faces {} and {} both run from vertex {} to vertex {}", a.face, b.face, a.from, a.to);
    }
  }
}

/// Corners of neighbours at the same vertex belong together; all at a vertex do.
void check_fans(std::size_t point_count, Faces faces, const std::vector<Side>& sides) {
  DisjointSets fans(3 * faces.size());
  for (const Side& side : sides) {
    const auto twin = std::lower_bound(sides.begin(), sides.end(), side, [](const Side& a, const Side& b) {
      return std::tuple(a.from, a.to) < std::tuple(b.to, b.from);
    });
    if (twin != sides.end() && twin->from == side.to && twin->to == side.from) {
      fans.join(3 * side.face + side.corner, 3 * twin->face + (twin->corner + 1) % 3);
    }
  }
  std::vector<std::uint32_t> fan_at(point_count, no_index);
  for (const Side& side : sides) {
    const std::uint32_t fan = fans.find(3 * side.face + side.corner);
    if (fan_at[side.from] != no_index && fan_at[side.from] != fan) {
      refuse("the faces at vertex {} are several fans that only touch there", side.from);
    }
    fan_at[side.from] = fan;
  }
}

/// Of fewer faces than one in so many a table of all vertices isn't worth its time.
constexpr std::size_t few = 16;

/// Vertices get numbers as they come, which `number` keeps.
template <class Numbers>
Surface numbered(const Surface& surface, const std::vector<FaceId>& faces, Numbers& number) {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> corners;
  corners.reserve(faces.size());
  for (const FaceId f : faces) {
    std::array<VertexId, 3> own = surface.vertices(f);
    for (VertexId& v : own) {
      VertexId& known = number[v];
      if (!known.valid()) {
        known = VertexId(points.size());
        points.push_back(surface.point(v));
      }
      v = known;
    }
    corners.push_back(own);
  }
  return {std::move(points), std::move(corners)};
}

std::vector<CornerId> border_from(const Surface& surface, CornerId first) {
  std::vector<CornerId> sides;
  CornerId c = first;
  do {
    sides.push_back(c);
    c = next(c);
    while (!surface.is_border(surface.edge(c))) {
      c = next(surface.twin(c));
    }
  } while (c != first);
  return sides;
}

Vec3 start_of(const Surface& surface, CornerId side) {
  return surface.point(surface.vertex(side));
}

Vec3 end_of(const Surface& surface, CornerId side) {
  return surface.point(surface.vertex(next(side)));
}

}  // namespace

void Surface::check(std::span<const Vec3> points, Faces faces) {
  check_points(points);
  check_corners(points.size(), faces);
  const std::vector<Side> sides = sorted_sides(faces);
  check_edges(sides);
  check_fans(points.size(), faces, sides);
}

Surface faces_alone(const Surface& surface, const std::vector<FaceId>& faces) {
  if (faces.size() >= surface.face_count() / few) {
    IdVector<VertexId, VertexId> number(surface.vertex_count());
    return numbered(surface, faces, number);
  }
  std::map<VertexId, VertexId> number;
  return numbered(surface, faces, number);
}

std::vector<Opening> flat_openings(const Surface& surface, double flat_mm) {
  std::vector<Opening> openings;
  std::vector<bool> seen(surface.corner_count(), false);
  for (const CornerId first : ids<CornerId>(surface.corner_count())) {
    if (seen[first.value()] || !surface.is_border(surface.edge(first))) {
      continue;
    }
    Opening opening;
    opening.sides = border_from(surface, first);
    for (const CornerId c : opening.sides) {
      seen[c.value()] = true;
      opening.middle += start_of(surface, c) / static_cast<double>(opening.sides.size());
    }
    Vec3 normal;  // of what closes it: its sides run the other way than the faces beside it do
    for (const CornerId c : opening.sides) {
      normal += cross(end_of(surface, c) - opening.middle, start_of(surface, c) - opening.middle);
    }
    if (!(length(normal) > 0.0)) {
      continue;
    }
    opening.normal = normalized(normal);
    if (std::ranges::all_of(opening.sides, [&](CornerId c) {
          return std::abs(dot(start_of(surface, c) - opening.middle, opening.normal)) <= flat_mm;
        })) {
      openings.push_back(std::move(opening));
    }
  }
  return openings;
}

bool rises_at(const Surface& surface, const Opening& opening, CornerId side) {
  constexpr double cosine = 0.8660254037844386;
  return std::abs(dot(surface.normal(face_of(side)), opening.normal)) < cosine;
}

std::vector<std::array<Vec3, 3>> triangles_of(const Surface& surface, const Opening& opening) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (const CornerId c : opening.sides) {
    triangles.push_back({opening.middle, end_of(surface, c), start_of(surface, c)});
  }
  if (std::ranges::all_of(triangles, [&](const auto& t) {
        return dot(cross(t[1] - t[0], t[2] - t[0]), opening.normal) > 0.0;
      })) {
    return triangles;
  }
  triangles.clear();
  const PlaneFrame frame(opening.middle, opening.normal);
  const auto count = static_cast<std::uint32_t>(opening.sides.size());
  std::vector<Vec2> points;
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (std::uint32_t i = 0; i < count; ++i) {
    points.push_back(frame.flat(start_of(surface, opening.sides[i])));
    sides.push_back({i, (i + 1) % count});
  }
  if (const auto inside = triangulate_inside(points, sides)) {
    for (const auto& [a, b, c] : *inside) {
      triangles.push_back({start_of(surface, opening.sides[a]), start_of(surface, opening.sides[b]),
                           start_of(surface, opening.sides[c])});
    }
  }
  return triangles;
}

}  // namespace ridgecraft::mesh
