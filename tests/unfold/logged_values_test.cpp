// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"

using namespace ridgecraft;
using unfold::LoggedValues;

namespace {

std::vector<int> all(const LoggedValues<int>& values) {
  std::vector<int> result;
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    result.push_back(values[i]);
  }
  return result;
}

}  // namespace

TEST_CASE("values that were overwritten many times are taken back at once", "[logged_values]") {
  Random random(1);
  LoggedValues<int> values(20);
  for (int round = 0; round < 200; ++round) {
    values.keep();
    const std::vector<int> before = all(values);
    const std::uint32_t changes = random.below(60);
    for (std::uint32_t change = 0; change < changes; ++change) {
      values.set(random.below(20), static_cast<int>(random.below(4)));
    }
    if (random.below(2) == 0) {
      const std::vector<int> after = all(values);
      values.take_back();
      CHECK(all(values) == before);
      // There is nothing left to take back, and what comes next is logged as before.
      values.take_back();
      CHECK(all(values) == before);
      for (std::uint32_t i = 0; i < 20; ++i) {
        values.set(i, after[i]);
      }
      values.take_back();
      CHECK(all(values) == before);
    }
  }
}

TEST_CASE("what is kept and what is reset can't be taken back", "[logged_values]") {
  LoggedValues<int> values(3);
  values.set(1, 7);
  values.keep();
  values.take_back();
  CHECK(all(values) == std::vector<int>{0, 7, 0});
  values.set(2, 5);
  values.reset();
  values.take_back();
  CHECK(all(values) == std::vector<int>{0, 0, 0});
}
