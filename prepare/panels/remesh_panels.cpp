// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/remesh_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "mesh/model/soup.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/regions.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {
namespace {

// Which vertices between flat regions are needed.

class ChainStraightener {
 public:
  ChainStraightener(const mesh::Surface& surface, const PanelRegions& regions, double tolerance)
      : surface_(surface), regions_(regions), tolerance_(tolerance) {}

  std::vector<bool> choose(const std::vector<bool>& frozen) {
    const std::size_t n = surface_.vertex_count();
    keep_.assign(n, false);
    for (std::uint32_t v = 0; v < n; ++v) {
      keep_[v] = regions_.border_edges(v).size() != 2 && !regions_.border_edges(v).empty();
    }
    for (std::uint32_t r = 0; r < frozen.size(); ++r) {
      if (frozen[r]) {
        for (const std::uint32_t f : regions_.faces(r)) {
          for (const VertexId v : surface_.vertices(FaceId(f))) {
            keep_[v.value()] = true;
          }
        }
      }
    }
    follow_chains();
    keep_seams_apart();
    return std::move(keep_);
  }

 private:
  void follow_chains() {
    const std::vector<bool> corner = keep_;
    std::vector<bool> seen(surface_.edge_count(), false);
    const auto follow = [&](std::uint32_t v) {
      for (const std::uint32_t e : regions_.border_edges(v)) {
        if (!seen[e]) {
          chain(v, e, corner, seen);
        }
      }
    };
    for (std::uint32_t v = 0; v < corner.size(); ++v) {
      if (corner[v]) {
        follow(v);
      }
    }
    // What is left are closed chains without a corner.
    for (std::uint32_t v = 0; v < corner.size(); ++v) {
      follow(v);
    }
  }

  [[nodiscard]] std::uint32_t other_end(std::uint32_t edge, std::uint32_t v) const {
    const CornerId c = surface_.sides(EdgeId(edge))[0];
    const std::uint32_t a = surface_.vertex(c).value();
    return a == v ? surface_.vertex(mesh::next(c)).value() : a;
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
      const auto& edges = regions_.border_edges(v);
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

  [[nodiscard]] Vec3 place(std::uint32_t v) const { return surface_.point(VertexId(v)); }

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

  const mesh::Surface& surface_;
  const PanelRegions& regions_;
  double tolerance_;
  std::vector<std::vector<std::uint32_t>> chains_;
  std::vector<bool> keep_;  ///< of each vertex
};

/// Which vertices stay: corners where other than two region borders meet, all of the regions that are frozen,
/// and what it takes to keep each chain of edges between them straight within the tolerance (Douglas and
/// Peucker's rule). A closed chain keeps three at least, and two chains never become the same side. O(n log
/// n) but for chains that take the rule's worst case.
std::vector<bool> vertices_that_stay(const mesh::Surface& surface, const PanelRegions& regions,
                                     const std::vector<bool>& frozen, double tolerance) {
  return ChainStraightener(surface, regions, tolerance).choose(frozen);
}

/// A vertex this close to a straight side, as a share of the diagonal, lies on it. Half of what a panel may
/// have, so that both together stay within 1e-5.
constexpr double straight = 5e-6;
/// A new face may lean against its region's normal by this much: more is a flip in the making.
constexpr double leaning_cosine = 0.999;
/// Areas before and after may differ by this share, besides what the sides moved.
constexpr double covers_area = 1e-6;
using Face = std::array<std::uint32_t, 3>;

class Remesher {
 public:
  Remesher(const mesh::Model& model, const Panels& panels, const Context& context)
      : surface_(model.surface),
        panels_(panels),
        old_(mesh::take_apart(model)),
        context_(context),
        tolerance_(straight * model.surface.bounds().diagonal()),
        regions_(surface_, panels_, old_),
        frozen_(regions_.count(), false) {}

  /// Which panel each face of the result belongs to.
  [[nodiscard]] const std::vector<std::uint32_t>& panel_of_faces() const { return new_panel_; }

  /// A region that can't be done safely is frozen: it keeps its vertices, so its neighbours must be done
  /// again. Each round freezes one more at least; from the seventh on their neighbours, too, lest there be as
  /// many rounds as regions.
  mesh::LooseFaces run() {
    constexpr int calm_rounds = 6;
    for (int round = 0;; ++round) {
      context_.check();
      keep_ = vertices_that_stay(surface_, regions_, frozen_, tolerance_);
      const std::vector<std::uint32_t> failed = triangulate_regions();
      if (failed.empty()) {
        return std::move(new_);
      }
      for (const std::uint32_t region : failed) {
        freeze(region, round >= calm_rounds);
      }
    }
  }

 private:
  [[nodiscard]] Vec3 place(std::uint32_t v) const { return old_.points[v]; }

  void freeze(std::uint32_t region, bool with_neighbours) {
    frozen_[region] = true;
    if (with_neighbours) {
      for (const std::uint32_t f : regions_.faces(region)) {
        for (unsigned k = 0; k < 3; ++k) {
          const CornerId beyond = surface_.twin(mesh::corner(FaceId(f), k));
          if (beyond.valid()) {
            frozen_[regions_.region(mesh::face_of(beyond).value())] = true;
          }
        }
      }
    }
  }

  [[nodiscard]] bool loses_a_vertex(std::uint32_t region) const {
    const auto& faces = regions_.faces(region);
    return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      return std::any_of(old_.faces[f].begin(), old_.faces[f].end(),
                         [&](std::uint32_t v) { return !keep_[v]; });
    });
  }

  /// Makes the new faces; the regions that didn't come out well.
  std::vector<std::uint32_t> triangulate_regions() {
    new_ = {};
    new_panel_.clear();
    new_.points = old_.points;
    std::vector<std::uint32_t> failed;
    bool changed = false;
    for (std::uint32_t r = 0; r < regions_.count(); ++r) {
      if (r % 256 == 0) {
        context_.check();
      }
      if (!loses_a_vertex(r)) {
        for (const std::uint32_t f : regions_.faces(r)) {
          new_.add(old_, f, old_.faces[f]);
        }
      } else {
        changed = true;
        if (!triangulate_region(r)) {
          failed.push_back(r);
        }
      }
      new_panel_.resize(new_.faces.size(), panels_.panel[FaceId(regions_.faces(r).front())].value());
    }
    if (failed.empty() && changed && !mesh::is_surface(new_)) {
      // Two regions agreed on something that no surface can be; not seen in practice.
      failed.resize(regions_.count());
      std::iota(failed.begin(), failed.end(), 0U);
    }
    return failed;
  }

  /// The straight sides of a region between vertices that stay, as its faces run.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> outline(std::uint32_t region) const {
    // Successor of each side's start; a vertex can start several where the region touches itself.
    std::vector<std::array<std::uint32_t, 2>> sides;
    for (const std::uint32_t f : regions_.faces(region)) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId c = mesh::corner(FaceId(f), k);
        if (regions_.on_border(surface_.edge(c))) {
          sides.push_back({surface_.vertex(c).value(), surface_.vertex(mesh::next(c)).value()});
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
    const auto& faces = regions_.faces(region);
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
    const std::vector<std::array<std::uint32_t, 2>> sides = outline(region);
    if (has_twice(sides)) {  // a slit of no width: closing it would change what is connected
      return false;
    }
    const std::vector<std::uint32_t> vertices = points_of(sides);
    double perimeter = 0.0;
    for (const auto& [a, b] : sides) {
      perimeter += length(place(b) - place(a));
    }
    const auto triangles = triangles_between(sides, old_.points, frame);
    if (!triangles) {
      return false;
    }
    const std::ptrdiff_t euler = twice_euler(vertices.size(), triangles->size(), sides.size());
    if (euler != twice_euler(faces) || !sound(*triangles, normal, area, perimeter)) {
      return false;
    }
    const std::uint32_t polygon = common_polygon(faces);
    for (const Face& t : *triangles) {
      new_.add(old_, faces[0], t);
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
        sides += regions_.on_border(surface_.edge(mesh::corner(FaceId(f), k))) ? 1U : 0U;
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
    return same ? first : mesh::Soup::none;
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
    return !triangles.empty() && std::abs(sum - area) <= covers_area * area + tolerance_ * perimeter;
  }

  const mesh::Surface& surface_;
  const Panels& panels_;
  mesh::LooseFaces old_;
  mesh::LooseFaces new_;
  const Context& context_;
  double tolerance_;
  PanelRegions regions_;
  std::vector<bool> frozen_;              ///< regions that keep all their vertices
  std::vector<bool> keep_;                ///< vertices
  std::vector<std::uint32_t> new_panel_;  ///< of each new face
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

void remesh_panels(mesh::Model& model, const Context& context) {
  Panels panels = find_panels(model.surface);
  remesh_panels(model, panels, context);
}

void remesh_panels(mesh::Model& model, Panels& panels, const Context& context) {
  Remesher remesher(model, panels, context);
  mesh::LooseFaces faces = remesher.run();
  panels = panels_by_label(remesher.panel_of_faces());
  mesh::put_together(model, std::move(faces));
}

}  // namespace ridgecraft::prepare
