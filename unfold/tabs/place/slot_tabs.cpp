// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/slot_tabs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/geometry.hpp"
#include "unfold/tabs/place/sites.hpp"

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

namespace {

/// Places on the line of a slit that are looked at, mm apart: so much is lost at either end of a slit at
/// most.
constexpr double step_mm = 0.1;
/// Distance of what lies on or behind one face, mm.
constexpr double apart_mm = 0.5;

Frame frame_of(const Nets& nets, const Tab& tab) {
  return tab_frame(nets, tab.side);
}

/// A tab as it lies on or behind the face beyond its edge, in the plane of that face's piece.
ConvexShape laid_over(const mesh::Surface& surface, const Nets& nets, const Tab& tab,
                      const std::vector<Vec2>& local) {
  return glued_frame(nets, surface.twin(tab.side))
      .out(ConvexShape(std::span<const Vec2>(convex_hull(local))));
}

class SlitMaker {
 public:
  SlitMaker(const mesh::Surface& surface, const prepare::Panels& panels, Nets& nets)
      : surface_(surface), nets_(nets), regions_(flat_regions(surface, panels, nets)) {}

  std::vector<std::uint8_t> make(const std::vector<std::uint8_t>& asked, const Context& context) {
    arrows_.resize(nets_.tabs.size());
    lying_.resize(nets_.tabs.size());
    for (const TabId t : ids<TabId>(nets_.tabs.size())) {
      context.check();
      find_arrows(t, asked);
    }
    for (const TabId t : ids<TabId>(nets_.tabs.size())) {
      keep_clear(t);
    }
    return replace();
  }

 private:
  /// What a tab could become, and what it takes of the face beyond.
  void find_arrows(TabId t, const std::vector<std::uint8_t>& asked) {
    const Tab& tab = nets_.tabs[t];
    const CornerId twin = surface_.twin(tab.side);
    if (!twin.valid()) {
      return;
    }
    on_region_[regions_.region[mesh::face_of(twin)]].push_back(t);
    const Frame frame = frame_of(nets_, tab);
    const ConvexShape ground = frame.in(ConvexShape(std::span<const Vec2>(tab.polygon)));
    if (tab.join.valid() && asked[tab.join.value()] != 0) {
      arrows_[t] = arrows_within(ground, free_stretches(twin, ground.box()));
    }
    if (arrows_[t].empty()) {
      lying_[t] = {laid_over(surface_, nets_, tab, {ground.begin(), ground.end()})};
    }
    for (const Arrow& arrow : arrows_[t]) {
      lying_[t].push_back(laid_over(surface_, nets_, tab, arrow.polygon));
    }
  }

  /// Where on the line of its slits a slit keeps its distance from the borders of the flat region beyond.
  [[nodiscard]] std::vector<Span> free_stretches(CornerId twin, const Box2& box) const {
    const Frame target = glued_frame(nets_, twin);
    std::vector<std::array<Vec2, 2>> near;
    const double reach = arrow_measures.slit_from_others + step_mm;
    for (const CornerId c : regions_.outline[regions_.region[mesh::face_of(twin)]]) {
      const auto& flat = nets_.flat[mesh::face_of(c)];
      const std::array<Vec2, 2> side{target.in(flat[c.value() % 3]),
                                     target.in(flat[mesh::next(c).value() % 3])};
      const auto beyond = [&](double low, double high) {
        return (side[0].x < low && side[1].x < low) || (side[0].x > high && side[1].x > high);
      };
      if (c != twin && !beyond(box.low.x - reach, box.high.x + reach)) {
        near.push_back(side);
      }
    }
    std::vector<Span> free;
    bool open = false;
    for (double x = box.low.x; x <= box.high.x; x += step_mm) {
      const Vec2 p{x, arrow_measures.slit_from_edge};
      // Half a step more, for the places between those looked at.
      const bool clear = std::ranges::all_of(near, [&](const std::array<Vec2, 2>& side) {
        return distance_to_segment(p, side[0], side[1]) >= arrow_measures.slit_from_others + 0.5 * step_mm;
      });
      if (clear && !open) {
        free.push_back({x, x});
      }
      if (clear) {
        free.back().to = x;
      }
      open = clear;
    }
    return free;
  }

  /// Arrows that other tabs of the same face are in the way of go.
  void keep_clear(TabId t) {
    if (arrows_[t].empty()) {
      return;
    }
    const CornerId twin = surface_.twin(nets_.tabs[t].side);
    std::vector<Arrow> kept;
    std::vector<ConvexShape> lying;
    for (std::size_t i = 0; i < arrows_[t].size(); ++i) {
      const bool clear =
          std::ranges::all_of(on_region_[regions_.region[mesh::face_of(twin)]], [&](TabId other) {
            return other == t || std::ranges::all_of(lying_[other], [&](const ConvexShape& shape) {
                     return apart(lying_[t][i], shape, apart_mm);
                   });
          });
      if (clear) {
        kept.push_back(arrows_[t][i]);
        lying.push_back(lying_[t][i]);
      }
    }
    arrows_[t] = std::move(kept);
    if (arrows_[t].empty()) {
      const Tab& tab = nets_.tabs[t];
      const ConvexShape ground = frame_of(nets_, tab).in(ConvexShape(std::span<const Vec2>(tab.polygon)));
      lying = {laid_over(surface_, nets_, tab, {ground.begin(), ground.end()})};
      // It is glued now and takes more of the face: what was clear of its arrows may lie on it.
      undone_.push_back(t);
    }
    lying_[t] = std::move(lying);
  }

  std::vector<std::uint8_t> replace() {
    // Tabs that went back to glue may be in the way of arrows that were looked at before them.
    while (!undone_.empty()) {
      const CornerId twin = surface_.twin(nets_.tabs[undone_.back()].side);
      undone_.pop_back();
      for (const TabId other : on_region_[regions_.region[mesh::face_of(twin)]]) {
        keep_clear(other);
      }
    }
    std::vector<std::uint8_t> found(nets_.joins.size(), 0);
    for (const TabId t : ids<TabId>(arrows_.size())) {
      const Frame frame = frame_of(nets_, nets_.tabs[t]);
      const Frame target =
          arrows_[t].empty() ? Frame{} : glued_frame(nets_, surface_.twin(nets_.tabs[t].side));
      for (std::size_t i = 0; i < arrows_[t].size(); ++i) {
        const Arrow& arrow = arrows_[t][i];
        Tab tab{nets_.tabs[t].side, nets_.tabs[t].join, {}};
        for (const Vec2 p : arrow.polygon) {
          tab.polygon.push_back(frame.out(p));
        }
        tab.slit = {target.out(Vec2{arrow.slit.from, arrow_measures.slit_from_edge}),
                    target.out(Vec2{arrow.slit.to, arrow_measures.slit_from_edge})};
        found[tab.join.value()] = 1;
        if (i == 0) {
          nets_.tabs[t] = std::move(tab);
        } else {
          nets_.tabs.push_back(std::move(tab));
        }
      }
    }
    return found;
  }

  const mesh::Surface& surface_;
  Nets& nets_;
  FlatRegions regions_;
  IdVector<TabId, std::vector<Arrow>> arrows_;
  IdVector<TabId, std::vector<ConvexShape>> lying_;  ///< on or behind the face beyond, in its plane
  std::map<std::uint32_t, std::vector<TabId>> on_region_;
  std::vector<TabId> undone_;
};

}  // namespace

std::vector<std::uint8_t> put_into_slits(const mesh::Surface& surface, const prepare::Panels& panels,
                                         const std::vector<std::uint8_t>& asked, Nets& nets,
                                         const Context& context) {
  return SlitMaker(surface, panels, nets).make(asked, context);
}

}  // namespace ridgecraft::unfold
