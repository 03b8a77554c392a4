// SPDX-License-Identifier: GPL-3.0-or-later
// The tabs of finished nets: where they may be, then which of them the sheet holds.
#pragma once

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/net/tab_choice.hpp"

namespace ridgecraft::unfold {

/// Numbers the joins of these nets and gives them tabs as the options say, each body by itself, whatever
/// others are its equals (replace_tabs.hpp), then as a choice says that asks for anything. Tabs that were
/// there are lost. Throws Error(interrupted), and Error(unreadable_input) as tab_wishes().
void give_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
               Nets& nets, const Context& context, const TabChoice& choice = {});

}  // namespace ridgecraft::unfold
