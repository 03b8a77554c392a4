// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "base/delaunay.hpp"
#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::prepare {

std::vector<std::uint32_t> points_of(const std::vector<OutlineSide>& sides) {
  std::vector<std::uint32_t> points;
  for (const OutlineSide& side : sides) {
    points.push_back(side[0]);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::optional<std::vector<std::array<std::uint32_t, 3>>> triangles_between(std::vector<OutlineSide> sides,
                                                                           const std::vector<Vec3>& places,
                                                                           const PlaneFrame& frame) {
  const std::vector<std::uint32_t> points = points_of(sides);
  std::vector<Vec2> flat;
  for (const std::uint32_t p : points) {
    flat.push_back(frame.flat(places[p]));
  }
  for (OutlineSide& side : sides) {
    for (std::uint32_t& p : side) {
      p = static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), p) - points.begin());
    }
  }
  auto triangles = triangulate_inside(flat, sides);
  if (triangles) {
    std::sort(triangles->begin(), triangles->end());
    for (auto& t : *triangles) {
      t = {points[t[0]], points[t[1]], points[t[2]]};
    }
  }
  return triangles;
}

PanelRegions::PanelRegions(const mesh::Surface& surface, const Panels& panels, const mesh::LooseFaces& loose)
    : surface_(surface) {
  find_regions(panels, loose);
  find_borders();
}

void PanelRegions::find_regions(const Panels& panels, const mesh::LooseFaces& loose) {
  DisjointSets sets(surface_.face_count());
  for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
    const auto [c, d] = surface_.sides(e);
    if (d.valid()) {
      const FaceId f = mesh::face_of(c);
      const FaceId g = mesh::face_of(d);
      const bool one_material =
          loose.material.empty() || loose.material[f.value()] == loose.material[g.value()];
      if (panels.panel[f] == panels.panel[g] && one_material) {
        sets.join(f.value(), g.value());
      }
    }
  }
  region_.resize(surface_.face_count());
  for (std::uint32_t f = 0; f < region_.size(); ++f) {
    const std::uint32_t root = sets.find(f);
    if (root == f) {
      region_[f] = static_cast<std::uint32_t>(faces_.size());
      faces_.emplace_back();
    } else {
      region_[f] = region_[root];
    }
    faces_[region_[f]].push_back(f);
  }
}

bool PanelRegions::on_border(EdgeId edge) const {
  const auto [c, d] = surface_.sides(edge);
  return !d.valid() || region_[mesh::face_of(c).value()] != region_[mesh::face_of(d).value()];
}

void PanelRegions::find_borders() {
  border_edges_.assign(surface_.vertex_count(), {});
  for (const EdgeId e : ids<EdgeId>(surface_.edge_count())) {
    if (on_border(e)) {
      const CornerId c = surface_.sides(e)[0];
      border_edges_[surface_.vertex(c).value()].push_back(e.value());
      border_edges_[surface_.vertex(mesh::next(c)).value()].push_back(e.value());
    }
  }
}

namespace {

/// What a set looks at may turn by this much: half of what its regions differ by.
constexpr double turned_cosine = 0.7;
/// The triangles cover what the outline encloses, as a share of its area.
constexpr double same_area = 1e-6;

using Side = OutlineSide;
using Face = std::array<std::uint32_t, 3>;

class Merger {
 public:
  Merger(const mesh::Surface& surface, const mesh::LooseFaces& loose, const PanelRegions& regions,
         RegionChanges& changes)
      : surface_(surface), loose_(loose), regions_(regions), changes_(changes), sets_(changes.sets) {}

  MergedRegions run() {
    MergedRegions result;
    result.faces.points = changes_.places;
    std::vector<std::vector<std::uint32_t>> members(regions_.count());
    for (std::uint32_t r = 0; r < regions_.count(); ++r) {
      members[sets_.find(r)].push_back(r);
    }
    for (std::uint32_t r = 0; r < regions_.count(); ++r) {
      const std::vector<std::uint32_t>& set = members[sets_.find(r)];
      if (set.front() != r) {
        continue;
      }
      if (set.size() == 1 && !is_changed(r)) {
        for (const std::uint32_t f : regions_.faces(r)) {
          result.faces.add(loose_, f, loose_.faces[f]);
        }
      } else if (const auto faces = triangulated(set)) {
        for (const Face& face : *faces) {
          result.faces.add(loose_, regions_.faces(r).front(), face);
          result.faces.polygon.back() = mesh::Soup::none;
        }
      } else {
        result.failed.insert(result.failed.end(), set.begin(), set.end());
      }
    }
    return result;
  }

 private:
  [[nodiscard]] Vec3 place(std::uint32_t v) const { return changes_.places[v]; }

  [[nodiscard]] bool is_changed(std::uint32_t region) const {
    const auto& faces = regions_.faces(region);
    return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
      return std::any_of(loose_.faces[f].begin(), loose_.faces[f].end(), [&](std::uint32_t v) {
        return changes_.gone[v] || changes_.becomes[v] != v || place(v) != loose_.points[v];
      });
    });
  }

  /// The straight sides between points that stay, as the faces run.
  [[nodiscard]] std::vector<Side> outline(const std::vector<std::uint32_t>& set) {
    std::vector<Side> sides;
    for (const std::uint32_t r : set) {
      for (const std::uint32_t f : regions_.faces(r)) {
        for (unsigned k = 0; k < 3; ++k) {
          const CornerId c = mesh::corner(FaceId(f), k);
          const FaceId beyond = surface_.neighbor(c);
          if (!beyond.valid() || sets_.find(regions_.region(beyond.value())) != sets_.find(r)) {
            sides.push_back({surface_.vertex(c).value(), surface_.vertex(mesh::next(c)).value()});
          }
        }
      }
    }
    std::sort(sides.begin(), sides.end());
    std::vector<Side> result;
    for (const auto& [a, b] : sides) {
      std::uint32_t end = b;
      for (std::size_t step = 0; !changes_.gone[a] && changes_.gone[end] && step < sides.size(); ++step) {
        const auto on = std::lower_bound(sides.begin(), sides.end(), Side{end, 0});
        if (on == sides.end() || (*on)[0] != end) {
          return {};
        }
        end = (*on)[1];
      }
      const Side side{changes_.becomes[a], changes_.becomes[end]};
      if (!changes_.gone[a] && side[0] != side[1]) {
        result.push_back(side);
      }
    }
    return result;
  }

  /// Twice the area that the sides enclose, as a vector across it.
  [[nodiscard]] Vec3 doubled_area(const std::vector<Side>& sides) const {
    const Vec3 origin = place(sides.front()[0]);
    Vec3 sum;
    for (const auto& [a, b] : sides) {
      sum += cross(place(a) - origin, place(b) - origin);
    }
    return sum;
  }

  [[nodiscard]] std::optional<std::vector<Face>> triangulated(const std::vector<std::uint32_t>& set) {
    const std::vector<Side> sides = outline(set);
    if (sides.size() < 3) {
      // What vanishes leaves its neighbours one side, run through in both directions.
      const bool vanishes =
          sides.empty() || (sides.size() == 2 && sides[0][0] == sides[1][1] && sides[0][1] == sides[1][0]);
      return vanishes ? std::optional(std::vector<Face>()) : std::nullopt;
    }
    Vec3 old;
    for (const std::uint32_t r : set) {
      for (const std::uint32_t f : regions_.faces(r)) {
        old += 2.0 * surface_.area(FaceId(f)) * surface_.normal(FaceId(f));
      }
    }
    const Vec3 doubled = doubled_area(sides);
    const Vec3 normal = normalized(doubled);
    if (normal == Vec3{} || dot(normal, normalized(old)) < turned_cosine) {
      return std::nullopt;
    }
    auto triangles = triangles_between(sides, changes_.places, PlaneFrame(place(sides.front()[0]), normal));
    if (!triangles || triangles->empty()) {
      return std::nullopt;
    }
    double covered = 0.0;
    for (const auto& [a, b, c] : *triangles) {
      covered += dot(cross(place(b) - place(a), place(c) - place(a)), normal);
    }
    const double enclosed = length(doubled);
    if (std::abs(covered - enclosed) > same_area * enclosed) {
      return std::nullopt;  // a hole came to lie outside, or something turned over
    }
    return triangles;
  }

  const mesh::Surface& surface_;
  const mesh::LooseFaces& loose_;
  const PanelRegions& regions_;
  RegionChanges& changes_;
  DisjointSets& sets_;
};

}  // namespace

RegionChanges::RegionChanges(const mesh::LooseFaces& loose, const PanelRegions& regions)
    : sets(regions.count()),
      gone(loose.points.size(), false),
      becomes(loose.points.size()),
      places(loose.points) {
  std::iota(becomes.begin(), becomes.end(), 0U);
}

MergedRegions merged_regions(const mesh::Surface& surface, const mesh::LooseFaces& loose,
                             const PanelRegions& regions, RegionChanges& changes) {
  return Merger(surface, loose, regions, changes).run();
}

}  // namespace ridgecraft::prepare
