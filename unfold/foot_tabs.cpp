// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/foot_tabs.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "unfold/tabs/place/feet.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/place/standing_tabs.hpp"

namespace ridgecraft::unfold {

void add_foot_tabs(const mesh::Surface& surface, const Options& options, Nets& nets, const Context& context) {
  if (!options.tabs.wanted) {
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
  for (const TabSite& site : find_foot_sites(surface, nets, feet, options.tabs, context)) {
    Tab tab;
    tab.of_foot = true;
    tabs.place(site,
               largest_tab({0.0, site.length, site.length}, site.obstacles, options.tabs, TabNeed::usable),
               options.tabs, tab);
  }
  if (options.sheet && nets.tabs.size() > first) {
    drop_beyond(*options.sheet, first, nets);
  }
}

}  // namespace ridgecraft::unfold
