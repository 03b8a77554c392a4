// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/keep_numbers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "unfold/net/chains.hpp"
#include "unfold/net/outline.hpp"

namespace ridgecraft::unfold {
namespace {

/// Takes a number from all joins but those of the largest row that has it.
void leave_one_row(const mesh::Surface& surface, Nets& nets) {
  IdVector<EdgeId, JoinId> join(surface.edge_count());
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    join[nets.joins[j].edge] = j;
  }
  DisjointSets rows(nets.joins.size());
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    for (const CornerId side : surface.sides(nets.joins[j].edge)) {
      const JoinId next = join[surface.edge(next_boundary(surface, nets, side))];
      if (next.valid() && nets.joins[next].number == nets.joins[j].number) {
        rows.join(j.value(), next.value());
      }
    }
  }
  std::vector<std::size_t> size(nets.joins.size(), 0);
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    ++size[rows.find(j.value())];
  }
  std::map<std::uint32_t, std::size_t> largest;  // of each number
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    const std::size_t row = rows.find(j.value());
    const auto [best, is_new] = largest.try_emplace(nets.joins[j].number, row);
    if (!is_new && size[row] > size[best->second]) {
      best->second = row;
    }
  }
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    Join& own = nets.joins[j];
    own.number = largest[own.number] == rows.find(j.value()) ? own.number : 0;
  }
}

/// Chains without a number get those that follow `last`, in the order of their joins.
void number_others(const mesh::Surface& surface, std::uint32_t last, Nets& nets) {
  std::vector<Chain> chains = chains_of(surface, nets);
  std::erase_if(chains, [](const Chain& chain) { return chain.number != 0; });
  std::ranges::sort(chains, {}, [](const Chain& chain) { return chain.joins.front(); });
  for (const Chain& chain : chains) {
    ++last;
    for (const JoinId j : chain.joins) {
      nets.joins[j].number = last;
    }
  }
}

void sort_by_number(Nets& nets) {
  std::vector<JoinId> order;
  for (const JoinId j : ids<JoinId>(nets.joins.size())) {
    order.push_back(j);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](JoinId a, JoinId b) { return nets.joins[a].number < nets.joins[b].number; });
  IdVector<JoinId, Join> joins;
  IdVector<JoinId, JoinId> place(order.size());
  for (const JoinId old : order) {
    place[old] = joins.push_back(nets.joins[old]);
  }
  nets.joins = std::move(joins);
  for (Tab& tab : nets.tabs) {
    if (tab.join.valid()) {
      tab.join = place[tab.join];
    }
  }
}

}  // namespace

void keep_numbers(const mesh::Surface& surface, const IdVector<JoinId, Join>& before, Nets& nets) {
  std::map<EdgeId, std::uint32_t> numbers;
  std::uint32_t last = 0;
  for (const Join& join : before) {
    numbers[join.edge] = join.number;
    last = std::max(last, join.number);
  }
  for (Join& join : nets.joins) {
    const auto old = numbers.find(join.edge);
    join.number = old == numbers.end() ? 0 : old->second;
  }
  leave_one_row(surface, nets);
  number_others(surface, last, nets);
  sort_by_number(nets);
}

}  // namespace ridgecraft::unfold
