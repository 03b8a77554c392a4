// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/border.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"

namespace ridgecraft {
namespace {

using segment::Border;
using segment::Pair;

/// Borders of items in a row and across, summed up anew from the items of each set.
std::map<Pair, double> summed(const std::map<Pair, double>& between_items,
                              const std::vector<std::uint32_t>& set_of) {
  std::map<Pair, double> sums;
  for (const auto& [pair, length] : between_items) {
    const std::uint32_t p = set_of[pair.first];
    const std::uint32_t q = set_of[pair.second];
    if (p != q) {
      sums[std::minmax(p, q)] += length;
    }
  }
  return sums;
}

}  // namespace

TEST_CASE("Pairs have their turn by rank, then by number, whatever ranks they had before") {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    segment::PairQueue<double> queue;
    std::map<Pair, double> waiting;
    for (int step = 0; step < 300; ++step) {
      const Pair pair{random.below(8), 8 + random.below(8)};
      const double rank = random.below(5);
      switch (random.below(4)) {
        case 0:
          queue.drop(pair);
          waiting.erase(pair);
          break;
        case 1:
          if (!waiting.empty()) {
            const auto least =
                std::min_element(waiting.begin(), waiting.end(),
                                 [](const auto& a, const auto& b) { return a.second < b.second; });
            CHECK(queue.take() == least->first);
            waiting.erase(least);
          }
          break;
        default:
          queue.put(pair, rank);
          waiting[pair] = rank;
      }
      CHECK(queue.empty() == waiting.empty());
    }
  }
}

TEST_CASE("Borders of sets that grow together are those of all that is in them") {
  constexpr std::uint32_t items = 40;
  Random random(5);
  std::map<Pair, double> between_items;
  segment::BorderGraph<Border> borders(items);
  for (int i = 0; i < 120; ++i) {
    const std::uint32_t p = random.below(items);
    const std::uint32_t q = random.below(items);
    if (p != q) {
      const double length = 1.0 + random.below(10);  // whole numbers: sums are exact in any order
      between_items[std::minmax(p, q)] += length;
      borders.between(p, q).add({length, 0.5 * length});
    }
  }
  std::vector<std::uint32_t> set_of(items);
  std::iota(set_of.begin(), set_of.end(), 0U);
  while (!borders.all().empty()) {
    const Pair pair = borders.all().begin()->first;
    std::uint32_t into = pair.first;
    std::vector<std::uint32_t> taken_in{pair.second};
    if (random.below(2) == 0) {
      // Both into a new set.
      into = borders.add_set();
      taken_in.push_back(pair.first);
    }
    for (const std::uint32_t from : taken_in) {
      std::size_t gone = 0;
      const std::size_t before = borders.beside(from).size();
      borders.take_in(into, from, [&](const Pair& ended) {
        CHECK((ended.first == from || ended.second == from));
        ++gone;
      });
      CHECK(gone == before);
      CHECK(borders.beside(from).empty());
      std::replace(set_of.begin(), set_of.end(), from, into);
    }
    const std::map<Pair, double> expected = summed(between_items, set_of);
    REQUIRE(borders.all().size() == expected.size());
    for (const auto& [between, border] : borders.all()) {
      CHECK(border.length == expected.at(between));
      CHECK(border.mean() == 0.5);
    }
  }
}

}  // namespace ridgecraft
