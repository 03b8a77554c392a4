// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/summary_tabs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "cli/telling/sentence.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::cli {
namespace {

/// "3 too short, 1 no room": why joins have no tab.
std::string without_tab_text(const unfold::Nets& nets) {
  std::map<unfold::NoTab, std::size_t> reasons;
  for (const unfold::Join& join : nets.joins) {
    if (!join.tab.valid()) {
      ++reasons[join.no_tab];
    }
  }
  std::string text;
  for (const auto& [reason, count] : reasons) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", count, unfold::sentence(reason));
  }
  return text;
}

double height_of(const unfold::Tab& tab) {
  const Vec2 base = tab.polygon[1] - tab.polygon[0];
  double highest = 0.0;
  for (const Vec2 p : tab.polygon) {
    highest = std::max(highest, std::abs(cross(base, p - tab.polygon[0])) / length(base));
  }
  return highest;
}

/// Where another height than the default was asked for: how many tabs are lower.
std::string lower_tabs_text(const unfold::Nets& nets, double asked_mm) {
  if (asked_mm == unfold::TabOptions().height_mm) {
    return {};
  }
  std::size_t lower = 0;
  double lowest = asked_mm;
  for (const unfold::Tab& tab : nets.tabs) {
    const double height = height_of(tab);
    lower += height < 0.99 * asked_mm ? 1U : 0U;
    lowest = std::min(lowest, height);
  }
  return lower == 0 ? ""
                    : fmt::format(
                          "; {} lower than {:g} mm, down to {:.1f} mm, as their edges and the faces "
                          "behind them allow",
                          lower == nets.tabs.size() ? "all" : std::to_string(lower), asked_mm, lowest);
}

}  // namespace

std::size_t joins_without_tab(const unfold::Nets& nets) {
  return static_cast<std::size_t>(std::count_if(nets.joins.begin(), nets.joins.end(),
                                                [](const auto& join) { return !join.tab.valid(); }));
}

std::size_t joins_too_narrow(const unfold::Nets& nets) {
  return static_cast<std::size_t>(
      std::count_if(nets.joins.begin(), nets.joins.end(), [](const auto& join) { return join.too_narrow; }));
}

std::string tabs_text(const mesh::Surface& surface, const unfold::Nets& nets,
                      const unfold::TabOptions& options) {
  const std::size_t without = joins_without_tab(nets);
  const std::size_t usable = unfold::tabs_usable(surface, nets, options);
  return fmt::format("  tabs        {} for {}{}{}{}\n", nets.tabs.size(), counted(nets.joins.size(), "join"),
                     usable < nets.tabs.size()
                         ? fmt::format(", {} of them usable (the others are smaller than holds well)", usable)
                         : "",
                     lower_tabs_text(nets, options.height_mm),
                     without > 0 ? fmt::format("; {} without ({})", without, without_tab_text(nets)) : "");
}

}  // namespace ridgecraft::cli
