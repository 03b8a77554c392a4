// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/give_tabs.hpp"

#include <span>
#include <vector>

#include "unfold/net/joins.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/more_tabs.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::unfold {

namespace {

void give_tabs_once(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                    Nets& nets, const Context& context, std::span<const TabWish> wishes) {
  place_tabs(surface, panels, options.tabs, nets, context, {}, wishes);
  if (options.sheet) {
    fit_tabs_to_sheet(surface, panels, options.tabs, *options.sheet, nets, context, wishes);
  }
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
    const std::vector<TabWish> wishes = tab_wishes(surface, nets, options.tabs, choice);
    give_tabs_once(surface, panels, options, nets, context, wishes);
    add_more_tabs(surface, panels, options, wishes, choice, nets, context);
  }
}

}  // namespace ridgecraft::unfold
