// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/pages/scale_bar.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "verify/pages/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

constexpr double tick_step_mm = 10.0;
/// Half the height of a tick, mm.
constexpr double shortest_tick_mm = 0.5;
constexpr double longest_tick_mm = 2.0;
/// A tick this near to the end of a line belongs to that end, even where it isn't exactly there, mm.
constexpr double at_end_mm = 2.0;
/// Marks that are more than this many are no marks of ours.
constexpr std::size_t most_marks = 10'000;

/// Along x: from `low` to `high`; or a place on x.
struct Bar {
  double low = 0.0, high = 0.0, y = 0.0;
  std::vector<double> ticks;  ///< ascending

  [[nodiscard]] double length() const { return high - low; }
};

struct Marks {
  std::vector<Bar> level;  ///< long enough for a bar, without their ticks
  std::vector<Vec2> tick;  ///< middles
};

Marks marks_of(const PrintedPage& page) {
  Marks marks;
  for (const PrintedLine& line : page.lines) {
    if (line.layer != PrintedLayer::mark || line.pattern != Pattern::solid || line.points.size() != 2) {
      continue;
    }
    const Vec2 a = line.points[0];
    const Vec2 b = line.points[1];
    const Vec2 half = 0.5 * Vec2{std::abs(b.x - a.x), std::abs(b.y - a.y)};
    const Vec2 middle = 0.5 * (a + b);
    if (half.y <= measure_tolerance_mm && 2.0 * half.x > 0.5 * tick_step_mm) {
      marks.level.push_back({middle.x - half.x, middle.x + half.x, middle.y, {}});
    } else if (half.x <= measure_tolerance_mm && half.y >= shortest_tick_mm && half.y <= longest_tick_mm) {
      marks.tick.push_back(middle);
    }
    if (marks.level.size() + marks.tick.size() > most_marks) {
      return {};
    }
  }
  return marks;
}

std::vector<Bar> find_bars(const PrintedPage& page) {
  Marks marks = marks_of(page);
  std::vector<Bar> bars;
  for (Bar& bar : marks.level) {
    for (const Vec2 tick : marks.tick) {
      if (std::abs(tick.y - bar.y) <= shortest_tick_mm && tick.x >= bar.low - at_end_mm &&
          tick.x <= bar.high + at_end_mm) {
        bar.ticks.push_back(tick.x);
      }
    }
    std::sort(bar.ticks.begin(), bar.ticks.end());
    if (bar.ticks.size() >= 2 && bar.ticks.front() <= bar.low + at_end_mm &&
        bar.ticks.back() >= bar.high - at_end_mm) {
      bars.push_back(std::move(bar));
    }
  }
  return bars;
}

/// The bars that a page may have, longest first.
std::vector<double> possible_lengths(double room_mm) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < std::size(bar_lengths_mm); ++i) {
    lengths.push_back(bar_lengths_mm[i]);
    if (i < std::size(bar_room_mm) && room_mm >= bar_room_mm[i]) {
      break;
    }
  }
  return lengths;
}

}  // namespace

std::optional<std::string> fault_of_bar(const PrintedPage& page, double room_mm) {
  const std::vector<Bar> bars = find_bars(page);
  if (bars.empty()) {
    return "has no scale bar";
  }
  if (bars.size() > 1) {
    return fmt::format("has {} scale bars", bars.size());
  }
  const Bar& bar = bars.front();
  const std::vector<double> lengths = possible_lengths(room_mm);
  const double wanted = *std::min_element(lengths.begin(), lengths.end(), [&](double a, double b) {
    return std::abs(a - bar.length()) < std::abs(b - bar.length());
  });
  if (std::abs(bar.length() - wanted) > measure_tolerance_mm) {
    return fmt::format("has a scale bar of {:.2f} mm instead of {:g} mm", bar.length(), wanted);
  }
  const auto count = static_cast<std::size_t>(std::round(wanted / tick_step_mm)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = bar.low + tick_step_mm * static_cast<double>(i);
    if (bar.ticks.size() != count || std::abs(bar.ticks[i] - place) > measure_tolerance_mm) {
      return "has a scale bar whose ticks aren't 10 mm apart";
    }
  }
  return std::nullopt;
}

}  // namespace ridgecraft::verify
