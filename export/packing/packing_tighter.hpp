// SPDX-License-Identifier: GPL-3.0-or-later
// A page less than bitmaps could do with.
#pragma once

#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "export/packing/packing_task.hpp"

namespace ridgecraft::paper {

/// Tries, within that much work (ExactSeparation), to do without the emptiest page of a finished packing, and
/// then without another: its shapes go onto the others, and all are moved apart by their true outlines. What
/// it finds keeps the gap and nothing else: neighbours may have come apart. Returns whether a page was saved.
bool pack_tighter(const PackingTask& task, std::uint64_t most_work, const Context& context,
                  std::vector<Packed>& packed);

}  // namespace ridgecraft::paper
