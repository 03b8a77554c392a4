// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/objective.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/foundation/convex_hull.hpp"
#include "unfold/room.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/search/layout.hpp"

namespace ridgecraft::unfold {
namespace {

/// Unit of the cut length, mm: about ten edges of a model for the hand.
constexpr double cut_unit_mm = 100.0;
/// Unit of the area that a piece wastes, mm2: a fifth of an A4 page.
constexpr double hollow_unit_mm2 = 10000.0;
/// A piece this wide is held without trouble, mm.
constexpr double handy_mm = 30.0;
/// A neck is thin when the branch behind it is this many times wider than it.
constexpr double thin_ratio = 3.0;
/// A piece of so many panels is an evening's work by itself.
constexpr double many_panels = 80.0;

/// How thin the necks of a tree are: for each fold the width of the smaller side (the root of its area) over
/// the fold's length, beyond what is harmless.
double thinness(const Patch& piece, const Folds& tree) {
  std::vector<std::uint32_t> place(piece.size(), nothing);
  const RootedTree rooted = rooted_tree(piece, tree, 0, place);
  std::vector<double> area(rooted.order.size(), 0.0);
  for (std::size_t i = area.size(); i-- > 0;) {
    area[i] += area_of(piece.shape[rooted.order[i]]);
    if (i > 0) {
      area[rooted.parent[i]] += area[i];
    }
  }
  double thin = 0.0;
  for (std::size_t i = 1; i < area.size(); ++i) {
    if (piece.frozen[rooted.up[i]] == 0) {
      const double width = std::sqrt(std::min(area[i], area[0] - area[i]));
      thin += std::max(0.0, width / std::max(piece.length[rooted.up[i]], 1e-3 * width + 1e-9) - thin_ratio);
    }
  }
  return thin;
}

double square(double x) {
  return x * x;
}

}  // namespace

double least_cost_of_piece(const Patch& piece, std::size_t parts, const Weights& weights) {
  double outline = 0.0;
  for (std::size_t side = 0; side < piece.twin.size(); ++side) {
    // Each cut has two sides; those of another piece count there.
    outline += piece.twin[side] == nothing ? 0.5 * piece.length[side] : 0.0;
  }
  return weights.pieces + weights.cut * outline / cut_unit_mm +
         weights.parts * static_cast<double>(parts - 1) +
         weights.small * std::max(0.0, 1.0 - std::sqrt(area_of(piece)) / handy_mm) +
         weights.panels * square(static_cast<double>(panel_count(piece)) / many_panels);
}

double cost_of_piece(const Patch& piece, const Folds& tree, std::size_t parts, const Weights& weights) {
  double cut = 0.0;
  for (std::size_t side = 0; side < tree.size(); ++side) {
    cut += tree[side] == 0 && piece.twin[side] != nothing ? 0.5 * piece.length[side] : 0.0;
  }
  double area = 0.0;
  std::vector<Vec2> points;
  for (const Triangle& t : lay_out(piece, tree).flat) {
    area += area_of(t);
    points.insert(points.end(), t.begin(), t.end());
  }
  const std::vector<Vec2> hull = convex_hull(std::move(points));
  double hull_area = 0.0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    hull_area += 0.5 * cross(hull[i] - hull[0], hull[i + 1] - hull[0]);
  }
  const double hollow = std::max(0.0, hull_area - area) / hollow_unit_mm2;
  return least_cost_of_piece(piece, parts, weights) + weights.cut * cut / cut_unit_mm +
         weights.compact * hollow + weights.thin * thinness(piece, tree);
}

}  // namespace ridgecraft::unfold
