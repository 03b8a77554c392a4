// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/scores.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/geometry.hpp"

namespace ridgecraft::export_ {
namespace {

/// How far a dash may be stretched, and a bridge shortened, so that the pattern fits.
constexpr double longest_dash = 1.25;
constexpr double shortest_bridge = 0.8;

constexpr ScorePattern dashes_of_card{2.0, 1.0};
constexpr ScorePattern dashes_of_board{5.0, 2.0};
constexpr ScorePattern perforation{3.0, 0.8};

}  // namespace

ScorePattern pattern_of(Scores scores, bool board) {
  return scores == Scores::perforate ? perforation : board ? dashes_of_board : dashes_of_card;
}

std::vector<Vec2> stretch_of(const std::vector<Vec2>& line, double from, double to) {
  std::vector<Vec2> result;
  double passed = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double side = length(line[i] - line[i - 1]);
    const auto at = [&](double place) {
      return line[i - 1] + ((place - passed) / side) * (line[i] - line[i - 1]);
    };
    if (side > 0.0 && passed < to && passed + side > from) {
      if (result.empty()) {
        result.push_back(at(std::max(from, passed)));
      }
      result.push_back(at(std::min(to, passed + side)));
    }
    passed += side;
  }
  return result;
}

std::vector<std::vector<Vec2>> dashes_along(const std::vector<Vec2>& line, const ScorePattern& pattern) {
  const double whole = length_of(line);
  const auto [cut, bridge] = pattern;
  if (whole < 3.0 * bridge) {
    return {};
  }
  if (whole < 2.0 * bridge + cut) {
    return {stretch_of(line, bridge, whole - bridge)};
  }
  const double count = std::max(1.0, std::round((whole - bridge) / (cut + bridge)));
  double dash = cut * whole / (count * cut + (count + 1.0) * bridge);
  dash = std::min(dash, longest_dash * cut);
  double between = (whole - count * dash) / (count + 1.0);
  if (between < shortest_bridge * bridge) {
    between = shortest_bridge * bridge;
    dash = (whole - (count + 1.0) * between) / count;
  }
  std::vector<std::vector<Vec2>> dashes;
  for (double i = 0.0; i < count; i += 1.0) {
    const double from = between + i * (dash + between);
    dashes.push_back(stretch_of(line, from, from + dash));
  }
  return dashes;
}

}  // namespace ridgecraft::export_
