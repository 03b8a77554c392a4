// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/shape/arrows.hpp"

#include <algorithm>
#include <cmath>

namespace ridgecraft::unfold {
namespace {

constexpr const ArrowMeasures& m = arrow_measures;

Arrow arrow_at(double centre, double neck) {
  const double left = centre - 0.5 * neck;
  const double right = centre + 0.5 * neck;
  const double shoulder = m.slit_from_edge + m.neck_play;
  return {{{left, 0.0},
           {right, 0.0},
           {right, shoulder},
           {right + m.barb, shoulder},
           {right - m.tip_inset, m.height()},
           {left + m.tip_inset, m.height()},
           {left - m.barb, shoulder},
           {left, shoulder}},
          {left - 0.5 * m.slit_play, right + 0.5 * m.slit_play}};
}

double right_barb(const Arrow& arrow) {
  return arrow.polygon[3].x;
}
double left_barb(const Arrow& arrow) {
  return arrow.polygon[6].x;
}

/// Between which x a neck may stand, as far as the ground is concerned.
Span neck_room(const ConvexShape& ground) {
  const Span root = span_at(ground, 0.0);
  const Span barbs = span_at(ground, m.slit_from_edge + m.neck_play);
  // The last bit of a tab that is exactly as high as asked may be missing by rounding.
  const Span tip = span_at(ground, m.height() - touching_mm);
  return {std::max({root.from + m.root_from_end, barbs.from + m.barb, tip.from - m.tip_inset}),
          std::min({root.to - m.root_from_end, barbs.to - m.barb, tip.to + m.tip_inset})};
}

}  // namespace

std::vector<Arrow> arrows_within(const ConvexShape& ground, const std::vector<Span>& free) {
  if (ground.box().high.y < m.height() - touching_mm) {
    return {};
  }
  const Span room = neck_room(ground);
  std::vector<Arrow> arrows;
  for (const Span& stretch : free) {
    const double from = std::max(room.from, stretch.from + 0.5 * m.slit_play);
    const double to = std::min(room.to, stretch.to - 0.5 * m.slit_play);
    if (!(to - from >= m.narrowest_neck)) {
      continue;
    }
    const double count = std::max(1.0, std::ceil((to - from) / m.pitch));
    const double cell = (to - from) / count;
    const double neck = std::min(m.widest_neck, count > 1.0 ? cell - 2.0 * m.barb - m.between : cell);
    for (double i = 0.0; i < count; ++i) {
      const Arrow arrow = arrow_at(from + (i + 0.5) * cell, neck);
      if (arrows.empty() || left_barb(arrow) - right_barb(arrows.back()) > m.between - touching_mm) {
        arrows.push_back(arrow);
      }
    }
  }
  return arrows;
}

}  // namespace ridgecraft::unfold
