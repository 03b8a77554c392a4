// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/more_tabs.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "base/geometry.hpp"
#include "unfold/tabs/place/assignment.hpp"
#include "unfold/tabs/place/even_tabs.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/place/standing_tabs.hpp"

namespace ridgecraft::unfold {
namespace {

class MoreTabs {
 public:
  MoreTabs(const mesh::Surface& surface, const prepare::Panels& panels, const TabOptions& options,
           std::span<const TabWish> wishes, Nets& nets, const Context& context)
      : surface_(surface), nets_(nets), options_(options), wishes_(wishes), standing_(nets, options) {
    // What is glued to another tab may be larger than the face behind it.
    options_.inside_target = false;
    sites_ = find_tab_sites(surface, panels, nets, with_greatest_height(options_, wishes), context);
    for (const Tab& tab : nets.tabs) {
      const std::size_t even = std::size_t{2} * tab.join.value();
      const TabSite& site = sites_[tab.side == sites_[even].side ? even : even + 1];
      standing_.add_standing(site, tab);
    }
  }

  void add_seconds() {
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      const Join& join = nets_.joins[j];
      if (!wishes_[j.value()].second || !join.tab.valid() || nets_.tabs[join.tab].slit) {
        continue;
      }
      const std::size_t even = std::size_t{2} * j.value();
      const std::size_t first = even + (nets_.tabs[join.tab].side == sites_[even].side ? 0 : 1);
      const TabSite& own = sites_[first];
      const TabSite& other = sites_[first ^ 1U];
      const ConvexShape shape = own.own.in(ConvexShape(std::span<const Vec2>(nets_.tabs[join.tab].polygon)));
      Tab tab;
      tab.join = j;
      standing_.place(other, turned_over(shape, other.length), wishes_[j.value()].options, tab);
    }
  }

  void add_borders(const TabChoice& choice, const Context& context) {
    const TabOptions highest = with_greatest_height(options_, choice);
    std::set<CornerId> feet;  // get tabs of their own
    if (options_.at_feet) {
      for (const FootSide& foot : find_feet(surface_, context)) {
        feet.insert(foot.side);
      }
    }
    for (const TabSite& site : find_border_sites(surface_, nets_, highest, context)) {
      if (feet.contains(site.side)) {
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
  std::span<const TabWish> wishes_;  // of each join
  std::vector<TabSite> sites_;
  StandingTabs standing_;
};

}  // namespace

void add_more_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                   std::span<const TabWish> wishes, const TabChoice& choice, Nets& nets,
                   const Context& context) {
  if (!choice.borders && std::ranges::none_of(wishes, &TabWish::second)) {
    return;
  }
  const std::size_t first = nets.tabs.size();
  MoreTabs more(surface, panels, options.tabs, wishes, nets, context);
  more.add_seconds();
  if (choice.borders) {
    more.add_borders(choice, context);
  }
  if (options.sheet && nets.tabs.size() > first) {
    drop_beyond(*options.sheet, first, nets);
  }
}

}  // namespace ridgecraft::unfold
