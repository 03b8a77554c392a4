// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/more_tabs.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {
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
