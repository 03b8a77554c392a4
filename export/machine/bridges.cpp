// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/bridges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/geometry.hpp"
#include "export/machine/scores.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double from_corners_mm = 3.0;
/// Places on one side, mm from each other.
constexpr double bridge_step_mm = 8.0;

/// Where a bridge can be: its middle, as a distance along the outline.
struct Place {
  double at = 0.0;
  bool favoured = false;
};

/// Whether both ends of a side are within the distance of one side of an area, but for the area's first one:
/// there it hangs on the rest.
bool on_area(Vec2 a, Vec2 b, const std::vector<std::vector<Vec2>>& areas, double within_mm) {
  return std::ranges::any_of(areas, [&](const std::vector<Vec2>& area) {
    for (std::size_t i = 1; i < area.size(); ++i) {
      const Vec2 c = area[i];
      const Vec2 d = area[(i + 1) % area.size()];
      if (distance_to_segment(a, c, d) < within_mm && distance_to_segment(b, c, d) < within_mm) {
        return true;
      }
    }
    return false;
  });
}

std::vector<Place> places_on(const std::vector<Vec2>& outline, const std::vector<std::vector<Vec2>>& areas,
                             double within_mm, double width) {
  std::vector<Place> places;
  double passed = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    const double side = length(b - a);
    const double room = side - width - 2.0 * from_corners_mm;
    if (room >= 0.0) {
      const double count = std::floor(room / bridge_step_mm) + 1.0;
      const bool favoured = on_area(a, b, areas, within_mm);
      for (double k = 0.0; k < count; k += 1.0) {
        const double share = count > 1.0 ? k / (count - 1.0) : 0.5;
        places.push_back({passed + 0.5 * (side - room) + share * room, favoured});
      }
    }
    passed += side;
  }
  return places;
}

}  // namespace

std::vector<std::vector<Vec2>> with_bridges(const std::vector<Vec2>& outline,
                                            const std::vector<std::vector<Vec2>>& areas, double within_mm,
                                            const BridgeRules& rules) {
  std::vector<Place> places = places_on(outline, areas, within_mm, rules.width_mm);
  if (rules.count <= 0 || places.empty()) {
    return {};
  }
  std::vector<Vec2> round = outline;
  round.push_back(outline.front());
  const double whole = length_of(round);
  const double share = whole / rules.count;
  // Each bridge where it is nearest to its even place; a favoured place may be half a share farther off.
  std::vector<double> bridges;
  for (int i = 0; i < rules.count && !places.empty(); ++i) {
    const double wanted = (i + 0.5) * share;
    const auto cost = [&](const Place& place) {
      const double off = std::abs(place.at - wanted);
      return std::min(off, whole - off) + (place.favoured ? 0.0 : 0.5 * share);
    };
    const auto best = std::ranges::min_element(places, {}, cost);
    bridges.push_back(best->at);
    places.erase(best);
  }
  std::ranges::sort(bridges);
  // The outline twice, so that the last line goes on over its beginning.
  std::vector<Vec2> twice = round;
  twice.insert(twice.end(), outline.begin() + 1, outline.end());
  twice.push_back(outline.front());
  std::vector<std::vector<Vec2>> lines;
  for (std::size_t i = 0; i < bridges.size(); ++i) {
    const double from = bridges[i] + 0.5 * rules.width_mm;
    const double next = i + 1 < bridges.size() ? bridges[i + 1] : bridges[0] + whole;
    lines.push_back(stretch_of(twice, from, next - 0.5 * rules.width_mm));
  }
  return lines;
}

}  // namespace ridgecraft::export_
