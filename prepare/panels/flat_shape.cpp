// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/flat_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

}  // namespace ridgecraft::prepare
