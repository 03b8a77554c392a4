// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/tab_figures.hpp"

#include <algorithm>
#include <cmath>

#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::bench {
namespace {

using unfold::ConvexShape;

constexpr TabFigure figures[] = {{"models", &TabFigures::models},
                                 {"pieces_per_model", &TabFigures::pieces},
                                 {"pieces", &TabFigures::pieces_in_all},
                                 {"most_pieces_more", &TabFigures::most_more},
                                 {"cuts_per_model", &TabFigures::cuts},
                                 {"usable", &TabFigures::usable},
                                 {"any", &TabFigures::any},
                                 {"usable_of_wide_enough", &TabFigures::of_wide},
                                 {"usable_of_able", &TabFigures::of_able},
                                 {"usable_of_long", &TabFigures::usable_long},
                                 {"usable_of_bound", &TabFigures::of_bound},
                                 {"usable_of_long_bound", &TabFigures::of_long_bound},
                                 {"wide_enough_without", &TabFigures::left},
                                 {"collisions", &TabFigures::collisions}};

/// Overlaps no deeper than this are rounding, mm.
constexpr double rounding_mm = 1e-6;

ConvexShape tab_shape(const unfold::Tab& tab) {
  return ConvexShape(std::span<const Vec2>(tab.polygon));
}

std::size_t count_collisions(const unfold::Nets& nets, double allowed_mm) {
  std::size_t count = 0;
  for (const unfold::Tab& tab : nets.tabs) {
    const ConvexShape shape = tab_shape(tab);
    const PieceId piece = nets.piece[mesh::face_of(tab.side)];
    for (const FaceId f : nets.pieces[piece].faces) {
      const ConvexShape face(std::span<const Vec2>(nets.flat[f]));
      count += unfold::separation(shape, face) < -allowed_mm ? 1U : 0U;
    }
    for (const unfold::Tab& other : nets.tabs) {
      count += &other < &tab && nets.piece[mesh::face_of(other.side)] == piece &&
                       unfold::separation(shape, tab_shape(other)) < -allowed_mm
                   ? 1U
                   : 0U;
    }
  }
  return count;
}

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : 1.0;
}

bool is_sum(double TabFigures::*value) {
  return value == &TabFigures::models || value == &TabFigures::pieces_in_all || value == &TabFigures::left ||
         value == &TabFigures::collisions;
}

/// Must it be 0?
bool is_fault(double TabFigures::*value) {
  return value == &TabFigures::left || value == &TabFigures::collisions;
}

}  // namespace

std::span<const TabFigure> tab_figures() {
  return figures;
}

TabFigures figures_of(const mesh::Surface& surface, const TabBound& bound, const unfold::Nets& nets,
                      const unfold::TabOptions& options) {
  double usable = 0.0;
  double wide = 0.0;
  double able = 0.0;
  double able_usable = 0.0;
  double long_cuts = 0.0;
  double long_usable = 0.0;
  for (const unfold::Join& join : nets.joins) {
    const bool is_long = surface.length(join.edge) > long_edge_mm;
    const bool good = join.tab.valid() && unfold::is_usable(surface, nets, join.tab, options);
    usable += good ? 1.0 : 0.0;
    wide += join.too_narrow ? 0.0 : 1.0;
    const bool is_able = bound.able[join.edge] != 0;
    able += is_able ? 1.0 : 0.0;
    able_usable += is_able && good ? 1.0 : 0.0;
    long_cuts += is_long ? 1.0 : 0.0;
    long_usable += is_long && good ? 1.0 : 0.0;
  }
  TabFigures result;
  result.models = 1.0;
  result.pieces = static_cast<double>(nets.pieces.size());
  result.pieces_in_all = result.pieces;
  result.most_more = result.pieces - 1.0;
  result.cuts = static_cast<double>(nets.joins.size());
  result.usable = share(usable, result.cuts);
  result.any = share(static_cast<double>(nets.tabs.size()), result.cuts);
  result.of_wide = share(usable, wide);
  result.of_able = share(able_usable, able);
  result.usable_long = share(long_usable, long_cuts);
  result.of_bound = share(result.usable, bound.cuts);
  result.of_long_bound = share(result.usable_long, bound.long_cuts);
  result.left = wide - usable;
  result.collisions = static_cast<double>(
      count_collisions(nets, std::fmax(rounding_mm, options.inside_target ? 0.0 : 1.001 * weak_overlap_mm)));
  return result;
}

TabFigures mean_of_models(const std::vector<TabFigures>& all) {
  TabFigures result;
  for (const auto& [name, value] : figures) {
    for (const TabFigures& one : all) {
      result.*value += one.*value / (is_sum(value) ? 1.0 : static_cast<double>(all.size()));
    }
  }
  result.most_more = 0.0;
  for (const TabFigures& one : all) {
    result.most_more = std::fmax(result.most_more, one.most_more);
  }
  return result;
}

TabFigures median_of_seeds(const std::vector<TabFigures>& all) {
  TabFigures result;
  for (const auto& [name, value] : figures) {
    std::vector<double> values;
    for (const TabFigures& one : all) {
      values.push_back(one.*value);
    }
    result.*value = quantile(std::move(values), is_fault(value) ? 1.0 : 0.5);
  }
  return result;
}

double quantile(std::vector<double> values, double share_below) {
  std::sort(values.begin(), values.end());
  return values.empty()
             ? 0.0
             : values[static_cast<std::size_t>(share_below * static_cast<double>(values.size() - 1))];
}

}  // namespace ridgecraft::bench
