// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/page_cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::prepare {
namespace {

/// Paper that hangs together over less than this doesn't, mm.
constexpr double least_link_mm = 1e-3;
/// Less paper is rounding, mm^2.
constexpr double least_tile_mm2 = 1e-3;

using Tile = std::vector<Vec2>;

/// The part of a convex tile where dot(p, normal) >= offset.
Tile clipped(const Tile& tile, Vec2 normal, double offset) {
  return part_where(tile, [&](Vec2 p) { return dot(p, normal) - offset; });
}

double area_of(const Tile& tile) {
  return 0.5 * doubled_area(tile);
}

/// What lies between two parallel lines.
FlatShape strip(const FlatShape& shape, Vec2 across, double low, double high) {
  FlatShape result;
  std::vector<std::uint32_t> number(shape.tiles.size(), 0);
  std::vector<bool> there(shape.tiles.size(), false);
  for (std::size_t i = 0; i < shape.tiles.size(); ++i) {
    Tile tile = clipped(clipped(shape.tiles[i], across, low), -across, -high);
    if (area_of(tile) > least_tile_mm2) {
      there[i] = true;
      number[i] = static_cast<std::uint32_t>(result.tiles.size());
      result.tiles.push_back(std::move(tile));
    }
  }
  for (const Link& link : shape.links) {
    if (there[link.a] && there[link.b]) {
      const Tile kept = clipped(clipped({link.from, link.to}, across, low), -across, -high);
      if (kept.size() >= 2 && length(kept[1] - kept[0]) > least_link_mm) {
        result.links.push_back({number[link.a], number[link.b], kept[0], kept[1]});
      }
    }
  }
  return result;
}

std::vector<FlatShape> connected_shapes(const FlatShape& shape) {
  DisjointSets sets(shape.tiles.size());
  for (const Link& link : shape.links) {
    sets.join(link.a, link.b);
  }
  std::vector<FlatShape> shapes;
  std::vector<std::uint32_t> home(shape.tiles.size(), 0);
  std::vector<std::uint32_t> number(shape.tiles.size(), 0);
  for (std::uint32_t i = 0; i < shape.tiles.size(); ++i) {
    const std::uint32_t root = sets.find(i);
    if (root == i) {
      home[i] = static_cast<std::uint32_t>(shapes.size());
      shapes.emplace_back();
    }
    home[i] = home[root];
    number[i] = static_cast<std::uint32_t>(shapes[home[i]].tiles.size());
    shapes[home[i]].tiles.push_back(shape.tiles[i]);
  }
  for (const Link& link : shape.links) {
    shapes[home[link.a]].links.push_back({number[link.a], number[link.b], link.from, link.to});
  }
  return shapes;
}

}  // namespace

double FlatShape::area() const {
  double sum = 0.0;
  for (const Tile& tile : tiles) {
    sum += area_of(tile);
  }
  return sum;
}

std::vector<Vec2> FlatShape::points() const {
  std::vector<Vec2> all;
  for (const Tile& tile : tiles) {
    all.insert(all.end(), tile.begin(), tile.end());
  }
  return all;
}

Reach reach(const std::vector<Vec2>& points, Vec2 direction) {
  Reach found{INFINITY, -INFINITY};
  for (const Vec2 p : points) {
    found.low = std::min(found.low, dot(p, direction));
    found.high = std::max(found.high, dot(p, direction));
  }
  return found;
}

std::vector<FlatShape> cut_shape(const FlatShape& shape, const Cuts& cuts) {
  std::vector<FlatShape> shapes;
  for (std::size_t i = 0; i <= cuts.at.size(); ++i) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    const double low = i == 0 ? -endless : cuts.at[i - 1];
    const double high = i == cuts.at.size() ? endless : cuts.at[i];
    for (FlatShape& part : connected_shapes(strip(shape, cuts.across, low, high))) {
      shapes.push_back(std::move(part));
    }
  }
  return shapes;
}

double cut_length(const FlatShape& shape, const Cuts& cuts) {
  double sum = 0.0;
  for (const double at : cuts.at) {
    for (const Tile& tile : shape.tiles) {
      std::vector<Vec2> on;
      for (std::size_t i = 0; i < tile.size(); ++i) {
        const Vec2 q = tile[(i + 1) % tile.size()];
        const double a = dot(tile[i], cuts.across) - at;
        const double b = dot(q, cuts.across) - at;
        if ((a >= 0.0 && b < 0.0) || (a < 0.0 && b >= 0.0)) {
          on.push_back(tile[i] + (a / (a - b)) * (q - tile[i]));
        }
      }
      sum += on.empty() ? 0.0 : reach(on, perpendicular(cuts.across)).size();
    }
  }
  return sum;
}

namespace {

/// Corners nearer to each other than this are one, mm: rounding.
constexpr double one_corner_mm = 1e-7;
/// Directions of cuts that are tried: those that most of the outline runs along.
constexpr std::size_t most_directions = 8;
/// Directions closer than this are one, radians (a hundredth of a degree).
constexpr double same_direction = 1.7e-4;
/// A piece narrower than this in the mean is a strip, mm: hard to glue by its long side.
constexpr double strip_mm = 12.0;
/// Cuts shorter by less than this are as long, mm: the first one found stays.
constexpr double same_length_mm = 1e-6;
/// Concave corners that are tried, and tiles up to which they are: each asks for two more plans.
constexpr std::size_t most_corners = 12;
constexpr std::size_t most_tiles_for_corners = 200;
/// Where there will be more pieces than this, one grid is tried for each direction: it hardly matters.
constexpr double many_pieces = 100.0;

using Sides = std::vector<std::array<Vec2, 2>>;

struct Cost {
  std::size_t pieces = 0;  ///< strips count twice
  double length = 0.0;

  [[nodiscard]] bool less_than(const Cost& other) const {
    return pieces != other.pieces ? pieces < other.pieces : length < other.length - same_length_mm;
  }
};

struct Plan {
  Cuts cuts;
  Cost cost{static_cast<std::size_t>(-1), INFINITY};
};

bool is_strip(const FlatShape& shape) {
  const std::vector<Vec2> hull = convex_hull(shape.points());
  double longest = 0.0;
  for (const Vec2 p : hull) {
    for (const Vec2 q : hull) {
      longest = std::max(longest, length(p - q));
    }
  }
  return shape.area() < strip_mm * longest;
}

/// Lines that divide the shape into strips of one width.
Cuts equal_strips(const FlatShape& shape, Vec2 across, std::size_t strips) {
  Cuts cuts{across, {}};
  const Reach all = reach(shape.points(), across);
  for (std::size_t i = 1; i < strips; ++i) {
    cuts.at.push_back(all.low + all.size() * static_cast<double>(i) / static_cast<double>(strips));
  }
  return cuts;
}

/// How few of this size reach that far.
std::size_t times(double size, double reached) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(reached / size - 1e-9)));
}

class Planner {
 public:
  Planner(Vec2 page, const Context& context)
      : wide_(std::max(page.x, page.y)), narrow_(std::min(page.x, page.y)), page_(page), context_(context) {}

  [[nodiscard]] Plan plan(const FlatShape& shape, const std::vector<Vec2>& directions) const {
    Plan best;
    for (const Vec2 along : directions) {
      for (const Vec2 across : {along, perpendicular(along)}) {
        const double extent = reach(shape.points(), across).size();
        const bool many = shape.area() > many_pieces * page_.x * page_.y;
        const std::size_t most = std::max<std::size_t>(2, times(narrow_, extent));
        for (std::size_t n = many ? most : std::max<std::size_t>(2, times(wide_, extent)); n <= most; ++n) {
          context_.check();
          Cuts cuts = equal_strips(shape, across, n);
          const Cost cost = cost_of(shape, cuts);
          if (cost.less_than(best.cost)) {
            best = {std::move(cuts), cost};
          }
        }
      }
    }
    return best;
  }

  /// The best of the single cuts, each with the best plan for what it leaves.
  [[nodiscard]] Plan plan_from_corners(const FlatShape& shape, const std::vector<Cuts>& single,
                                       const std::vector<Vec2>& directions) const {
    Plan best;
    for (const Cuts& cuts : single) {
      Cost cost{0, cut_length(shape, cuts)};
      const std::vector<FlatShape> parts = cut_shape(shape, cuts);
      for (const FlatShape& part : parts) {
        const Cost own = fits_page(part.points(), page_) ? expand(part) : plan(part, directions).cost;
        cost.pieces += own.pieces;
        cost.length += own.length;
      }
      if (parts.size() > 1 && cost.less_than(best.cost)) {
        best = {cuts, cost};
      }
    }
    return best;
  }

 private:
  static Cost expand(const FlatShape& shape) { return {is_strip(shape) ? 2U : 1U, 0.0}; }

  /// Of these strips, each cut across into as few lengths as fit.
  [[nodiscard]] Cost cost_of(const FlatShape& shape, const Cuts& cuts) const {
    Cost cost{0, cut_length(shape, cuts)};
    for (const FlatShape& part : cut_shape(shape, cuts)) {
      const Cost own = lengths(part, perpendicular(cuts.across));
      cost.pieces += own.pieces;
      cost.length += own.length;
    }
    return cost;
  }

  [[nodiscard]] Cost lengths(const FlatShape& shape, Vec2 across) const {
    if (fits_page(shape.points(), page_)) {
      return expand(shape);
    }
    const double extent = reach(shape.points(), across).size();
    for (std::size_t n = std::max<std::size_t>(2, times(wide_, extent)); n <= times(narrow_, extent) + 1;
         ++n) {
      const Cuts cuts = equal_strips(shape, across, n);
      Cost cost{0, cut_length(shape, cuts)};
      const std::vector<FlatShape> parts = cut_shape(shape, cuts);
      const bool fit = std::all_of(parts.begin(), parts.end(), [&](const FlatShape& part) {
        cost.pieces += expand(part).pieces;
        return fits_page(part.points(), page_);
      });
      if (fit) {
        return cost;
      }
    }
    // Strips as wide as this must be cut along, too; how often isn't known here.
    const double left = shape.area() / (narrow_ * narrow_);
    return {4 * times(1.0, left), extent};
  }

  double wide_;
  double narrow_;
  Vec2 page_;
  const Context& context_;
};

/// Of length 1, within a quarter turn: cuts run along both axes.
Vec2 as_direction(Vec2 along) {
  Vec2 d = along / length(along);
  while (!(d.x > 0.0 && d.y >= 0.0)) {
    d = perpendicular(d);
  }
  return d;
}

bool same(Vec2 a, Vec2 b) {
  return std::min(std::abs(cross(a, b)), std::abs(dot(a, b))) < same_direction;
}

/// The side of the hull on which the rectangle around the shape has the least area (H. Freeman, R. Shapira,
/// CACM 18, 1975).
Vec2 narrowest_rectangle(const std::vector<Vec2>& hull) {
  Vec2 best{1.0, 0.0};
  double least = INFINITY;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 d = as_direction(hull[(i + 1) % hull.size()] - hull[i]);
    const double area = reach(hull, d).size() * reach(hull, perpendicular(d)).size();
    if (area < least * (1.0 - 1e-9)) {
      least = area;
      best = d;
    }
  }
  return best;
}

/// The narrowest rectangle's, then those that most of the outline runs along.
std::vector<Vec2> directions_of(const std::vector<Vec2>& hull, const Sides& sides) {
  struct Run {
    Vec2 along;
    double length = 0.0;
  };
  std::vector<Run> runs;
  for (const auto& [a, b] : sides) {
    const double size = length(b - a);
    if (!(size > 0.0)) {
      continue;
    }
    const Vec2 d = as_direction(b - a);
    const auto known = std::find_if(runs.begin(), runs.end(), [&](const Run& r) { return same(r.along, d); });
    if (known != runs.end()) {
      known->length += size;
    } else if (runs.size() < 32 * most_directions) {
      runs.push_back({d, size});
    }
  }
  // Lengths that differ by rounding alone count as equal.
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
    return static_cast<float>(a.length) > static_cast<float>(b.length);
  });
  std::vector<Vec2> directions{narrowest_rectangle(hull)};
  for (const Run& run : runs) {
    if (directions.size() < most_directions && !same(run.along, directions[0])) {
      directions.push_back(run.along);
    }
  }
  return directions;
}

/// Lines that run on along a side into the shape from where two sides meet at a concave corner.
std::vector<Cuts> corner_cuts(const Sides& sides) {
  std::vector<Cuts> cuts;
  for (const auto& [a, b] : sides) {
    for (const auto& [c, d] : sides) {
      if (length(b - c) > one_corner_mm || !(length(b - a) > 0.0) || !(length(d - c) > 0.0)) {
        continue;
      }
      const Vec2 in = (b - a) / length(b - a);
      const Vec2 out = (d - c) / length(d - c);
      if (cross(in, out) < -same_direction && cuts.size() < 2 * most_corners) {
        for (const Vec2 along : {in, out}) {
          const Vec2 across = perpendicular(along);
          cuts.push_back({across, {dot(b, across)}});
        }
      }
    }
  }
  return cuts;
}

}  // namespace

bool fits_page(const std::vector<Vec2>& points, Vec2 page) {
  return angle_to_fit(convex_hull(points), {page.x, page.y}).has_value();
}

Cuts plan_cuts(const FlatShape& shape, const Sides& sides, Vec2 page, const Context& context) {
  const std::vector<Vec2> hull = convex_hull(shape.points());
  const std::vector<Vec2> directions = directions_of(hull, sides);
  const Planner planner(page, context);
  Plan best = planner.plan(shape, directions);
  if (shape.tiles.size() <= most_tiles_for_corners && best.cost.pieces > 2 &&
      shape.area() < many_pieces * page.x * page.y) {
    Plan other = planner.plan_from_corners(shape, corner_cuts(sides), directions);
    if (other.cost.less_than(best.cost)) {
      best = std::move(other);
    }
  }
  return best.cuts;
}

}  // namespace ridgecraft::prepare
