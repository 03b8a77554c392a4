// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid/cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/no_index.hpp"
#include "solid/hulls.hpp"
#include "solid/rays.hpp"

namespace ridgecraft::solid {
namespace {

/// Rays over the longest side of the model's box, one number a round: what one round's rays covered, the next
/// round measures with others.
constexpr std::array<double, 4> rays_a_side{110.0, 167.0, 211.0, 256.0};
/// A share of a solid that is less than this is due to the rounding of heights.
constexpr double rounding = 1e-12;
/// Regions that are together less than this share of the solid aren't filled.
constexpr double ignored_share = 2e-4;
/// A body may hold this share of air, or air that is this share of the solid, before it is cut in two.
constexpr double air_share = 0.05;
constexpr double air_of_solid = 1e-3;
constexpr unsigned deepest_cut = 6;
/// Places where a region may be cut, along each axis; and points of it that are enough to choose by.
constexpr int places = 9;
constexpr std::size_t enough_points = 600;
/// How near bodies come to the points of a region, in steps between rays: ends of stretches lie in the sides
/// of other bodies up to rounding, which must not become sides of their own.
constexpr double accuracy = 5e-3;
/// Half the thickness of a flat piece of a region, in steps between rays.
constexpr double thinness = 1e-6;

/// One list of stretches for each axis.
using Three = std::array<Stretches, 3>;

double coordinate(Vec3 p, unsigned axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

/// A model's solid on rays along the three axes.
class RaySolid {
 public:
  RaySolid(const mesh::Surface& surface, std::span<const FaceId> faces, const Box3& box, double rays,
           const Context& context)
      : box_(box), step_(box_.largest_extent() / rays) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      context.check();
      rays_.emplace_back(box_, axis, step_);
      solid_[axis] = rays_[axis].inside(surface, faces);
    }
  }

  [[nodiscard]] const Rays& rays(unsigned axis) const { return rays_[axis]; }
  [[nodiscard]] const Stretches& solid(unsigned axis) const { return solid_[axis]; }
  [[nodiscard]] const Box3& box() const { return box_; }
  [[nodiscard]] double step() const { return step_; }
  /// The volume of what has these stretches: the mean of the three estimates.
  [[nodiscard]] double volume(const Three& of) const {
    return step_ * step_ * (total(of[0]) + total(of[1]) + total(of[2])) / 3.0;
  }
  [[nodiscard]] double volume() const { return volume(solid_); }
  [[nodiscard]] Three inside(const std::vector<Body>& bodies, const Context& context) const {
    Three result;
    for (unsigned axis = 0; axis < 3; ++axis) {
      Stretches all;
      for (const Body& body : bodies) {
        context.check();
        const Stretches one = rays_[axis].inside(body);
        all.insert(all.end(), one.begin(), one.end());
      }
      result[axis] = united(std::move(all));
    }
    return result;
  }
  [[nodiscard]] Three uncovered(const Three& covered) const {
    return {difference(solid_[0], covered[0]), difference(solid_[1], covered[1]),
            difference(solid_[2], covered[2])};
  }

 private:
  Box3 box_;
  double step_;
  std::vector<Rays> rays_;
  Three solid_;
};

/// A connected piece of what is uncovered.
struct Region {
  Three stretches;
  std::vector<Vec3> vertices;  ///< of the surface, in it or at its border
};

std::vector<Vec3> points_of(const Region& region, const RaySolid& solid) {
  std::vector<Vec3> points = region.vertices;
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (const Stretch& s : region.stretches[axis]) {
      points.push_back(solid.rays(axis).point(s.ray, s.from));
      points.push_back(solid.rays(axis).point(s.ray, s.to));
    }
  }
  return points;
}

/// Finds the connected regions of stretches on a grid of cells, one for each ray and step along it.
class Regions {
 public:
  Regions(const RaySolid& solid, const Three& uncovered) : solid_(solid) {
    const Vec3 size = solid.box().size();
    for (unsigned axis = 0; axis < 3; ++axis) {
      count_[axis] = static_cast<std::uint32_t>(coordinate(size, axis) / solid.step()) + 2;
    }
    label_.assign(std::size_t{count_[0]} * count_[1] * count_[2], outside);
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (const Stretch& s : uncovered[axis]) {
        for_cells(axis, s, [&](std::uint32_t cell) { label_[cell] = unlabelled; });
      }
    }
    for (std::uint32_t cell = 0; cell < label_.size(); ++cell) {
      if (label_[cell] == unlabelled) {
        flood(cell);
      }
    }
  }

  /// Largest first, without the small ones.
  [[nodiscard]] std::vector<Region> run(const mesh::Surface& surface, const Three& uncovered) {
    std::vector<Region> regions(regions_);
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (const Stretch& s : uncovered[axis]) {
        std::uint32_t label = outside;
        for_cells(axis, s, [&](std::uint32_t cell) { label = label_[cell]; });
        if (label != outside) {
          regions[label].stretches[axis].push_back(s);
        }
      }
    }
    for (const Vec3 p : surface.points()) {
      add_vertex(p, regions);
    }
    const auto size = [&](const Region& region) { return solid_.volume(region.stretches); };
    std::stable_sort(regions.begin(), regions.end(),
                     [&](const Region& a, const Region& b) { return size(a) > size(b); });
    double left_out = 0.0;
    while (!regions.empty() && (left_out += size(regions.back())) <= ignored_share * solid_.volume()) {
      regions.pop_back();
    }
    return regions;
  }

 private:
  static constexpr std::uint32_t outside = no_index;
  static constexpr std::uint32_t unlabelled = no_index - 1;
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] Cell cell_at(Vec3 p) const {
    const Vec3 q = (1.0 / solid_.step()) * (p - solid_.box().low);
    return {static_cast<std::int64_t>(std::floor(q.x)), static_cast<std::int64_t>(std::floor(q.y)),
            static_cast<std::int64_t>(std::floor(q.z))};
  }
  [[nodiscard]] bool is_cell(const Cell& c) const {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < count_[0] && c[1] < count_[1] && c[2] < count_[2];
  }
  [[nodiscard]] std::uint32_t number(const Cell& c) const {
    return static_cast<std::uint32_t>((c[2] * count_[1] + c[1]) * count_[0] + c[0]);
  }
  [[nodiscard]] Cell cell(std::uint32_t number) const {
    return {number % count_[0], number / count_[0] % count_[1], number / count_[0] / count_[1]};
  }

  /// The cells whose middle a stretch covers.
  template <class Visit>
  void for_cells(unsigned axis, const Stretch& s, const Visit& visit) const {
    Cell c = cell_at(solid_.rays(axis).point(s.ray, s.from));
    const double low = coordinate(solid_.box().low, axis);
    const double end = (s.to - low) / solid_.step() - 0.5;
    c[axis] = static_cast<std::int64_t>(std::ceil((s.from - low) / solid_.step() - 0.5));
    for (; static_cast<double>(c[axis]) <= end; ++c[axis]) {
      if (is_cell(c)) {
        visit(number(c));
      }
    }
  }

  void flood(std::uint32_t start) {
    std::vector<std::uint32_t> open{start};
    label_[start] = regions_;
    while (!open.empty()) {
      const Cell at = cell(open.back());
      open.pop_back();
      for (unsigned axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          Cell next = at;
          next[axis] += step;
          if (is_cell(next) && label_[number(next)] == unlabelled) {
            label_[number(next)] = regions_;
            open.push_back(number(next));
          }
        }
      }
    }
    ++regions_;
  }

  /// To the regions in the cells around it.
  void add_vertex(Vec3 p, std::vector<Region>& regions) const {
    const Cell at = cell_at(p);
    std::array<std::uint32_t, 27> found{};
    std::size_t n = 0;
    for (int i = 0; i < 27; ++i) {
      const Cell c{at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1};
      if (is_cell(c) && label_[number(c)] != outside) {
        found[n++] = label_[number(c)];
      }
    }
    std::sort(found.begin(), found.begin() + n);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == 0 || found[i] != found[i - 1]) {
        regions[found[i]].vertices.push_back(p);
      }
    }
  }

  const RaySolid& solid_;
  std::array<std::uint32_t, 3> count_{};
  std::vector<std::uint32_t> label_;
  std::uint32_t regions_ = 0;
};

/// The parts of a region on both sides of a plane across an axis.
std::array<Region, 2> cut(const Region& region, const RaySolid& solid, unsigned across, double place) {
  std::array<Region, 2> sides;
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (const Stretch& s : region.stretches[axis]) {
      if (axis != across) {
        const bool high = coordinate(solid.rays(axis).point(s.ray, s.from), across) > place;
        sides[high ? 1 : 0].stretches[axis].push_back(s);
        continue;
      }
      if (s.from < place) {
        sides[0].stretches[axis].push_back({s.ray, s.from, std::fmin(s.to, place)});
      }
      if (s.to > place) {
        sides[1].stretches[axis].push_back({s.ray, std::fmax(s.from, place), s.to});
      }
    }
  }
  for (const Vec3 p : region.vertices) {
    if (coordinate(p, across) <= place) {
      sides[0].vertices.push_back(p);
    }
    if (coordinate(p, across) >= place) {
      sides[1].vertices.push_back(p);
    }
  }
  return sides;
}

/// Fills regions with bodies.
class Filler {
 public:
  Filler(const RaySolid& solid, const Three& covered, const Context& context)
      : solid_(solid), context_(context) {
    Stretches all = solid.solid(2);
    all.insert(all.end(), covered[2].begin(), covered[2].end());
    not_air_ = united(std::move(all));
  }

  void fill(const Region& region, unsigned cuts, std::vector<Body>& bodies) const {
    const std::vector<Vec3> points = points_of(region, solid_);
    if (points.empty()) {
      return;
    }
    Body hull = hull_of(points);
    const double air =
        solid_.step() * solid_.step() * total(difference(solid_.rays(2).inside(hull), not_air_));
    const double allowed =
        std::fmax(air_share * mass_properties(hull).volume, air_of_solid * solid_.volume());
    if (cuts >= deepest_cut || air <= allowed) {
      bodies.push_back(std::move(hull));
      return;
    }
    for (const Region& side : best_cut(region, points)) {
      fill(side, cuts + 1, bodies);
    }
  }

 private:
  [[nodiscard]] Body hull_of(const std::vector<Vec3>& points) const {
    return nearly_convex_hull(points, accuracy * solid_.step(), thinness * solid_.step(), context_);
  }

  [[nodiscard]] std::array<Region, 2> best_cut(const Region& region, const std::vector<Vec3>& points) const {
    Box3 box;
    for (const Vec3 p : points) {
      box.add(p);
    }
    const Region sample = thinned(region, points.size() / enough_points + 1);
    double least = INFINITY;
    unsigned across = 0;
    double place = 0.0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (int i = 1; i <= places; ++i) {
        const double share = static_cast<double>(i) / (places + 1);
        const double at = (1.0 - share) * coordinate(box.low, axis) + share * coordinate(box.high, axis);
        double volume = 0.0;
        for (const Region& side : cut(sample, solid_, axis, at)) {
          const std::vector<Vec3> there = points_of(side, solid_);
          volume += there.empty() ? 0.0 : mass_properties(hull_of(there)).volume;
        }
        if (volume < least) {
          least = volume;
          across = axis;
          place = at;
        }
      }
    }
    return cut(region, solid_, across, place);
  }

  static Region thinned(const Region& region, std::size_t every) {
    Region sample;
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < region.stretches[axis].size(); i += every) {
        sample.stretches[axis].push_back(region.stretches[axis][i]);
      }
    }
    for (std::size_t i = 0; i < region.vertices.size(); i += every) {
      sample.vertices.push_back(region.vertices[i]);
    }
    return sample;
  }

  const RaySolid& solid_;
  const Context& context_;
  Stretches not_air_;  ///< along z
};

Box3 box_of(const mesh::Surface& surface, const std::vector<Body>& bodies) {
  Box3 box = surface.bounds();
  for (const Body& body : bodies) {
    for (const Vec3 p : body.points) {
      box.add(p);
    }
  }
  return box;
}

Moments moments_of(const Three& stretches, const RaySolid& solid) {
  Moments sum;
  const double share = solid.step() * solid.step() / 3.0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (const Stretch& s : stretches[axis]) {
      const Vec3 half = 0.5 * (solid.rays(axis).point(s.ray, s.to) - solid.rays(axis).point(s.ray, s.from));
      const Vec3 middle = solid.rays(axis).point(s.ray, s.from) + half;
      const double volume = share * (s.to - s.from);
      sum.volume += volume;
      sum.first += volume * middle;
      // A stretch's own moments: a third of the square of half its length, along it alone.
      sum.second[0] += volume * (middle.x * middle.x + half.x * half.x / 3.0);
      sum.second[1] += volume * (middle.y * middle.y + half.y * half.y / 3.0);
      sum.second[2] += volume * (middle.z * middle.z + half.z * half.z / 3.0);
      sum.second[3] += volume * middle.x * middle.y;
      sum.second[4] += volume * middle.x * middle.z;
      sum.second[5] += volume * middle.y * middle.z;
    }
  }
  return sum;
}

Fit fit_on(const RaySolid& solid, const Three& covered) {
  Fit fit;
  fit.solid_volume = solid.volume();
  fit.union_volume = solid.volume(covered);
  const double share = solid.volume(solid.uncovered(covered)) / fit.solid_volume;
  fit.uncovered = share > rounding ? share : 0.0;
  return fit;
}

}  // namespace

std::vector<FaceId> closed_faces(const mesh::Surface& surface) {
  std::vector<bool> open(surface.component_count(), false);
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e)) {
      open[surface.component(mesh::face_of(surface.sides(e)[0])).value()] = true;
    }
  }
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    if (!open[surface.component(f).value()]) {
      faces.push_back(f);
    }
  }
  return faces;
}

Fit cover_volume(const mesh::Surface& surface, std::vector<Body>& bodies, const Context& context) {
  const std::vector<FaceId> faces = closed_faces(surface);
  if (faces.empty()) {
    return {};
  }
  Fit fit;
  for (const double rays : rays_a_side) {
    const RaySolid solid(surface, faces, box_of(surface, bodies), rays, context);
    const Three covered = solid.inside(bodies, context);
    fit = fit_on(solid, covered);
    if (!(fit.uncovered > most_uncovered)) {
      break;
    }
    const Three uncovered = solid.uncovered(covered);
    const Filler filler(solid, covered, context);
    for (const Region& region : Regions(solid, uncovered).run(surface, uncovered)) {
      filler.fill(region, 0, bodies);
    }
  }
  return fit;
}

Moments moments_on_rays(const mesh::Surface& surface, const Context& context) {
  const RaySolid solid(surface, closed_faces(surface), surface.bounds(), rays_a_side.back(), context);
  return moments_of({solid.solid(0), solid.solid(1), solid.solid(2)}, solid);
}

Moments moments_on_rays(const std::vector<Body>& bodies, const Context& context) {
  const mesh::Surface nothing;
  const RaySolid space(nothing, {}, box_of(nothing, bodies), rays_a_side.back(), context);
  return moments_of(space.inside(bodies, context), space);
}

Fit fit_of(const mesh::Surface& surface, const std::vector<Body>& bodies, const Context& context) {
  const std::vector<FaceId> faces = closed_faces(surface);
  if (faces.empty()) {
    return {};
  }
  const RaySolid solid(surface, faces, box_of(surface, bodies), rays_a_side.back(), context);
  return fit_on(solid, solid.inside(bodies, context));
}

}  // namespace ridgecraft::solid
