// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/effort.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "prepare/prepared/effort.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::export_ {
namespace {

/// One for each limit that a value is on the wrong side of.
template <class Value, std::size_t N>
int points_above(Value value, const std::array<Value, N>& limits) {
  return static_cast<int>(
      std::count_if(limits.begin(), limits.end(), [&](Value limit) { return value >= limit; }));
}

constexpr std::array<std::size_t, 3> many_edges{60, 200, 600};
/// Shares of the edges to glue that take tweezers, or a strip of paper behind them.
constexpr std::array<double, 3> many_awkward{0.05, 0.15, 0.3};

prepare::Work work_of(const prepare::Prepared& model, const unfold::Nets& nets, double hidden_fold_angle) {
  const mesh::Surface& surface = model.model.surface;
  prepare::Work work;
  work.pieces = static_cast<double>(nets.pieces.size());
  const auto add_length = [&](EdgeId edge) {
    work.short_edges += surface.length(edge) < prepare::tweezers_mm ? 1.0 : 0.0;
  };
  for (const unfold::Join& join : nets.joins) {
    add_length(join.edge);
    const double length = surface.length(join.edge);
    work.joins += 1.0;
    work.seam_mm += length;
    // Without any tabs the maker has chosen another way to join.
    if (!nets.tabs.empty() && (!join.tab.valid() || !unfold::is_usable(surface, nets, join.tab, {}))) {
      work.weak_joins += 1.0;
      work.weak_mm += length;
    }
  }
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    if (nets.use[edge] == unfold::EdgeUse::fold && !model.rolls.bends(edge) &&
        std::abs(surface.fold_angle(edge)) >= hidden_fold_angle) {
      add_length(edge);
      work.folds += 1.0;
    }
  }
  return work;
}

}  // namespace

Effort effort_of(const prepare::Prepared& model, const unfold::Nets& nets, double hidden_fold_angle) {
  const mesh::Surface& surface = model.model.surface;
  const prepare::Work work = work_of(model, nets, hidden_fold_angle);
  Effort effort;
  effort.minutes = prepare::minutes_of(work);
  effort.seam_mm = work.seam_mm;
  effort.joins = static_cast<std::size_t>(work.joins);
  effort.folds = static_cast<std::size_t>(work.folds);
  std::vector<double> lengths;
  for (const unfold::Join& join : nets.joins) {
    lengths.push_back(surface.length(join.edge));
    if (join.tab.valid() && (effort.smallest_tab_mm == 0.0 || lengths.back() < effort.smallest_tab_mm)) {
      effort.smallest_tab_mm = lengths.back();
    }
  }
  if (!lengths.empty()) {
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    effort.median_join_mm = *middle;
  }
  int points = points_above(effort.joins + effort.folds, many_edges);
  if (effort.joins > 0) {
    // Without any tabs the maker has chosen another way to join.
    const bool has_tabs = !nets.tabs.empty();
    const auto count = std::count_if(nets.joins.begin(), nets.joins.end(), [&](const unfold::Join& join) {
      return surface.length(join.edge) < prepare::tweezers_mm || (has_tabs && !join.tab.valid());
    });
    points += points_above(static_cast<double>(count) / static_cast<double>(effort.joins), many_awkward);
  }
  constexpr std::array<int, 7> difficulty{1, 2, 2, 3, 4, 4, 5};
  effort.difficulty = difficulty[static_cast<std::size_t>(points)];
  return effort;
}

std::string duration_words(double minutes) {
  if (minutes < 55.0) {
    return fmt::format("about {:.0f} minutes", 10.0 * std::max(1.0, std::round(minutes / 10.0)));
  }
  const double hours = minutes / 60.0;
  const double rounded = hours < 5.75 ? 0.5 * std::round(2.0 * hours) : std::round(hours);
  return fmt::format("about {:g} {}", rounded, rounded == 1.0 ? "hour" : "hours");
}

std::string difficulty_words(int difficulty) {
  constexpr std::array<std::string_view, 5> words{"very easy", "easy", "moderate", "hard", "very hard"};
  return std::string(words[static_cast<std::size_t>(difficulty - 1)]);
}

std::string paper_weight(double extent_mm, double median_join_mm) {
  constexpr std::array<std::string_view, 5> weights{"100 to 120", "120 to 160", "160 to 200", "200 to 250",
                                                    "250 to 300"};
  constexpr std::array<double, 3> extents_mm{150.0, 300.0, 600.0};
  constexpr double fine_join_mm = 8.0;  // thick paper doesn't fold there
  const int size = 1 + points_above(extent_mm, extents_mm);
  const int finer = median_join_mm > 0.0 && median_join_mm < fine_join_mm ? 1 : 0;
  return std::string(weights[static_cast<std::size_t>(size - finer)]) + " g/m\u00b2";
}

}  // namespace ridgecraft::export_
