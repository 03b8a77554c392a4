// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/walls/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "base/elementary.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/regions.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr double degrees = std::numbers::pi / 180.0;
/// A fold of this much is the edge of something; what is round has smaller ones.
constexpr double sharp = 30.0 * degrees;
/// Narrow faces between two folds of less, both to the same side, are a bevel; at a plate's rim they are 90
/// degrees.
constexpr double bevel = 75.0 * degrees;
/// Areas as multiples of the short edge's square: smaller regions are details, ...
constexpr double detail = 0.5;
/// ... and regions of this size are walls whatever is around them.
constexpr double large = 4.0;
/// Regions whose planes differ by less are of one plane: components of their normals, and distances along
/// these as a share of the short edge.
constexpr double same_normal = 2e-3;
constexpr double same_height = 0.01;
/// Planes at smaller angles have a common line that isn't known well.
const double distinct = elementary::sin(2.0 * degrees);
/// Components of which walls are less of the area are no hard surfaces.
constexpr double least_fraction = 0.4;
/// A share of a detail's area that no wall and no slat, which may lean, is below.
constexpr double nearly = 0.125;

/// A flat region, and what it meets.
struct Region {
  double area = 0.0;
  Vec3 normal;                 ///< of length twice the area
  Vec3 moment;                 ///< its middle times its area
  double area_in_plane = 0.0;  ///< with all other regions of its plane that look the same way
  double perimeter = 0.0;
  double sharp = 0.0;  ///< length of its sides that are sharp or borders
  /// Of each neighbour: the length of the common sides, and that times the fold.
  std::map<std::uint32_t, std::array<double, 2>> beside;

  /// Short side of the rectangle with the same area and perimeter.
  [[nodiscard]] double width() const {
    const double root = perimeter * perimeter - 16.0 * area;
    return root > 0.0 ? (perimeter - std::sqrt(root)) / 4.0 : std::sqrt(area);
  }

  /// Between two neighbours that it runs along, and that would meet without it.
  [[nodiscard]] bool is_bevel() const {
    std::array<std::array<double, 2>, 2> longest{};
    for (const auto& [other, side] : beside) {
      if (side[0] > longest[0][0]) {
        longest[1] = longest[0];
        longest[0] = side;
      } else if (side[0] > longest[1][0]) {
        longest[1] = side;
      }
    }
    if (longest[1][0] < 0.2 * perimeter) {
      return false;
    }
    const double first = longest[0][1] / longest[0][0];
    const double second = longest[1][1] / longest[1][0];
    return first * second > 0.0 && std::abs(first) < bevel && std::abs(second) < bevel;
  }

  [[nodiscard]] bool is_wall(double short_edge) const {
    const double unit = short_edge * short_edge;
    const bool has_edges = sharp >= 0.5 * perimeter;
    if (area < detail * unit) {
      return false;
    }
    if (area_in_plane >= large * unit && area_in_plane > area && area >= 0.5 * large * unit &&
        width() >= 0.5 * short_edge) {
      return true;  // a wall that something runs across; no narrower than a fold can be short
    }
    return width() >= short_edge ? has_edges || area >= large * unit : has_edges && !is_bevel();
  }
};

/// Adds up the areas of regions that lie in one plane and are no details. O(n log n).
void add_areas_in_planes(std::vector<Region>& regions, double short_edge) {
  struct Plane {
    Vec3 normal;
    double height = 0.0;
    double area = 0.0;
  };
  const double near = same_height * short_edge;
  std::vector<Plane> planes;
  std::map<std::array<std::int64_t, 4>, std::vector<std::size_t>> in_cell;
  const auto cell_of = [&](const Plane& plane) {
    return std::array<std::int64_t, 4>{
        std::llround(plane.normal.x / same_normal), std::llround(plane.normal.y / same_normal),
        std::llround(plane.normal.z / same_normal), std::llround(plane.height / near)};
  };
  const auto find = [&](const Plane& plane) -> std::optional<std::size_t> {
    const std::array<std::int64_t, 4> middle = cell_of(plane);
    for (int neighbour = 0; neighbour < 81; ++neighbour) {
      std::array<std::int64_t, 4> cell = middle;
      for (int k = 0, rest = neighbour; k < 4; ++k, rest /= 3) {
        cell[static_cast<std::size_t>(k)] += rest % 3 - 1;
      }
      const auto at = in_cell.find(cell);
      if (at == in_cell.end()) {
        continue;
      }
      for (const std::size_t p : at->second) {
        const Vec3 off = planes[p].normal - plane.normal;
        if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) <= same_normal &&
            std::abs(planes[p].height - plane.height) <= near) {
          return p;
        }
      }
    }
    return std::nullopt;
  };
  std::vector<std::size_t> plane_of(regions.size(), regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Vec3 normal = normalized(regions[r].normal);
    if (normal == Vec3{} || regions[r].area < detail * short_edge * short_edge) {
      continue;
    }
    const Plane own{normal, dot(regions[r].moment, normal) / regions[r].area, 0.0};
    const std::optional<std::size_t> known = find(own);
    plane_of[r] = known.value_or(planes.size());
    if (!known) {
      in_cell[cell_of(own)].push_back(planes.size());
      planes.push_back(own);
    }
    planes[plane_of[r]].area += regions[r].area;
  }
  for (std::size_t r = 0; r < regions.size(); ++r) {
    regions[r].area_in_plane = plane_of[r] < planes.size() ? planes[plane_of[r]].area : 0.0;
  }
}

/// Regions that are too small for a wall don't tell what is beside them: of a fine model that is nearly all.
std::vector<Region> regions_of(const mesh::Surface& surface, const Panels& panels, double short_edge) {
  std::vector<Region> regions(panels.count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    Region& region = regions[panels.panel[f].value()];
    region.area += surface.area(f);
    region.normal += 2.0 * surface.area(f) * surface.normal(f);
    const auto [a, b, c] = surface.vertices(f);
    region.moment += (surface.area(f) / 3.0) * (surface.point(a) + surface.point(b) + surface.point(c));
  }
  const double smallest = detail * short_edge * short_edge;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    const std::uint32_t a = panels.panel[mesh::face_of(c)].value();
    const bool inner = d.valid();
    const std::uint32_t b = inner ? panels.panel[mesh::face_of(d)].value() : a;
    if (inner && a == b) {
      continue;
    }
    const auto add = [&](Region& region, std::uint32_t other) {
      if (region.area < smallest) {
        return;
      }
      const double length = surface.length(e);
      const double fold = surface.fold_angle(e);
      region.perimeter += length;
      region.sharp += !inner || std::abs(fold) >= sharp ? length : 0.0;
      if (inner) {
        region.beside[other][0] += length;
        region.beside[other][1] += length * fold;
      }
    };
    add(regions[a], b);
    if (inner) {
      add(regions[b], a);
    }
  }
  return regions;
}

/// Whether regions that are nearly large enough for a wall or a slat are a good part of any component: of
/// fine smooth models they aren't, and nothing more has to be looked at.
bool may_be_hard(const mesh::Surface& surface, const Panels& panels, double short_edge) {
  const double smallest = nearly * detail * short_edge * short_edge;
  std::vector<double> area(panels.count(), 0.0);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    area[panels.panel[f].value()] += surface.area(f);
  }
  std::vector<double> all(surface.component_count(), 0.0);
  std::vector<double> large_enough(surface.component_count(), 0.0);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    all[surface.component(f).value()] += surface.area(f);
    large_enough[surface.component(f).value()] +=
        area[panels.panel[f].value()] >= smallest ? surface.area(f) : 0.0;
  }
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (large_enough[c] >= 0.5 * least_fraction * all[c]) {
      return true;
    }
  }
  return false;
}

/// Of each component: are walls a good part of it?
std::vector<bool> hard_components(const mesh::Surface& surface, const Panels& panels,
                                  const std::vector<std::uint32_t>& wall) {
  std::vector<double> area(surface.component_count(), 0.0);
  std::vector<double> flat(surface.component_count(), 0.0);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    area[surface.component(f).value()] += surface.area(f);
    flat[surface.component(f).value()] +=
        wall[panels.panel[f].value()] != Walls::none ? surface.area(f) : 0.0;
  }
  std::vector<bool> hard(area.size());
  for (std::size_t c = 0; c < hard.size(); ++c) {
    hard[c] = flat[c] >= least_fraction * area[c];
  }
  return hard;
}

}  // namespace

void Meeting::add(Vec3 normal, double offset) {
  if (directions_.size() == 3) {
    return;
  }
  Vec3 direction = normal;
  for (const Vec3 d : directions_) {
    direction -= dot(direction, d) * d;
  }
  const double rest = length(direction);
  if (rest < distinct) {
    return;
  }
  direction = direction / rest;
  place_ += ((offset - dot(place_, normal)) / rest) * direction;
  directions_.push_back(direction);
}

Walls find_walls(const mesh::Surface& surface, const Panels& panels, double short_edge_mm) {
  if (!may_be_hard(surface, panels, short_edge_mm)) {
    return {{}, std::vector<std::uint32_t>(surface.face_count(), Walls::none)};
  }
  std::vector<Region> regions = regions_of(surface, panels, short_edge_mm);
  add_areas_in_planes(regions, short_edge_mm);
  Walls result;
  std::vector<std::uint32_t> wall(regions.size(), Walls::none);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Vec3 normal = normalized(regions[r].normal);
    if (normal != Vec3{} && regions[r].is_wall(short_edge_mm)) {
      wall[r] = static_cast<std::uint32_t>(result.walls.size());
      result.walls.push_back({normal, 0.0});
    }
  }
  const std::vector<bool> hard = hard_components(surface, panels, wall);
  result.of_face.assign(surface.face_count(), Walls::none);
  std::vector<double> area(result.walls.size(), 0.0);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const std::uint32_t w = wall[panels.panel[f].value()];
    if (w == Walls::none) {
      continue;
    }
    const auto [a, b, c] = surface.vertices(f);
    const Vec3 middle = (surface.point(a) + surface.point(b) + surface.point(c)) / 3.0;
    result.walls[w].offset += surface.area(f) * dot(middle, result.walls[w].normal);
    area[w] += surface.area(f);
    result.of_face[f.value()] = hard[surface.component(f).value()] ? w : Walls::none;
  }
  for (std::size_t w = 0; w < area.size(); ++w) {
    result.walls[w].offset /= area[w];
  }
  return result;
}

Walls walls_of(const Walls& whole, const FundamentalDomain& domain) {
  Walls result;
  result.walls = whole.walls;
  for (const std::uint32_t origin : domain.faces.material) {
    result.of_face.push_back(whole.wall(domain.origins[origin].face));
  }
  return result;
}

}  // namespace ridgecraft::prepare
