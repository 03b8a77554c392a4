// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/missing_tabs.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "base/boxes.hpp"
#include "base/geometry.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {
namespace {

/// Gaps looked at between two questions whether to go on: about 1 ms.
constexpr std::size_t gaps_per_check = 64;

/// The folds that nothing cuts.
Folds frozen_folds(const Patch& patch, const Folds& folds) {
  Folds result = folds;
  for (std::size_t side = 0; side < folds.size(); ++side) {
    result[side] = folds[side] != 0 && patch.frozen[side] != 0 ? 1 : 0;
  }
  return result;
}

/// Nets of as many pieces as there can be.
Nets all_apart(const mesh::Surface& surface, const Patch& patch, const Folds& folds) {
  const Folds frozen = frozen_folds(patch, folds);
  const Layout layout = lay_out(patch, frozen);
  Nets nets;
  nets.use = IdVector<EdgeId, EdgeUse>(surface.edge_count(), EdgeUse::cut);
  nets.piece = IdVector<FaceId, PieceId>(surface.face_count());
  nets.flat = IdVector<FaceId, std::array<Vec2, 3>>(surface.face_count());
  for (const auto& faces : layout.faces) {
    Piece piece;
    for (const std::uint32_t f : faces) {
      piece.faces.emplace_back(f);
      nets.piece[FaceId(f)] = PieceId(nets.pieces.size());
      nets.flat[FaceId(f)] = layout.flat[f];
    }
    nets.pieces.push_back(std::move(piece));
  }
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e)) {
      nets.use[e] = EdgeUse::border;
    } else if (const std::uint32_t side = surface.sides(e)[0].value();
               frozen[side] != 0 || is_slit(patch, frozen, layout, side)) {
      nets.use[e] = EdgeUse::fold;
    } else {
      nets.joins.push_back({e, 0, TabId(), NoTab::not_wanted, false});
    }
  }
  return nets;
}

}  // namespace

/// What stands around a side of a join.
class TabGaps::Surroundings {
 public:
  Surroundings(const mesh::Surface& surface, const Nets& nets, const TabOptions& options)
      : nets_(nets), options_(options), vertices_(net_vertices(surface, nets)), tabs_(nets.pieces.size()) {
    for (const TabId t : ids<TabId>(nets.tabs.size())) {
      tabs_[nets.piece[mesh::face_of(nets.tabs[t].side)]].push_back(t);
    }
    for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
      std::vector<Box2> faces;
      for (const FaceId f : nets.pieces[p].faces) {
        faces.push_back(ConvexShape(std::span<const Vec2>(nets.flat[f])).box());
      }
      face_boxes_.push_back(BoxGrid(std::move(faces)));
      std::vector<Box2> tabs;
      for (const TabId t : tabs_[p]) {
        tabs.push_back(ConvexShape(std::span<const Vec2>(nets.tabs[t].polygon)).box());
      }
      tab_boxes_.push_back(BoxGrid(std::move(tabs)));
    }
  }

  [[nodiscard]] TabGap::Place place(CornerId side, JoinId join, const TabCandidate& tab) const {
    TabGap::Place result{mesh::face_of(side), {}};
    const PieceId piece = nets_.piece[result.face];
    const Frame own = tab_frame(nets_, side);
    const ConvexShape shape(std::span<const Vec2>(tab.whole.corner));
    const Box2 box = grown(own.out(shape).box(), options_.clearance_mm);
    const auto meets_shape = [&](const ConvexShape& other, bool left, bool right) {
      return !clear_of(shape, {own.in(other), kind_sharing(left && tab.at_left, right && tab.at_right)},
                       options_.clearance_mm);
    };
    const std::uint32_t left = vertices_[mesh::next(side).value()];
    const std::uint32_t right = vertices_[side.value()];
    face_boxes_[piece].visit(box, [&](std::uint32_t i) {
      const FaceId f = nets_.pieces[piece].faces[i];
      bool at_left = false;
      bool at_right = false;
      for (unsigned k = 0; k < 3; ++k) {
        at_left = at_left || vertices_[mesh::corner(f, k).value()] == left;
        at_right = at_right || vertices_[mesh::corner(f, k).value()] == right;
      }
      if (f != result.face &&
          meets_shape(ConvexShape(std::span<const Vec2>(nets_.flat[f])), at_left, at_right)) {
        result.in_the_way.push_back(f);
      }
    });
    tab_boxes_[piece].visit(box, [&](std::uint32_t i) {
      const Tab& other = nets_.tabs[tabs_[piece][i]];
      const auto at = [&](std::uint32_t vertex) {
        return vertices_[other.side.value()] == vertex || vertices_[mesh::next(other.side).value()] == vertex;
      };
      if (other.join != join &&
          meets_shape(ConvexShape(std::span<const Vec2>(other.polygon)), at(left), at(right))) {
        result.in_the_way.push_back(mesh::face_of(other.side));
      }
    });
    std::sort(result.in_the_way.begin(), result.in_the_way.end());
    result.in_the_way.erase(std::unique(result.in_the_way.begin(), result.in_the_way.end()),
                            result.in_the_way.end());
    return result;
  }

 private:
  const Nets& nets_;
  const TabOptions& options_;
  std::vector<std::uint32_t> vertices_;
  IdVector<PieceId, std::vector<TabId>> tabs_;
  IdVector<PieceId, BoxGrid> face_boxes_;  ///< in the order of the piece's faces ...
  IdVector<PieceId, BoxGrid> tab_boxes_;   ///< ... and of tabs_
};

TabGaps::TabGaps(const TabProblem& problem, const Patch& patch, const Folds& folds, const Context& context)
    : surface_(problem.surface),
      options_(problem.options),
      able_(surface_.edge_count(), 0),
      candidates_(surface_.corner_count()) {
  Nets apart = all_apart(surface_, patch, folds);
  place_tabs(problem, apart, context);
  for (const Join& join : apart.joins) {
    able_[join.edge] = join.tab.valid() && is_usable(surface_, apart, join.tab, options_) ? 1 : 0;
  }
  for (const TabSite& site : find_tab_sites(surface_, problem.panels, apart, options_, context)) {
    candidates_[site.side.value()] = tab_candidates(
        largest_tab({0.0, site.length, site.length}, target_outline(site), options_, TabNeed::usable),
        site.length, options_);
  }
}

std::vector<JoinId> TabGaps::missing(const Nets& nets) const {
  std::vector<JoinId> result;
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    const Join& join = nets.joins[j];
    if (able(join.edge) && !(join.tab.valid() && is_usable(surface_, nets, join.tab, options_))) {
      result.push_back(j);
    }
  }
  return result;
}

std::vector<TabGap> TabGaps::gaps(const Nets& nets, std::span<const JoinId> joins,
                                  const Context& context) const {
  const Surroundings surroundings(surface_, nets, options_);
  std::vector<TabGap> result;
  for (const JoinId join : joins) {
    if (result.size() % gaps_per_check == 0) {
      context.check();
    }
    TabGap& gap = result.emplace_back(TabGap{join, {}});
    for (const CornerId side : surface_.sides(nets.joins[join].edge)) {
      for (const TabCandidate& tab : candidates_[side.value()]) {
        gap.places.push_back(surroundings.place(side, join, tab));
      }
    }
  }
  return result;
}

namespace {

/// The mirror image of a tab on an edge of this length.
ConvexShape turned_over(const ConvexShape& shape, double length) {
  ConvexShape result;
  for (std::uint32_t i = 0; i < shape.size(); ++i) {
    // The corners stay counterclockwise, and the first two on the base.
    const Vec2 p = shape[(shape.size() + 1 - i) % shape.size()];
    result.push_back({length - p.x, p.y});
  }
  return result;
}

class MoreTabs {
 public:
  MoreTabs(const TabProblem& problem, Nets& nets, const Context& context)
      : surface_(problem.surface),
        nets_(nets),
        options_(problem.options),
        requests_(problem.requests),
        standing_(nets, problem.options) {
    // What is glued to another tab may be larger than the face behind it.
    options_.inside_target = false;
    sites_ =
        find_tab_sites(surface_, problem.panels, nets, with_greatest_height(options_, requests_), context);
    for (const Tab& tab : nets.tabs) {
      const std::size_t even = std::size_t{2} * tab.join.value();
      const TabSite& site = sites_[tab.side == sites_[even].side ? even : even + 1];
      standing_.add_standing(site, tab);
    }
  }

  void add_seconds() {
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      const Join& join = nets_.joins[j];
      if (!requests_[j.value()].second || !join.tab.valid() || nets_.tabs[join.tab].slit) {
        continue;
      }
      const std::size_t even = std::size_t{2} * j.value();
      const std::size_t first = even + (nets_.tabs[join.tab].side == sites_[even].side ? 0 : 1);
      const TabSite& own = sites_[first];
      const TabSite& other = sites_[first ^ 1U];
      const ConvexShape shape = own.own.in(ConvexShape(std::span<const Vec2>(nets_.tabs[join.tab].polygon)));
      Tab tab;
      tab.join = j;
      standing_.place(other, turned_over(shape, other.length), requests_[j.value()].options, tab);
    }
  }

  void add_borders(const TabChoice& choice, const Context& context) {
    const TabOptions highest = with_greatest_height(options_, choice);
    std::set<CornerId> bases;  // get tabs of their own
    if (options_.at_open_bases) {
      for (const BaseSide& base : find_open_bases(surface_, context)) {
        bases.insert(base.side);
      }
    }
    for (const TabSite& site : find_border_sites(surface_, nets_, highest, context)) {
      if (bases.contains(site.side)) {
        continue;
      }
      const TabOptions own = options_for(options_, choice, surface_.length(surface_.edge(site.side)));
      standing_.place(site,
                      largest_tab({0.0, site.length, site.length}, site.obstacles, own, TabNeed::usable), own,
                      Tab());
    }
  }

 private:
  const mesh::Surface& surface_;
  Nets& nets_;
  TabOptions options_;
  std::span<const TabRequest> requests_;  // of each join
  std::vector<TabSite> sites_;
  StandingTabs standing_;
};

}  // namespace

void add_more_tabs(const TabProblem& problem, const std::optional<Sheet>& sheet, const TabChoice& choice,
                   Nets& nets, const Context& context) {
  if (!choice.borders && std::ranges::none_of(problem.requests, &TabRequest::second)) {
    return;
  }
  const std::size_t first = nets.tabs.size();
  MoreTabs more(problem, nets, context);
  more.add_seconds();
  if (choice.borders) {
    more.add_borders(choice, context);
  }
  if (sheet && nets.tabs.size() > first) {
    drop_beyond(*sheet, first, nets);
  }
}

}  // namespace ridgecraft::unfold
