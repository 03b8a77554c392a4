// SPDX-License-Identifier: GPL-3.0-or-later
// Packing of pieces on pages by their true shapes: bottom-left filling of bitmaps in some order, and a search
// over orders. Knows nothing of nets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/geometry.hpp"
#include "export/packing/packing_shape.hpp"

namespace ridgecraft::export_ {

/// Packs all shapes on as few pages as it finds in a fixed amount of work. Deterministic, unless the
/// context's deadline passes. Pages are in the order of the groups on them, one that is much emptier than the
/// others last. Distances are never less than the gap, and more on pages that have room. The work is O(n)
/// page searches for each order tried, and the orders after the first few stop at the task's number of words
/// read. Asks the context for interruption.
[[nodiscard]] std::vector<Packed> pack(const PackingTask& task, const Context& context);

/// How many pages a quick search needs: simple orders and a short walk, on coarse bitmaps.
/// pack() mostly does as well or better, for some ten times the work.
[[nodiscard]] std::size_t rough_page_count(const PackingTask& task, const Context& context);

/// Shapes of a task that look the same when each is moved so; mirrored ones are mirror images at x = 0.
struct AlikeShapes {
  std::vector<std::uint32_t> shapes;
  std::vector<Rigid> motion;   ///< of each shape
  std::vector<bool> mirrored;  ///< each shape
};

/// As pack(), with alike shapes in rows where that costs no page: rows with room for numbers between the
/// shapes before narrow ones. Kinds are left as they come, largest first, until the others do. A few times
/// the work.
[[nodiscard]] std::vector<Packed> pack_in_rows(const PackingTask& task, const std::vector<AlikeShapes>& kinds,
                                               const Context& context);

}  // namespace ridgecraft::export_
