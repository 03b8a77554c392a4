// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/foot_tabs.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "unfold/tabs/place/feet.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/place/standing_tabs.hpp"
#include "unfold/tabs/place/tab_wishes.hpp"

namespace ridgecraft::unfold {

void add_foot_tabs(const mesh::Surface& surface, const Options& options, const TabChoice& choice, Nets& nets,
                   const Context& context) {
  if (!options.tabs.wanted || !options.tabs.at_feet) {
    return;
  }
  std::vector<FootSide> feet = find_feet(surface, context);
  std::set<CornerId> with_tab;
  for (const Tab& tab : nets.tabs) {
    with_tab.insert(tab.side);
  }
  std::erase_if(feet, [&](const FootSide& foot) { return with_tab.contains(foot.side); });
  if (feet.empty()) {
    return;
  }
  const std::size_t first = nets.tabs.size();
  StandingTabs tabs(nets, options.tabs);
  const std::vector<CornerId> sides(with_tab.begin(), with_tab.end());
  const std::vector<TabSite> standing = bare_sites(surface, nets, sides);
  for (const Tab& tab : nets.tabs) {
    const auto at = std::lower_bound(sides.begin(), sides.end(), tab.side) - sides.begin();
    tabs.add_standing(standing[static_cast<std::size_t>(at)], tab);
  }
  const TabOptions highest = with_greatest_height(options.tabs, choice);
  for (const TabSite& site : find_foot_sites(surface, nets, feet, highest, context)) {
    const TabOptions own = options_for(options.tabs, choice, site.length);
    Tab tab;
    tab.of_foot = true;
    tabs.place(site, largest_tab({0.0, site.length, site.length}, site.obstacles, own, TabNeed::usable), own,
               tab);
  }
  if (options.sheet && nets.tabs.size() > first) {
    drop_beyond(*options.sheet, first, nets);
  }
}

}  // namespace ridgecraft::unfold
