// SPDX-License-Identifier: GPL-3.0-or-later
// Puts edges in order of their ends in linear time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ridgecraft {

/// Runs up to this length are sorted by insertion.
inline constexpr std::size_t most_inserted = 24;

/// The same edges by `low`, those of one `low` by `high`, equal ones in the order in which they came. Edges
/// have few companions at one end, so this is a counting sort and many tiny sorts; several times as fast as
/// sorting all at once.
template <class Edge>
[[nodiscard]] std::vector<Edge> in_edge_order(std::span<const Edge> edges) {
  std::uint32_t ends = 0;
  for (const Edge& e : edges) {
    ends = std::max(ends, e.low + 1);
  }
  std::vector<std::uint32_t> place(std::size_t{ends} + 1, 0);
  for (const Edge& e : edges) {
    ++place[e.low + 1];
  }
  for (std::size_t v = 0; v < ends; ++v) {
    place[v + 1] += place[v];
  }
  std::vector<Edge> ordered(edges.size());
  for (const Edge& e : edges) {
    ordered[place[e.low]++] = e;
  }
  // Each entry of `place` is now the end of its run, which is the start of the next one.
  std::size_t first = 0;
  for (std::size_t v = 0; v < ends; ++v) {
    if (place[v] - first > most_inserted) {
      std::stable_sort(ordered.begin() + static_cast<std::ptrdiff_t>(first), ordered.begin() + place[v],
                       [](const Edge& a, const Edge& b) { return a.high < b.high; });
    } else {
      for (std::size_t i = first + 1; i < place[v]; ++i) {
        const Edge moved = ordered[i];
        std::size_t at = i;
        for (; at > first && moved.high < ordered[at - 1].high; --at) {
          ordered[at] = ordered[at - 1];
        }
        ordered[at] = moved;
      }
    }
    first = place[v];
  }
  return ordered;
}

}  // namespace ridgecraft
