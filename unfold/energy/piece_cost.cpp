// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/piece_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "unfold/patch/forest.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/necks.hpp"
#include "unfold/patch/room.hpp"

namespace ridgecraft::unfold {
namespace {

/// A piece this wide is held without trouble, mm.
constexpr double handy_mm = 30.0;
/// A piece of so many panels is an evening's work by itself.
constexpr double many_panels = 80.0;

/// How thin the necks of a tree are.
double thinness(const Patch& piece, const Folds& folds, const RootedTree& tree,
                const std::vector<double>& areas, const std::vector<std::uint8_t>& narrow) {
  std::vector<double> area(tree.order.size());
  for (std::size_t i = 0; i < area.size(); ++i) {
    area[i] = areas[tree.order[i]];
  }
  for (std::size_t i = area.size(); i-- > 1;) {
    area[tree.parent[i]] += area[i];
  }
  double thin = 0.0;
  for (std::size_t i = 1; i < area.size(); ++i) {
    if (piece.frozen[tree.up[i]] == 0) {
      thin += neck_cost(piece.length[tree.up[i]], std::min(area[i], area[0] - area[i]));
    }
  }
  for (std::size_t i = 0; i < area.size() && !narrow.empty(); ++i) {
    const std::uint32_t face = tree.order[i];
    const std::uint32_t cut = only_cut(folds, face);
    if (cut != nothing && narrow[cut] != 0) {
      const double behind = i > 0 ? area[i] - areas[face] : area[1];
      thin += thread_cost_between(behind, area[0] - areas[face] - behind);
    }
  }
  return thin;
}

double square(double x) {
  return x * x;
}

/// What a piece of these faces costs beside its seams and its shape.
double cost_of_any_tree(const Patch& piece, std::size_t parts, const Weights& weights) {
  return weights.pieces + weights.parts * static_cast<double>(parts - 1) +
         weights.small * std::max(0.0, 1.0 - std::sqrt(area_of(piece)) / handy_mm) +
         weights.panels * square(static_cast<double>(panel_count(piece)) / many_panels);
}

}  // namespace

double outline_cost(double outline, const Weights& weights) {
  return weights.outline * square(outline) / 1000.0;
}

double least_cost_of_piece(const Patch& piece, std::size_t parts, const Weights& weights) {
  double outline = 0.0;
  double seams = 0.0;
  for (std::uint32_t side = 0; side < piece.twin.size(); ++side) {
    // Each cut has two sides; those of another piece count there.
    const double half = 0.5 * seam_price(piece, side, weights);
    if (piece.twin[side] == nothing) {
      outline += piece.length[side];
      seams += half;
    } else {
      seams += std::min(0.0, half);  // a cut that is wanted
    }
  }
  return cost_of_any_tree(piece, parts, weights) + seams + outline_cost(outline, weights);
}

PieceCost::PieceCost(const Patch& piece, std::size_t parts, const Weights& weights)
    : piece_(piece),
      weights_(weights),
      cuts_(piece, {}, weights),
      any_tree_(cost_of_any_tree(piece, parts, weights)),
      narrow_(narrow_sides(piece)),
      place_(piece.size(), nothing) {
  for (std::uint32_t side = 0; side < piece.twin.size(); ++side) {
    if (piece.twin[side] == nothing) {
      border_ += piece.length[side];
      any_tree_ += 0.5 * seam_price(piece, side, weights);
    }
  }
  for (const Triangle& t : piece.shape) {
    area_.push_back(area_of(t));
    whole_area_ += area_.back();
  }
}

double PieceCost::of(const Folds& tree, std::span<const Vec2> hull) {
  double cut = 0.0;
  for (std::size_t side = 0; side < tree.size(); ++side) {
    cut += tree[side] == 0 && piece_.twin[side] != nothing ? 0.5 * piece_.length[side] : 0.0;
  }
  double hull_area = 0.0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
    hull_area += 0.5 * cross(hull[i] - hull[0], hull[i + 1] - hull[0]);
  }
  const double hollow = std::max(0.0, hull_area - whole_area_) / 100.0;
  cuts_.set_tree(tree);
  return any_tree_ + cuts_.total() + outline_cost(border_ + 2.0 * cut, weights_) + weights_.compact * hollow +
         weights_.thin * thinness(piece_, tree, rooted_tree(piece_, tree, 0, place_), area_, narrow_);
}

double cost_of_piece(const Patch& piece, const Folds& tree, std::size_t parts, const Weights& weights) {
  std::vector<Vec2> points;
  for (const Triangle& t : lay_out(piece, tree).flat) {
    points.insert(points.end(), t.begin(), t.end());
  }
  return PieceCost(piece, parts, weights).of(tree, convex_hull(std::move(points)));
}

}  // namespace ridgecraft::unfold
