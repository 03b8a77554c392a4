// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/give_tabs.hpp"

#include "unfold/net/joins.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::unfold {

void give_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
               Nets& nets, const Context& context) {
  nets.tabs = {};
  number_joins(surface, nets);
  if (options.tabs.wanted) {
    place_tabs(surface, panels, options.tabs, nets, context);
    if (options.sheet) {
      fit_tabs_to_sheet(surface, panels, options.tabs, *options.sheet, nets, context);
    }
  }
}

}  // namespace ridgecraft::unfold
