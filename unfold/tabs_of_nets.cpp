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
#include "unfold/net/equal_pieces.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/plan.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/missing_tabs.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/place/slot_tabs.hpp"
#include "unfold/tabs/place/tab_requests.hpp"

namespace ridgecraft::unfold {
namespace {

void give_tabs_once(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                    Nets& nets, const Context& context, std::span<const TabRequest> requests) {
  place_tabs(surface, panels, options.tabs, nets, context, {}, requests);
  if (options.sheet) {
    fit_tabs_to_sheet(surface, panels, options.tabs, *options.sheet, nets, context, requests);
  }
}

/// Arrows where there is room for their slits, then tabs once more: as they always are where there is none.
void give_slots(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                Nets& nets, const Context& context, const TabChoice& choice,
                std::vector<TabRequest>& requests) {
  std::vector<std::uint8_t> slots;
  for (const TabRequest& request : requests) {
    slots.push_back(request.slot ? 1 : 0);
  }
  slots = put_into_slits(surface, panels, slots, nets, context);
  TabChoice glued = choice;
  glued.sides = TabSides::best;
  const std::vector<TabRequest> others = tab_requests(surface, nets, options.tabs, glued);
  for (std::size_t j = 0; j < requests.size(); ++j) {
    if (slots[j] == 0) {
      requests[j] = others[j];
    }
  }
  give_tabs_once(surface, panels, options, nets, context, requests);
  put_into_slits(surface, panels, slots, nets, context);
}

}  // namespace

void give_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
               Nets& nets, const Context& context, const TabChoice& choice) {
  nets.tabs = {};
  number_joins(surface, nets);
  if (!options.tabs.wanted) {
    return;
  }
  // Who gives more of a seam is told by tabs that nobody has chosen.
  if (!choice.any() || choice.sides == TabSides::one_side) {
    give_tabs_once(surface, panels, options, nets, context, {});
  }
  if (choice.any()) {
    std::vector<TabRequest> requests = tab_requests(surface, nets, options.tabs, choice);
    give_tabs_once(surface, panels, options, nets, context, requests);
    if (choice.sides == TabSides::slots) {
      give_slots(surface, panels, options, nets, context, choice, requests);
    }
    add_more_tabs(surface, panels, options, requests, choice, nets, context);
  }
}

void replace_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                  Nets& nets, const Context& context, const TabChoice& choice) {
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
    give_tabs(each->kept.surface, each->panels, each->options, *originals, context, choice);
    number_joins(surface, nets);
    copy_tabs(whole, *each, *originals, nets);
  } else {
    give_tabs(surface, panels, options, nets, context, choice);
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
