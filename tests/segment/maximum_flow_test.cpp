// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/cutting/maximum_flow.hpp"

#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"

namespace ridgecraft {
namespace {

struct Graph {
  std::uint32_t n = 0;
  std::vector<std::array<std::uint32_t, 3>> other;
  std::vector<std::array<std::int64_t, 3>> capacity;
  std::vector<std::int64_t> source;
  std::vector<std::int64_t> sink;
};

/// Random graph of nodes with at most three arcs; several arcs between two nodes allowed.
Graph random_graph(Random& random, std::uint32_t n, std::uint32_t greatest) {
  constexpr auto no = segment::MaximumFlow::no_node;
  Graph g;
  g.n = n;
  g.other.assign(n, {no, no, no});
  g.capacity.assign(n, {0, 0, 0});
  g.source.assign(n, 0);
  g.sink.assign(n, 0);
  for (std::uint32_t tries = 0; tries < 4 * n; ++tries) {
    const std::uint32_t a = random.below(n);
    const std::uint32_t b = random.below(n);
    const std::uint32_t i = random.below(3);
    const std::uint32_t j = random.below(3);
    if (a != b && g.other[a][i] == no && g.other[b][j] == no) {
      g.other[a][i] = b;
      g.other[b][j] = a;
      g.capacity[a][i] = g.capacity[b][j] = random.below(greatest + 1);
    }
  }
  for (std::uint32_t v = 0; v < n; ++v) {
    g.source[v] = random.below(3) == 0 ? random.below(2 * greatest) : 0;
    g.sink[v] = random.below(3) == 0 ? random.below(2 * greatest) : 0;
  }
  return g;
}

std::int64_t run(const Graph& g, segment::MaximumFlow& flow) {
  flow.reset(g.n);
  std::int64_t through = 0;
  for (std::uint32_t v = 0; v < g.n; ++v) {
    for (unsigned k = 0; k < 3; ++k) {
      if (g.other[v][k] != segment::MaximumFlow::no_node) {
        flow.set_arc(v, k, g.other[v][k], g.capacity[v][k]);
      }
    }
    flow.add_source(v, g.source[v]);
    flow.add_sink(v, g.sink[v]);
    through += std::min(g.source[v], g.sink[v]);  // straight from source to sink, not seen by the trees
  }
  return flow.run() + through;
}

std::int64_t cut_value(const Graph& g, const std::vector<bool>& on_source_side) {
  std::int64_t value = 0;
  for (std::uint32_t v = 0; v < g.n; ++v) {
    value += on_source_side[v] ? g.sink[v] : g.source[v];
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t w = g.other[v][k];
      if (w != segment::MaximumFlow::no_node && on_source_side[v] && !on_source_side[w]) {
        value += g.capacity[v][k];
      }
    }
  }
  return value;
}

}  // namespace

TEST_CASE("Small graphs: the flow is the least cut of all, on the smallest source side") {
  Random random(9);
  segment::MaximumFlow flow;
  for (int round = 0; round < 2000; ++round) {
    const std::uint32_t n = 1 + random.below(10);
    const Graph g = random_graph(random, n, 1 + random.below(6));
    const std::int64_t value = run(g, flow);
    std::int64_t least = cut_value(g, std::vector<bool>(n, false));
    std::vector<bool> smallest(n, true);  // the intersection of all minimum source sides
    for (std::uint32_t subset = 0; subset < (1U << n); ++subset) {
      std::vector<bool> side(n);
      for (std::uint32_t v = 0; v < n; ++v) {
        side[v] = (subset >> v & 1U) != 0;
      }
      const std::int64_t cut = cut_value(g, side);
      if (cut < least) {
        least = cut;
        smallest.assign(n, true);
      }
      if (cut == least) {
        for (std::uint32_t v = 0; v < n; ++v) {
          smallest[v] = smallest[v] && side[v];
        }
      }
    }
    REQUIRE(value == least);
    for (std::uint32_t v = 0; v < n; ++v) {
      REQUIRE(flow.on_source_side(v) == smallest[v]);
    }
  }
}

TEST_CASE("Larger graphs: the flow equals the cut that it names") {
  Random random(10);
  segment::MaximumFlow flow;
  for (int round = 0; round < 50; ++round) {
    const std::uint32_t n = 200 + random.below(2000);
    const Graph g = random_graph(random, n, 1000);
    const std::int64_t value = run(g, flow);
    std::vector<bool> side(n);
    for (std::uint32_t v = 0; v < n; ++v) {
      side[v] = flow.on_source_side(v);
    }
    REQUIRE(value == cut_value(g, side));
  }
}

TEST_CASE("Nodes joined without limit are never parted") {
  segment::MaximumFlow flow;
  flow.reset(3);
  flow.set_arc(0, 0, 1, segment::MaximumFlow::infinite_capacity);
  flow.set_arc(1, 0, 0, segment::MaximumFlow::infinite_capacity);
  flow.set_arc(1, 1, 2, 5);
  flow.set_arc(2, 0, 1, 5);
  flow.add_source(0, 7);
  flow.add_sink(2, 9);
  CHECK(flow.run() == 5);
  CHECK(flow.on_source_side(0));
  CHECK(flow.on_source_side(1));
  CHECK_FALSE(flow.on_source_side(2));
}

}  // namespace ridgecraft
