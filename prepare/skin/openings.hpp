// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies with openings that mustn't be taken for solids. Private to prepare/.
#pragma once

#include "base/context.hpp"
#include "prepare/skin/fates.hpp"

namespace ridgecraft::prepare {

/// Takes bodies out of `solid` that have a bent opening of which more than a little is seen, since what
/// closes it is a guess, or else those through whose openings one sees what would be dropped. Whether there
/// were any; fates stay as they were.
bool find_open_bodies(Fates& fates, const Context& context);

}  // namespace ridgecraft::prepare
