// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/remesh_panels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/constrained_delaunay.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/loose_faces.hpp"
#include "mesh/panels.hpp"
#include "mesh/plane_frame.hpp"
#include "mesh/polygon_list.hpp"

namespace ridgecraft::mesh {
namespace {

/// A vertex this close to a straight side, as a share of the diagonal, lies on it. Half of what a panel may
/// have, so that both together stay within 1e-5.
constexpr double straight = 5e-6;
/// A new face may lean against its region's normal by this much: more is a flip in the making.
constexpr double leaning_cosine = 0.999;
/// Areas before and after may differ by this share, besides what the sides moved.
constexpr double same_area = 1e-6;
/// Texture coordinates agree with one affine map within this (a fortieth of a pixel of a 256-pixel picture).
constexpr double same_texture = 1e-4;

using Face = std::array<std::uint32_t, 3>;

/// p -> origin + (across, up) applied to p's place in the frame.
struct AffineMap {
  Vec2 origin;
  Vec2 across;
  Vec2 up;
  [[nodiscard]] Vec2 operator()(Vec2 p) const { return origin + p.x * across + p.y * up; }
};

class Remesher {
 public:
  Remesher(const Model& model, const Panels& panels, const Context& context)
      : surface_(model.surface),
        panels_(panels),
        old_(take_apart(model)),
        context_(context),
        tolerance_(straight * model.surface.bounds().diagonal()) {}

  /// Which panel each face of the result belongs to.
  [[nodiscard]] const std::vector<std::uint32_t>& panel_of_faces() const { return new_panel_; }

  /// None where nothing is to be done or no safe result was found.
  std::optional<LooseFaces> run() {
    find_regions();
    find_region_borders();
    frozen_.assign(region_faces_.size(), false);
    // A region that fails keeps its vertices, so its neighbours must be done again.
    constexpr int rounds = 6;
    for (int round = 0; round < rounds; ++round) {
      context_.check();
      choose_vertices();
      if (triangulate_regions()) {
        return std::move(new_);
      }
    }
    return std::nullopt;
  }

 private:
  void find_regions() {
    DisjointSets sets(surface_.face_count());
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      const auto [c, d] = surface_.sides(e);
      if (d.valid()) {
        const FaceId f = face_of(c);
        const FaceId g = face_of(d);
        const bool one_material =
            old_.material.empty() || old_.material[f.value()] == old_.material[g.value()];
        if (panels_.panel[f] == panels_.panel[g] && one_material) {
          sets.join(f.value(), g.value());
        }
      }
    }
    region_.resize(surface_.face_count());
    for (std::uint32_t f = 0; f < region_.size(); ++f) {
      const std::uint32_t root = sets.find(f);
      if (root == f) {
        region_[f] = static_cast<std::uint32_t>(region_faces_.size());
        region_faces_.emplace_back();
      } else {
        region_[f] = region_[root];
      }
      region_faces_[region_[f]].push_back(f);
    }
  }

  [[nodiscard]] bool on_region_border(EdgeId e) const {
    const auto [c, d] = surface_.sides(e);
    return !d.valid() || region_[face_of(c).value()] != region_[face_of(d).value()];
  }

  void find_region_borders() {
    border_edges_.assign(surface_.vertex_count(), {});
    for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
      if (on_region_border(e)) {
        const CornerId c = surface_.sides(e)[0];
        border_edges_[surface_.vertex(c).value()].push_back(e.value());
        border_edges_[surface_.vertex(next(c)).value()].push_back(e.value());
      }
    }
  }

  [[nodiscard]] std::uint32_t other_end(std::uint32_t edge, std::uint32_t v) const {
    const CornerId c = surface_.sides(EdgeId(edge))[0];
    const std::uint32_t a = surface_.vertex(c).value();
    return a == v ? surface_.vertex(next(c)).value() : a;
  }

  /// Which vertices stay: corners where other than two region borders meet, all of frozen regions, and what
  /// it takes to keep each chain between them straight within the tolerance.
  void choose_vertices() {
    const std::size_t n = surface_.vertex_count();
    keep_.assign(n, false);
    for (std::size_t v = 0; v < n; ++v) {
      keep_[v] = border_edges_[v].size() != 2 && !border_edges_[v].empty();
    }
    for (std::size_t r = 0; r < frozen_.size(); ++r) {
      if (frozen_[r]) {
        for (const std::uint32_t f : region_faces_[r]) {
          for (const std::uint32_t v : old_.faces[f]) {
            keep_[v] = true;
          }
        }
      }
    }
    const std::vector<bool> corner = keep_;
    std::vector<bool> seen(surface_.edge_count(), false);
    for (std::uint32_t v = 0; v < n; ++v) {
      if (corner[v]) {
        for (const std::uint32_t e : border_edges_[v]) {
          if (!seen[e]) {
            chain(v, e, corner, seen);
          }
        }
      }
    }
    // What is left are closed chains without a corner.
    for (std::uint32_t v = 0; v < n; ++v) {
      for (const std::uint32_t e : border_edges_[v]) {
        if (!seen[e]) {
          chain(v, e, corner, seen);
        }
      }
    }
    keep_seams_apart();
  }

  /// Chains that became the same straight side, as along an edge that was cut open, would grow together: they
  /// stay as they were.
  void keep_seams_apart() {
    struct Side {
      std::array<std::uint32_t, 2> ends;
      std::size_t chain;
      auto operator<=>(const Side&) const = default;
    };
    std::vector<Side> sides;
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      std::uint32_t from = chains_[i].front();
      for (std::size_t k = 1; k < chains_[i].size(); ++k) {
        const std::uint32_t to = chains_[i][k];
        if (keep_[to]) {
          sides.push_back({{std::min(from, to), std::max(from, to)}, i});
          from = to;
        }
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 1; i < sides.size(); ++i) {
      if (sides[i].ends == sides[i - 1].ends) {
        keep_all(chains_[sides[i].chain]);
        keep_all(chains_[sides[i - 1].chain]);
      }
    }
    chains_.clear();
  }

  void chain(std::uint32_t start, std::uint32_t edge, const std::vector<bool>& corner,
             std::vector<bool>& seen) {
    std::vector<std::uint32_t> line{start};
    for (;;) {
      seen[edge] = true;
      const std::uint32_t v = other_end(edge, line.back());
      line.push_back(v);
      if (v == start || corner[v]) {
        break;
      }
      const auto& edges = border_edges_[v];
      edge = edges[0] == edge ? edges[1] : edges[0];
    }
    chains_.push_back(line);
    if (line.front() != line.back()) {
      straighten(line, 0, line.size() - 1);
      return;
    }
    keep_[start] = true;
    std::size_t far = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (length(place(line[i]) - place(start)) > length(place(line[far]) - place(start))) {
        far = i;
      }
    }
    if (far == 0 || line.size() <= 4) {  // a triangle, or all in one place: nothing can go
      keep_all(line);
      return;
    }
    keep_[line[far]] = true;
    straighten(line, 0, far);
    straighten(line, far, line.size() - 1);
    if (std::count_if(line.begin(), line.end() - 1, [&](std::uint32_t v) { return keep_[v]; }) < 3) {
      keep_all(line);
    }
  }

  void keep_all(const std::vector<std::uint32_t>& line) {
    for (const std::uint32_t v : line) {
      keep_[v] = true;
    }
  }

  [[nodiscard]] Vec3 place(std::uint32_t v) const { return old_.points[v]; }

  /// Douglas and Peucker's rule between two vertices that stay; with its own stack, since chains can be long.
  void straighten(const std::vector<std::uint32_t>& line, std::size_t from, std::size_t to) {
    std::vector<std::pair<std::size_t, std::size_t>> todo{{from, to}};
    while (!todo.empty()) {
      const auto [a, b] = todo.back();
      todo.pop_back();
      const Vec3 start = place(line[a]);
      const Vec3 along = normalized(place(line[b]) - start);
      const double reach = length(place(line[b]) - start);
      double worst = tolerance_;
      std::size_t at = a;
      for (std::size_t i = a + 1; i < b; ++i) {
        const Vec3 p = place(line[i]) - start;
        // Beyond the ends counts as off the line, too: there the chain turns back.
        const double t = std::clamp(dot(p, along), 0.0, reach);
        const double distance = length(p - t * along);
        if (distance > worst) {
          worst = distance;
          at = i;
        }
      }
      if (at != a) {
        keep_[line[at]] = true;
        todo.emplace_back(a, at);
        todo.emplace_back(at, b);
      }
    }
  }

  [[nodiscard]] bool loses_a_vertex(std::uint32_t region) const {
    const auto& faces = region_faces_[region];
    return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      return std::any_of(old_.faces[f].begin(), old_.faces[f].end(),
                         [&](std::uint32_t v) { return !keep_[v]; });
    });
  }

  /// True when all regions came out well; else the ones that didn't are frozen.
  bool triangulate_regions() {
    new_ = {};
    new_panel_.clear();
    new_.points = old_.points;
    bool all_well = true;
    bool changed = false;
    for (std::uint32_t r = 0; r < region_faces_.size(); ++r) {
      if (r % 256 == 0) {
        context_.check();
      }
      if (!loses_a_vertex(r)) {
        for (const std::uint32_t f : region_faces_[r]) {
          new_.add(old_, f, old_.faces[f], old_.texture.empty() ? std::array<Vec2, 3>{} : old_.texture[f]);
        }
      } else {
        changed = true;
        if (!triangulate_region(r)) {
          frozen_[r] = true;
          all_well = false;
        }
      }
      new_panel_.resize(new_.faces.size(), panels_.panel[FaceId(region_faces_[r].front())].value());
    }
    if (all_well && changed && !is_surface(new_)) {
      // Two regions agreed on something that no surface can be; not seen in practice.
      frozen_.assign(frozen_.size(), true);
      return false;
    }
    return all_well;
  }

  /// The straight sides of a region between vertices that stay, as its faces run.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> outline(std::uint32_t region) const {
    // Successor of each side's start; a vertex can start several where the region touches itself.
    std::vector<std::array<std::uint32_t, 2>> sides;
    for (const std::uint32_t f : region_faces_[region]) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = corner(FaceId(f), k);
        if (on_region_border(surface_.edge(c))) {
          sides.push_back({surface_.vertex(c).value(), surface_.vertex(next(c)).value()});
        }
      }
    }
    std::sort(sides.begin(), sides.end());
    std::vector<std::array<std::uint32_t, 2>> result;
    for (const auto& [a, b] : sides) {
      if (!keep_[a]) {
        continue;
      }
      std::uint32_t end = b;
      while (!keep_[end]) {  // two border edges meet there, so one side leaves it
        end = (*std::lower_bound(sides.begin(), sides.end(), std::array<std::uint32_t, 2>{end, 0}))[1];
      }
      result.push_back({a, end});
    }
    return result;
  }

  static bool has_twice(std::vector<std::array<std::uint32_t, 2>> sides) {
    for (auto& [a, b] : sides) {
      if (a > b) {
        std::swap(a, b);
      }
    }
    std::sort(sides.begin(), sides.end());
    return std::adjacent_find(sides.begin(), sides.end()) != sides.end();
  }

  bool triangulate_region(std::uint32_t region) {
    const auto& faces = region_faces_[region];
    Vec3 doubled;
    double area = 0.0;
    for (const std::uint32_t f : faces) {
      const Vec3 a = place(old_.faces[f][0]);
      doubled += cross(place(old_.faces[f][1]) - a, place(old_.faces[f][2]) - a);
      area += surface_.area(FaceId(f));
    }
    const Vec3 normal = normalized(doubled);
    if (normal == Vec3{}) {
      return false;
    }
    const PlaneFrame frame(place(old_.faces[faces[0]][0]), normal);
    const auto texture = texture_map(region, frame);
    if (!old_.texture.empty() && !texture) {
      return false;
    }
    std::vector<std::array<std::uint32_t, 2>> sides = outline(region);
    if (has_twice(sides)) {  // a slit of no width: closing it would change what is connected
      return false;
    }
    std::vector<std::uint32_t> vertices;
    double perimeter = 0.0;
    for (const auto& [a, b] : sides) {
      vertices.push_back(a);
      perimeter += length(place(b) - place(a));
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<Vec2> flat;
    for (const std::uint32_t v : vertices) {
      flat.push_back(frame.flat(place(v)));
    }
    for (auto& side : sides) {
      for (std::uint32_t& v : side) {
        v = static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                       vertices.begin());
      }
    }
    auto triangles = triangulate_inside(flat, sides);
    if (!triangles) {
      return false;
    }
    std::sort(triangles->begin(), triangles->end());
    for (Face& t : *triangles) {
      t = {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    }
    const std::ptrdiff_t euler = twice_euler(vertices.size(), triangles->size(), sides.size());
    if (euler != twice_euler(faces) || !sound(*triangles, normal, area, perimeter)) {
      return false;
    }
    const std::uint32_t polygon = common_polygon(faces);
    for (const Face& t : *triangles) {
      std::array<Vec2, 3> places{};
      for (std::size_t k = 0; k < 3 && texture; ++k) {
        places[k] = (*texture)(frame.flat(place(t[k])));
      }
      new_.add(old_, faces[0], t, places);
      new_.polygon.back() = polygon;
    }
    return true;
  }

  /// Twice vertices - edges + faces of a region: it says how many holes the region has.
  static std::ptrdiff_t twice_euler(std::size_t vertices, std::size_t faces, std::size_t sides) {
    const auto v = static_cast<std::ptrdiff_t>(vertices);
    const auto f = static_cast<std::ptrdiff_t>(faces);
    return 2 * v - (3 * f + static_cast<std::ptrdiff_t>(sides)) + 2 * f;
  }
  [[nodiscard]] std::ptrdiff_t twice_euler(const std::vector<std::uint32_t>& faces) const {
    std::vector<std::uint32_t> vertices;
    std::size_t sides = 0;
    for (const std::uint32_t f : faces) {
      for (unsigned k = 0; k < 3; ++k) {
        vertices.push_back(old_.faces[f][k]);
        sides += on_region_border(surface_.edge(corner(FaceId(f), k))) ? 1U : 0U;
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return twice_euler(vertices.size(), faces.size(), sides);
  }

  [[nodiscard]] std::uint32_t common_polygon(const std::vector<std::uint32_t>& faces) const {
    const std::uint32_t first = old_.polygon[faces[0]];
    const bool same =
        std::all_of(faces.begin(), faces.end(), [&](std::uint32_t f) { return old_.polygon[f] == first; });
    return same ? first : Soup::none;
  }

  /// The new faces cover what the old ones covered, and none leans or is without area.
  [[nodiscard]] bool sound(const std::vector<Face>& triangles, Vec3 normal, double area,
                           double perimeter) const {
    double sum = 0.0;
    for (const auto& [a, b, c] : triangles) {
      const Vec3 n = cross(place(b) - place(a), place(c) - place(a));
      const double size = length(n);
      const double longest =
          std::max({length(place(b) - place(a)), length(place(c) - place(b)), length(place(a) - place(c))});
      // A height within the tolerance would be a face that is nothing but rounding.
      if (!(size > tolerance_ * longest) || dot(n, normal) < leaning_cosine * size) {
        return false;
      }
      sum += 0.5 * size;
    }
    return !triangles.empty() && std::abs(sum - area) <= same_area * area + tolerance_ * perimeter;
  }

  /// The one affine map that lays the picture on all faces of a region, if there is one.
  [[nodiscard]] std::optional<AffineMap> texture_map(std::uint32_t region, const PlaneFrame& frame) const {
    if (old_.texture.empty()) {
      return std::nullopt;
    }
    const auto& faces = region_faces_[region];
    const std::uint32_t widest =
        *std::max_element(faces.begin(), faces.end(), [&](std::uint32_t f, std::uint32_t g) {
          return surface_.area(FaceId(f)) < surface_.area(FaceId(g));
        });
    const auto corner_of = [&](std::uint32_t f, std::size_t k) {
      return frame.flat(place(old_.faces[f][k]));
    };
    const Vec2 p = corner_of(widest, 0);
    const Vec2 q = corner_of(widest, 1) - p;
    const Vec2 r = corner_of(widest, 2) - p;
    const double area = cross(q, r);
    if (!(area > 0.0)) {
      return std::nullopt;
    }
    const auto& t = old_.texture[widest];
    AffineMap map;
    map.across = (r.y * (t[1] - t[0]) - q.y * (t[2] - t[0])) / area;
    map.up = (q.x * (t[2] - t[0]) - r.x * (t[1] - t[0])) / area;
    map.origin = t[0] - p.x * map.across - p.y * map.up;
    for (const std::uint32_t f : faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(length(map(corner_of(f, k)) - old_.texture[f][k]) < same_texture)) {
          return std::nullopt;
        }
      }
    }
    return map;
  }

  const Surface& surface_;
  const Panels& panels_;
  LooseFaces old_;
  LooseFaces new_;
  const Context& context_;
  double tolerance_;
  std::vector<std::uint32_t> region_;  ///< of each face
  std::vector<std::vector<std::uint32_t>> region_faces_;
  std::vector<std::vector<std::uint32_t>> border_edges_;  ///< of each vertex
  std::vector<bool> frozen_;                              ///< regions that keep all their vertices
  std::vector<std::vector<std::uint32_t>> chains_;        ///< of the present choice
  std::vector<bool> keep_;                                ///< vertices
  std::vector<std::uint32_t> new_panel_;                  ///< of each new face
};

}  // namespace

Panels panels_by_label(const std::vector<std::uint32_t>& label) {
  Panels panels;
  panels.panel = IdVector<FaceId, PanelId>(label.size());
  std::vector<PanelId> number;
  for (const FaceId f : ids<FaceId>(label.size())) {
    const std::uint32_t own = label[f.value()];
    number.resize(std::max<std::size_t>(number.size(), own + 1));
    if (!number[own].valid()) {
      number[own] = panels.faces.push_back({});
    }
    panels.panel[f] = number[own];
    panels.faces[number[own]].push_back(f);
  }
  return panels;
}

void remesh_panels(Model& model, const Context& context) {
  Panels panels = find_panels(model.surface);
  remesh_panels(model, panels, context);
}

void remesh_panels(Model& model, Panels& panels, const Context& context) {
  Remesher remesher(model, panels, context);
  if (auto faces = remesher.run()) {
    panels = panels_by_label(remesher.panel_of_faces());
    put_together(model, std::move(*faces));
  }
}

}  // namespace ridgecraft::mesh
