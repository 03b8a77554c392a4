// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs_of_nets.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "unfold/copies.hpp"
#include "unfold/net/chains.hpp"
#include "unfold/net/equal_pieces.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/plan.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/more_tabs.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/place/slot_tabs.hpp"
#include "unfold/tabs/place/tab_requests.hpp"

namespace ridgecraft::unfold {
namespace {

void give_tabs_once(const TabTask& task, std::span<const TabRequest> requests, Nets& nets,
                    const Context& context) {
  const TabProblem problem{task.surface, task.panels, task.options.tabs, requests};
  place_tabs(problem, nets, context);
  if (task.options.sheet) {
    fit_tabs_to_sheet(problem, *task.options.sheet, nets, context);
  }
}

/// Arrows where there is room for their slits, then tabs once more: as they always are where there is none.
void give_slots(const TabTask& task, std::vector<TabRequest>& requests, Nets& nets, const Context& context) {
  std::vector<std::uint8_t> slots;
  for (const TabRequest& request : requests) {
    slots.push_back(request.slot ? 1 : 0);
  }
  slots = put_into_slits(task.surface, task.panels, slots, nets, context);
  TabChoice glued = task.choice;
  glued.sides = TabSides::best;
  const std::vector<TabRequest> others = tab_requests(task.surface, nets, task.options.tabs, glued);
  for (std::size_t j = 0; j < requests.size(); ++j) {
    if (slots[j] == 0) {
      requests[j] = others[j];
    }
  }
  give_tabs_once(task, requests, nets, context);
  put_into_slits(task.surface, task.panels, slots, nets, context);
}

}  // namespace

void give_tabs(const TabTask& task, Nets& nets, const Context& context) {
  const TabChoice& choice = task.choice;
  nets.tabs = {};
  number_joins(task.surface, nets);
  if (!task.options.tabs.wanted) {
    return;
  }
  // Who gives more of a seam is told by tabs that nobody has chosen.
  if (!choice.any() || choice.sides == TabSides::one_side) {
    give_tabs_once(task, {}, nets, context);
  }
  if (choice.any()) {
    std::vector<TabRequest> requests = tab_requests(task.surface, nets, task.options.tabs, choice);
    give_tabs_once(task, requests, nets, context);
    if (choice.sides == TabSides::slots) {
      give_slots(task, requests, nets, context);
    }
    add_more_tabs({task.surface, task.panels, task.options.tabs, requests}, task.options.sheet, choice, nets,
                  context);
  }
}

void replace_tabs(const TabTask& task, Nets& nets, const Context& context) {
  const auto& [surface, panels, options, choice] = task;
  IdVector<FaceId, PartId> part(surface.face_count());  // that each body has its own is all that counts
  for (const FaceId f : ids<FaceId>(part.size())) {
    part[f] = PartId(surface.component(f).value());
  }
  const UnfoldProblem whole{surface, panels, part, options};
  const std::optional<OneOfEach> each = one_of_each(whole);
  // Equal bodies get equal tabs, unless some edge has a request of its own, or tabs that copies don't know
  // of.
  const bool alike = choice.edges.empty() && choice.at.empty() && !choice.borders &&
                     choice.sides != TabSides::both && choice.sides != TabSides::slots;
  std::optional<Nets> originals = each && alike ? without_copies(whole, *each, nets) : std::nullopt;
  if (originals) {
    give_tabs({each->kept.surface, each->panels, each->options, choice}, *originals, context);
    number_joins(surface, nets);
    copy_tabs(whole, *each, *originals, nets);
  } else {
    give_tabs(task, nets, context);
  }
  add_base_tabs(surface, options, choice, nets, context);
  nets.equal = find_equal_pieces(surface, nets);
}

void add_base_tabs(const mesh::Surface& surface, const Options& options, const TabChoice& choice, Nets& nets,
                   const Context& context) {
  if (!options.tabs.wanted || !options.tabs.at_open_bases) {
    return;
  }
  std::vector<BaseSide> bases = find_open_bases(surface, context);
  std::set<CornerId> with_tab;
  for (const Tab& tab : nets.tabs) {
    with_tab.insert(tab.side);
  }
  std::erase_if(bases, [&](const BaseSide& base) { return with_tab.contains(base.side); });
  if (bases.empty()) {
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
  for (const TabSite& site : find_base_sites(surface, nets, bases, highest, context)) {
    const TabOptions own = options_for(options.tabs, choice, site.length);
    Tab tab;
    tab.of_base = true;
    tabs.place(site, largest_tab({0.0, site.length, site.length}, site.obstacles, own, TabNeed::usable), own,
               tab);
  }
  if (options.sheet && nets.tabs.size() > first) {
    drop_beyond(*options.sheet, first, nets);
  }
}

}  // namespace ridgecraft::unfold
