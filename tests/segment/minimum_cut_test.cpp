// SPDX-License-Identifier: GPL-3.0-or-later
// Minimum cuts, and cuts narrowed down on clusters, against cuts through the whole graph.
#include "segment/cutting/minimum_cut.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/no_index.hpp"
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
  constexpr auto no = no_index;
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
      if (g.other[v][k] != no_index) {
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
      if (w != no_index && on_source_side[v] && !on_source_side[w]) {
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

namespace ridgecraft::segment {
namespace {

// Cuts narrowed down on clusters, against cuts through the whole graph.

constexpr std::uint32_t rows = 60;
constexpr std::uint32_t columns = 60;

struct ListedGraph : CutGraph {
  std::vector<Node> nodes;

  [[nodiscard]] std::size_t size() const override { return nodes.size(); }
  [[nodiscard]] Node node(std::uint32_t i) const override { return nodes[i]; }
};

/// Triangles of a grid of squares, each cut in two: node 2 s lies below the diagonal of square s, node 2 s +
/// 1 above. `price` of an arc by the squares at its ends; source along the left border, sink along the right
/// one.
template <class Price>
ListedGraph grid(Price price) {
  ListedGraph graph;
  graph.nodes.resize(2 * rows * columns);
  const auto join = [&](std::uint32_t i, unsigned k, std::uint32_t j, unsigned l) {
    const std::int64_t capacity = price(i / 2, j / 2);
    graph.nodes[i].sides[k] = {capacity, j, false};
    graph.nodes[j].sides[l] = {capacity, i, false};
  };
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t s = row * columns + column;
      join(2 * s, 0, 2 * s + 1, 0);
      if (column + 1 < columns) {
        join(2 * s, 1, 2 * (s + 1) + 1, 1);
      }
      if (row + 1 < rows) {
        join(2 * s + 1, 2, 2 * (s + columns), 2);
      }
      graph.nodes[2 * s + 1].source = column == 0 ? 1000 : 0;
      graph.nodes[2 * s].sink = column + 1 == columns ? 1000 : 0;
    }
  }
  return graph;
}

/// Which nodes are on the source's side when those of `side` that aren't open are held.
std::vector<bool> cut(const ListedGraph& graph, const std::vector<CutSide>& side) {
  const auto n = static_cast<std::uint32_t>(graph.nodes.size());
  MaximumFlow flow;
  flow.reset(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const CutGraph::Side& arc = graph.nodes[i].sides[k];
      if (arc.other != no_index) {
        flow.set_arc(i, k, arc.other, arc.capacity);
      }
    }
    flow.add_source(i, side[i] == CutSide::source ? MaximumFlow::infinite_capacity : graph.nodes[i].source);
    flow.add_sink(i, side[i] == CutSide::sink ? MaximumFlow::infinite_capacity : graph.nodes[i].sink);
  }
  flow.run();
  std::vector<bool> on_source(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    on_source[i] = flow.on_source_side(i);
  }
  return on_source;
}

std::int64_t price_of(const ListedGraph& graph, const std::vector<bool>& on_source) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < on_source.size(); ++i) {
    sum += on_source[i] ? graph.nodes[i].sink : graph.nodes[i].source;
    for (const CutGraph::Side& arc : graph.nodes[i].sides) {
      sum += on_source[i] && arc.other != no_index && !on_source[arc.other] ? arc.capacity : 0;
    }
  }
  return sum;
}

/// Nodes that are held on one side and beside an open one that came to the other.
std::vector<std::uint32_t> touched_holds(const ListedGraph& graph, const std::vector<CutSide>& side,
                                         const std::vector<bool>& on_source) {
  std::vector<std::uint32_t> touched;
  for (std::uint32_t i = 0; i < side.size(); ++i) {
    for (const CutGraph::Side& arc : graph.nodes[i].sides) {
      if (arc.other != no_index && side[i] != CutSide::open && side[arc.other] == CutSide::open &&
          on_source[i] != on_source[arc.other]) {
        touched.push_back(i);
        break;
      }
    }
  }
  return touched;
}

struct Compared {
  std::int64_t whole;
  std::int64_t narrowed;
  std::size_t open;
};

Compared compare_cuts(const ListedGraph& graph) {
  CoarseCut coarse;
  std::vector<CutSide> side;
  coarse.run(graph, side);
  std::vector<bool> narrowed;
  std::vector<std::uint32_t> touched;
  std::int64_t last_price = MaximumFlow::infinite_capacity;
  do {
    narrowed = cut(graph, side);
    touched = touched_holds(graph, side, narrowed);
    CHECK(price_of(graph, narrowed) <= last_price);
    last_price = price_of(graph, narrowed);
  } while (!touched.empty() && coarse.widen(touched, side));
  const std::vector<CutSide> all_open(graph.nodes.size(), CutSide::open);
  return {price_of(graph, cut(graph, all_open)), price_of(graph, narrowed),
          static_cast<std::size_t>(std::count(side.begin(), side.end(), CutSide::open))};
}

}  // namespace

TEST_CASE("a cut along a cheap line is found among clusters", "[segment]") {
  for (const std::uint32_t line : {5U, 29U, 52U}) {
    ListedGraph graph = grid([&](std::uint32_t s, std::uint32_t t) {
      return std::int64_t{std::max(s % columns, t % columns) == line && s % columns != t % columns ? 30
                                                                                                   : 100};
    });
    for (CutGraph::Node& node : graph.nodes) {
      for (CutGraph::Side& arc : node.sides) {
        arc.crease = arc.capacity == 30;
      }
    }
    const Compared found = compare_cuts(graph);
    CHECK(found.narrowed == found.whole);
    CHECK(found.open < graph.nodes.size());
  }
}

TEST_CASE("narrowed cuts are the whole graph's or little dearer", "[segment]") {
  Random random(3);
  int equal = 0;
  for (int round = 0; round < 20; ++round) {
    const ListedGraph graph =
        grid([&](std::uint32_t, std::uint32_t) { return std::int64_t{85 + random.below(30)}; });
    const Compared found = compare_cuts(graph);
    CHECK(found.narrowed >= found.whole);
    CHECK(static_cast<double>(found.narrowed) <= 1.05 * static_cast<double>(found.whole));
    equal += found.narrowed == found.whole ? 1 : 0;
  }
  CHECK(equal >= 2);
}

TEST_CASE("clusters of one node, of no node, and arcs that can't be cut", "[segment]") {
  CoarseCut coarse;
  std::vector<CutSide> side;
  ListedGraph graph;
  coarse.run(graph, side);
  CHECK(side.empty());
  // Creases everywhere: every node is its own cluster.
  graph = grid([](std::uint32_t, std::uint32_t) { return std::int64_t{100}; });
  for (CutGraph::Node& node : graph.nodes) {
    for (CutGraph::Side& arc : node.sides) {
      arc.crease = true;
    }
  }
  const Compared creased = compare_cuts(graph);
  CHECK(creased.narrowed == creased.whole);
  // Infinite arcs in all but one column of squares: the cut must run there.
  graph = grid([](std::uint32_t s, std::uint32_t t) {
    const bool cheap = s % columns == 29 && t % columns == 30;
    return cheap ? std::int64_t{100} : MaximumFlow::infinite_capacity;
  });
  const Compared held = compare_cuts(graph);
  CHECK(held.whole == 60 * 100);
  CHECK(held.narrowed == held.whole);
}

}  // namespace ridgecraft::segment
