// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/effort.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace ridgecraft::export_ {
namespace {

// Each join has two edges to be cut.
constexpr double cut_mm_per_minute = 100.0;
constexpr double glue_mm_per_minute = 60.0;
constexpr double minutes_per_fold = 0.2;
constexpr double minutes_per_join = 0.4;  ///< to find its other edge, and to hold it until the glue does
constexpr double minutes_per_piece = 1.0;

/// One for each limit that a value is on the wrong side of.
template <class Value, std::size_t N>
int points_above(Value value, const std::array<Value, N>& limits) {
  return static_cast<int>(
      std::count_if(limits.begin(), limits.end(), [&](Value limit) { return value >= limit; }));
}

constexpr std::array<std::size_t, 3> many_edges{60, 200, 600};
/// Shares of the edges to glue that take tweezers, or a strip of paper behind them.
constexpr std::array<double, 3> many_awkward{0.05, 0.15, 0.3};
constexpr double short_join_mm = 6.0;

}  // namespace

Effort effort_of(const mesh::Surface& surface, const unfold::Nets& nets, double hidden_fold_angle) {
  Effort effort;
  std::vector<double> lengths;
  for (const unfold::Join& join : nets.joins) {
    lengths.push_back(surface.length(join.edge));
    effort.seam_mm += lengths.back();
    if (join.tab.valid() && (effort.smallest_tab_mm == 0.0 || lengths.back() < effort.smallest_tab_mm)) {
      effort.smallest_tab_mm = lengths.back();
    }
  }
  effort.joins = lengths.size();
  if (!lengths.empty()) {
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    effort.median_join_mm = *middle;
  }
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    if (nets.use[edge] == unfold::EdgeUse::fold && std::abs(surface.fold_angle(edge)) >= hidden_fold_angle) {
      ++effort.folds;
    }
  }
  effort.minutes = 2.0 * effort.seam_mm / cut_mm_per_minute + effort.seam_mm / glue_mm_per_minute +
                   minutes_per_fold * static_cast<double>(effort.folds) +
                   minutes_per_join * static_cast<double>(effort.joins) +
                   minutes_per_piece * static_cast<double>(nets.pieces.size());
  int points = points_above(effort.joins + effort.folds, many_edges);
  if (effort.joins > 0) {
    // Without any tabs the maker has chosen another way to join.
    const bool has_tabs = !nets.tabs.empty();
    const auto count = std::count_if(nets.joins.begin(), nets.joins.end(), [&](const unfold::Join& join) {
      return surface.length(join.edge) < short_join_mm || (has_tabs && !join.tab.valid());
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
