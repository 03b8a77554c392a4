// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/give_tabs.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include "unfold/net/joins.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/more_tabs.hpp"
#include "unfold/tabs/place/place_tabs.hpp"
#include "unfold/tabs/place/slot_tabs.hpp"

namespace ridgecraft::unfold {

namespace {

void give_tabs_once(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                    Nets& nets, const Context& context, std::span<const TabWish> wishes) {
  place_tabs(surface, panels, options.tabs, nets, context, {}, wishes);
  if (options.sheet) {
    fit_tabs_to_sheet(surface, panels, options.tabs, *options.sheet, nets, context, wishes);
  }
}

/// Arrows where there is room for their slits, then tabs once more: as they always are where there is none.
void give_slots(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                Nets& nets, const Context& context, const TabChoice& choice, std::vector<TabWish>& wishes) {
  std::vector<std::uint8_t> slots;
  for (const TabWish& wish : wishes) {
    slots.push_back(wish.slot ? 1 : 0);
  }
  slots = put_into_slits(surface, panels, slots, nets, context);
  TabChoice glued = choice;
  glued.sides = TabSides::best;
  const std::vector<TabWish> others = tab_wishes(surface, nets, options.tabs, glued);
  for (std::size_t j = 0; j < wishes.size(); ++j) {
    if (slots[j] == 0) {
      wishes[j] = others[j];
    }
  }
  give_tabs_once(surface, panels, options, nets, context, wishes);
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
    std::vector<TabWish> wishes = tab_wishes(surface, nets, options.tabs, choice);
    give_tabs_once(surface, panels, options, nets, context, wishes);
    if (choice.sides == TabSides::slots) {
      give_slots(surface, panels, options, nets, context, choice, wishes);
    }
    add_more_tabs(surface, panels, options, wishes, choice, nets, context);
  }
}

}  // namespace ridgecraft::unfold
