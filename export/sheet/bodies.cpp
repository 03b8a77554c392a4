// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <boost/polygon/polygon.hpp>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::export_ {
namespace {

namespace planar = boost::polygon;
using PlanarSet = planar::polygon_set_data<int>;
using PlanarPoint = planar::point_data<int>;
using PlanarPolygon = planar::polygon_with_holes_data<int>;

/// How near faces must come to be glued onto each other.
struct Reach {
  double mm = 0.0;
  double parallel = 1.0;  ///< cosine of the angle between them, at least
};
/// What lies on another face, up to 3 degrees.
constexpr Reach on_each_other{mesh::touching_mm, 0.9986};
/// What nothing else holds is glued over a gap of this, or along the edge where it meets another at up to 75
/// degrees.
constexpr Reach beside_each_other{near_enough_mm, 0.26};
/// Smaller areas hold nothing, mm^2.
constexpr double least_area = 4.0;
/// Areas that meet at an edge of a face overlap by this, so that no crack stays between them, mm.
constexpr double overlap_mm = 0.002;
/// A body stands with its opening on a smaller one where this share of the opening lies there.
constexpr double least_covered = 0.8;
/// Corners of an outline that are no farther from its line are none, mm.
constexpr double straight_mm = 0.02;
/// Units of the whole-number plane for one mm.
constexpr double units_per_mm = 1000.0;

/// From space to the plane of a face's piece, and the height over the face.
struct Laid {
  Laid(const mesh::Surface& surface, const unfold::Nets& nets, FaceId face) {
    const auto [a, b, c] = surface.vertices(face);
    origin = surface.point(a);
    x = normalized(surface.point(b) - origin);
    z = surface.normal(face);
    y = cross(z, x);
    const auto& flat = nets.flat[face];
    at = flat[0];
    const Vec2 d = flat[1] - flat[0];
    along = d / length(d);
  }

  /// x and y in the plane of the piece, z over the face.
  [[nodiscard]] Vec3 operator()(Vec3 p) const {
    const Vec3 d = p - origin;
    const Vec2 q = at + dot(d, x) * along + dot(d, y) * perpendicular(along);
    return {q.x, q.y, dot(d, z)};
  }

  Vec3 origin, x, y, z;
  Vec2 at, along;
};

/// A convex polygon, counterclockwise, with its sides moved outwards.
std::vector<Vec2> grown(const std::vector<Vec2>& polygon, double by) {
  std::vector<Vec2> corners;
  for (const Vec2 p : polygon) {
    if (corners.empty() || length(p - corners.back()) > by) {
      corners.push_back(p);
    }
  }
  while (corners.size() > 1 && length(corners.back() - corners.front()) <= by) {
    corners.pop_back();
  }
  std::vector<Vec2> result;
  for (std::size_t i = 0; corners.size() > 2 && i < corners.size(); ++i) {
    const Vec2 before = corners[i] - corners[(i + corners.size() - 1) % corners.size()];
    const Vec2 after = corners[(i + 1) % corners.size()] - corners[i];
    for (const Vec2 side : {before, after}) {
      result.push_back(corners[i] - by * perpendicular(side) / length(side));
    }
  }
  return result;
}

/// What may lie on a face of another body: a face, or a part of an opening.
struct Lying {
  std::array<Vec3, 3> corners;
  Vec3 normal;
  FaceId face;  ///< itself, or one beside the opening
  std::uint32_t opening = none;
  bool is_hole = false;  ///< the opening is one in a flat face of its body, which doesn't stand on it

  static constexpr std::uint32_t none = ~0U;
  [[nodiscard]] double area() const {
    return 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0]));
  }
};

/// The part of it that lies on a face, in the plane of that face's piece.
std::vector<Vec2> common_area(const mesh::Surface& surface, const unfold::Nets& nets, FaceId face,
                              const Lying& on_it, double reach_mm) {
  const Laid laid(surface, nets, face);
  std::vector<Vec3> polygon;
  for (const Vec3 p : on_it.corners) {
    polygon.push_back(laid(p));
  }
  polygon = part_where(polygon, [&](Vec3 p) { return reach_mm - p.z; });
  polygon = part_where(polygon, [&](Vec3 p) { return reach_mm + p.z; });
  const auto& flat = nets.flat[face];
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
    const Vec2 from = flat[k];
    const Vec2 side = flat[(k + 1) % 3] - from;
    polygon = part_where(polygon, [&](Vec3 p) { return cross(side, Vec2{p.x, p.y} - from); });
  }
  std::vector<Vec2> area;
  area.reserve(polygon.size());
  for (const Vec3 p : polygon) {
    area.push_back({p.x, p.y});
  }
  if (doubled_area(area) < 0.0) {
    std::ranges::reverse(area);
  }
  return area;
}

PlanarPoint rounded(Vec2 p) {
  return {static_cast<int>(std::lround(p.x * units_per_mm)),
          static_cast<int>(std::lround(p.y * units_per_mm))};
}

/// Without corners that lie on the line between others.
std::vector<Vec2> straightened(const std::vector<Vec2>& outline) {
  std::vector<Vec2> kept = outline;
  for (bool changed = true; changed && kept.size() > 3;) {
    changed = false;
    for (std::size_t i = 0; i < kept.size() && kept.size() > 3; ++i) {
      const Vec2 before = kept[(i + kept.size() - 1) % kept.size()];
      const Vec2 d = kept[(i + 1) % kept.size()] - before;
      const double size = length(d);
      const double away = size > 0.0 ? std::abs(cross(d, kept[i] - before)) / size : length(kept[i] - before);
      if (away < straight_mm / 2.0) {
        kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
      }
    }
  }
  return kept;
}

template <class Ring>
std::vector<Vec2> points_of(const Ring& ring) {
  std::vector<Vec2> points;
  for (auto p = ring.begin(); p != ring.end(); ++p) {
    const Vec2 at{p->x() / units_per_mm, p->y() / units_per_mm};
    if (points.empty() || at != points.back()) {
      points.push_back(at);
    }
  }
  if (points.size() > 1 && points.front() == points.back()) {
    points.pop_back();
  }
  return straightened(points);
}

/// The outlines of areas that lie beside and over each other.
std::vector<std::vector<Vec2>> outlines_of(const std::vector<std::vector<Vec2>>& areas) {
  PlanarSet sum;
  for (const std::vector<Vec2>& area : areas) {
    std::vector<PlanarPoint> corners;
    for (const Vec2 p : grown(area, overlap_mm)) {
      corners.push_back(rounded(p));
    }
    if (corners.size() > 2) {
      planar::polygon_data<int> polygon;
      polygon.set(corners.begin(), corners.end());
      sum.insert(polygon);
    }
  }
  std::vector<PlanarPolygon> polygons;
  sum.get(polygons);
  std::vector<std::vector<Vec2>> outlines;
  const auto add = [&](std::vector<Vec2> outline, bool hole) {
    const double doubled = doubled_area(outline);
    if (outline.size() > 2 && std::abs(doubled) > (hole ? 1.0 : least_area)) {
      if ((doubled > 0.0) == hole) {
        std::ranges::reverse(outline);
      }
      outlines.push_back(std::move(outline));
    }
    return std::abs(doubled) > least_area;
  };
  for (const PlanarPolygon& polygon : polygons) {
    if (add(points_of(polygon), false)) {
      for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole) {
        add(points_of(*hole), true);
      }
    }
  }
  return outlines;
}

/// Whether the faces beside an opening go on in its plane for the most part.
bool is_hole(const mesh::Surface& surface, const mesh::Opening& opening) {
  double flat = 0.0;
  double whole = 0.0;
  for (const CornerId side : opening.sides) {
    const double size = surface.length(surface.edge(side));
    whole += size;
    flat += mesh::rises_at(surface, opening, side) ? 0.0 : size;
  }
  return flat > 0.5 * whole;
}

/// All faces, each at its place, then what openings are made of.
std::vector<Lying> all_lying(const mesh::Surface& surface) {
  std::vector<Lying> all;
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(face);
    all.push_back({{surface.point(a), surface.point(b), surface.point(c)}, surface.normal(face), face});
  }
  std::uint32_t number = 0;
  for (const mesh::Opening& opening : mesh::flat_openings(surface, mesh::touching_mm)) {
    const std::vector<std::array<Vec3, 3>> triangles = mesh::triangles_of(surface, opening);
    const bool hole = is_hole(surface, opening);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const CornerId side = opening.sides[std::min(i, opening.sides.size() - 1)];
      all.push_back({triangles[i], opening.normal, mesh::face_of(side), number, hole});
    }
    ++number;
  }
  return all;
}

/// Their boxes, grown so that those touch that do.
NearBoxes boxes_of(const std::vector<Lying>& all, double reach_mm) {
  std::vector<Box3> boxes;
  for (const Lying& one : all) {
    Box3 box;
    const Vec3 reach{reach_mm, reach_mm, reach_mm};
    for (const Vec3 p : one.corners) {
      box.add(p - 0.5 * reach);
      box.add(p + 0.5 * reach);
    }
    boxes.push_back(box);
  }
  return NearBoxes(boxes);
}

/// By the piece that lies below and the one above: which two lie on each other, and where.
using CommonAreas = std::map<std::pair<PieceId, PieceId>,
                             std::vector<std::pair<std::array<std::uint32_t, 2>, std::vector<Vec2>>>>;

/// A body with an opening stands on a smaller one only if the opening lies there for the most part: else a
/// tower would be glued onto the target that leans against it.
void drop_openings_beyond(const mesh::Surface& surface, const std::vector<Lying>& all,
                          const std::vector<double>& area, CommonAreas& areas) {
  const auto body = [&](std::uint32_t one) { return surface.component(all[one].face).value(); };
  std::map<std::uint32_t, double> whole;  // of each opening
  for (const Lying& one : all) {
    if (one.opening != Lying::none) {
      whole[one.opening] += one.area();
    }
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> covered;  // of an opening by a body
  for (const auto& [pieces, list] : areas) {
    for (const auto& [two, polygon] : list) {
      if (all[two[1]].opening != Lying::none) {
        covered[{all[two[1]].opening, body(two[0])}] += 0.5 * doubled_area(polygon);
      }
    }
  }
  for (auto& [pieces, list] : areas) {
    std::erase_if(list, [&](const auto& entry) {
      const auto [below, above] = entry.first;
      const std::uint32_t opening = all[above].opening;
      return opening != Lying::none && area[body(below)] < area[body(above)] &&
             (all[above].is_hole || covered[{opening, body(below)}] < least_covered * whole[opening]);
    });
  }
}

/// Where bodies come as near as `reach`, of those that `held` doesn't connect already.
CommonAreas common_areas(const mesh::Surface& surface, const unfold::Nets& nets,
                         const std::vector<Lying>& all, const Reach& reach, DisjointSets& held) {
  std::vector<double> area(surface.component_count(), 0.0);
  for (const FaceId face : ids<FaceId>(surface.face_count())) {
    area[surface.component(face).value()] += surface.area(face);
  }
  CommonAreas areas;
  const auto body = [&](std::uint32_t one) { return surface.component(all[one].face).value(); };
  boxes_of(all, reach.mm).for_pairs([&](std::uint32_t i, std::uint32_t j) {
    std::uint32_t below = i;
    std::uint32_t above = j;
    if (held.find(body(below)) == held.find(body(above)) ||
        !(std::abs(dot(all[below].normal, all[above].normal)) >= reach.parallel)) {
      return;
    }
    const auto is_opening = [&](std::uint32_t one) { return all[one].opening != Lying::none; };
    if (is_opening(below) && is_opening(above)) {
      return;
    }
    // Nothing is glued onto an opening, and else the smaller body onto the larger one.
    if (is_opening(below) || (!is_opening(above) && std::pair(area[body(below)], body(above)) <
                                                        std::pair(area[body(above)], body(below)))) {
      std::swap(below, above);
    }
    const FaceId face(below);
    if (std::vector<Vec2> common = common_area(surface, nets, face, all[above], reach.mm);
        common.size() > 2) {
      areas[{nets.piece[face], nets.piece[all[above].face]}].emplace_back(std::array{below, above},
                                                                          std::move(common));
    }
  });
  drop_openings_beyond(surface, all, area, areas);
  return areas;
}

/// The outlines of all areas that hold something; `held` connects their bodies.
void add_outlines(const mesh::Surface& surface, const unfold::Nets& nets, CommonAreas&& areas,
                  DisjointSets& held, std::vector<GlueOutline>& glue_outlines) {
  const auto body = [&](PieceId piece) {
    return surface.component(nets.pieces[piece].faces.front()).value();
  };
  for (auto& [pieces, list] : areas) {
    std::ranges::sort(list, {}, [](const auto& entry) { return entry.first; });
    std::vector<std::vector<Vec2>> polygons;
    polygons.reserve(list.size());
    for (auto& [faces, polygon] : list) {
      polygons.push_back(std::move(polygon));
    }
    if (auto outlines = outlines_of(polygons); !outlines.empty()) {
      glue_outlines.push_back({pieces.first, pieces.second, std::move(outlines)});
      held.join(body(pieces.first), body(pieces.second));
    }
  }
}

}  // namespace

std::vector<GlueOutline> find_glue_outlines(const mesh::Surface& surface, const unfold::Nets& nets,
                                            std::span<const std::array<PieceId, 2>> except) {
  if (surface.component_count() < 2) {
    return {};
  }
  const std::vector<Lying> all = all_lying(surface);
  std::vector<GlueOutline> glue_outlines;
  DisjointSets held(surface.component_count());
  for (const Reach& reach : {on_each_other, beside_each_other}) {
    add_outlines(surface, nets, common_areas(surface, nets, all, reach, held), held, glue_outlines);
  }
  std::erase_if(glue_outlines, [&](const GlueOutline& one) {
    return std::ranges::find(except, std::array{one.piece, one.other}) != except.end();
  });
  std::ranges::sort(glue_outlines, {},
                    [](const GlueOutline& one) { return std::pair(one.piece, one.other); });
  return glue_outlines;
}

namespace {

using mesh::Surface;

/// Pairs of a vertex and a face that are looked at, all bodies together: some 0.05 s.
constexpr std::size_t most_pairs = 4'000'000;
/// Vertices of one body that are enough to find what it stands on.
constexpr std::size_t most_samples = 100;

/// A vertex and a face that has it.
struct Sample {
  Vec3 point;
  FaceId face;
};

/// A body's smallest box, its vertices and its faces.
struct Extent {
  Box3 box;
  std::vector<Sample> samples;
  std::vector<FaceId> faces;
};

std::vector<Extent> extents_of(const Surface& surface) {
  std::vector<Extent> extents(surface.component_count());
  std::vector<bool> seen(surface.vertex_count(), false);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    Extent& extent = extents[surface.component(f).value()];
    extent.faces.push_back(f);
    for (const VertexId v : surface.vertices(f)) {
      if (!seen[v.value()]) {
        seen[v.value()] = true;
        extent.samples.push_back({surface.point(v), f});
        extent.box.add(surface.point(v));
      }
    }
  }
  return extents;
}

/// Fewer vertices, spread over all of them.
void keep_evenly(std::vector<Sample>& samples, std::size_t most) {
  const std::size_t step = (samples.size() + most - 1) / most;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    samples[kept++] = samples[i];
  }
  samples.resize(kept);
}

double squared_gap(const Box3& a, const Box3& b) {
  const auto gap = [](double low, double high, double other_low, double other_high) {
    return std::max({0.0, other_low - high, low - other_high});
  };
  const Vec3 d{gap(a.low.x, a.high.x, b.low.x, b.high.x), gap(a.low.y, a.high.y, b.low.y, b.high.y),
               gap(a.low.z, a.high.z, b.low.z, b.high.z)};
  return dot(d, d);
}

struct Nearest {
  FaceId face;
  double squared = INFINITY;
};

/// The vertices of one body against the faces of another one. What is nearest is kept as a face of the other
/// body, whichever of the two that is.
void measure_to_faces(const Surface& surface, const Extent& of_vertices, const Extent& of_faces,
                      bool faces_are_other, Nearest& nearest) {
  for (const Sample& sample : of_vertices.samples) {
    Box3 point;
    point.add(sample.point);
    if (squared_gap(point, of_faces.box) >= nearest.squared) {
      continue;
    }
    for (const FaceId f : of_faces.faces) {
      const auto [a, b, c] = surface.vertices(f);
      Box3 face;
      for (const VertexId v : {a, b, c}) {
        face.add(surface.point(v));
      }
      if (squared_gap(point, face) < nearest.squared) {
        const double squared =
            mesh::squared_distance(surface.point(a), surface.point(b), surface.point(c), sample.point);
        nearest = squared < nearest.squared ? Nearest{faces_are_other ? f : sample.face, squared} : nearest;
      }
    }
  }
}

void find_nearest(const Surface& surface, const unfold::Nets& nets,
                  const std::vector<std::uint32_t>& component, std::vector<Body>& bodies) {
  std::vector<Extent> extents = extents_of(surface);
  const std::size_t samples = std::min(
      most_samples, most_pairs / (2 * bodies.size() * std::max<std::size_t>(1, surface.face_count())));
  if (samples == 0) {
    return;
  }
  for (Extent& extent : extents) {
    keep_evenly(extent.samples, samples);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Extent& own = extents[component[i]];
    // The nearest boxes first: most of the others needn't be looked at then.
    std::vector<std::pair<double, std::uint32_t>> others;
    for (std::uint32_t other = 0; other < extents.size(); ++other) {
      if (other != component[i]) {
        others.emplace_back(squared_gap(own.box, extents[other].box), other);
      }
    }
    std::sort(others.begin(), others.end());
    Nearest nearest;
    for (const auto& [gap, other] : others) {
      if (gap < nearest.squared) {
        measure_to_faces(surface, own, extents[other], true, nearest);
        measure_to_faces(surface, extents[other], own, false, nearest);
      }
    }
    bodies[i].beside = nets.piece[nearest.face];
    bodies[i].distance_mm = std::sqrt(nearest.squared);
  }
}

}  // namespace

std::vector<Body> find_bodies(const prepare::Prepared& model, const unfold::Nets& nets,
                              std::span<const GlueOutline> glue_outlines) {
  const Surface& surface = model.model.surface;
  if (surface.component_count() < 2) {
    return {};
  }
  std::vector<Body> bodies;
  std::vector<std::uint32_t> component;  // of each body
  std::vector<std::size_t> number(surface.component_count(), SIZE_MAX);
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    const std::uint32_t own = surface.component(nets.pieces[p].faces.front()).value();
    if (number[own] == SIZE_MAX) {
      number[own] = bodies.size();
      bodies.emplace_back();
      component.push_back(own);
    }
    bodies[number[own]].pieces.push_back(p);
  }
  find_nearest(surface, nets, component, bodies);
  for (const GlueOutline& glued : glue_outlines) {
    const std::uint32_t own = surface.component(nets.pieces[glued.other].faces.front()).value();
    bodies[number[own]].glued_onto.push_back({glued.other, glued.piece});
  }
  for (Body& body : bodies) {
    std::ranges::sort(body.glued_onto);
  }
  return bodies;
}

std::size_t bodies_apart(std::span<const Body> bodies) {
  std::map<PieceId, std::uint32_t> body_of;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const PieceId piece : bodies[i].pieces) {
      body_of.emplace(piece, static_cast<std::uint32_t>(i));
    }
  }
  DisjointSets sets(bodies.size());
  std::size_t apart = bodies.size();
  for (const Body& body : bodies) {
    for (const auto& [piece, other] : body.glued_onto) {
      apart -= sets.join(body_of.at(piece), body_of.at(other)) ? 1U : 0U;
    }
  }
  return apart;
}

}  // namespace ridgecraft::export_
