// SPDX-License-Identifier: GPL-3.0-or-later
// Corners that are too near to each other to be meant.
#include "export/page/crumbs.hpp"

#include <cmath>

#include <catch2/catch.hpp>

namespace ridgecraft {

TEST_CASE("crumbs go where the line stays, corners that count don't", "[crumbs]") {
  using export_::without_crumbs;
  const std::vector<Vec2> square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  CHECK(without_crumbs(square, true) == square);
  CHECK(without_crumbs({{0, 0}, {10, 0}, {10, 0.012}, {10, 10}, {0, 10}}, true).size() == 4);
  CHECK(without_crumbs({{0, 0}, {5, 0.001}, {5.02, 0.0}, {10, 0}, {10, 10}, {0, 10}}, true).size() == 5);
  // A notch 0.04 mm wide and 1 mm deep.
  const std::vector<Vec2> notch{{0, 0}, {5, 0}, {5, 1}, {5.04, 1}, {5.04, 0}, {10, 0}, {10, 10}, {0, 10}};
  CHECK(without_crumbs(notch, true).size() >= 7);
  // Many small bends in one sense: a curve stays one.
  std::vector<Vec2> circle;
  for (int i = 0; i < 400; ++i) {
    circle.push_back({2.0 * std::cos(i * 0.0157079633), 2.0 * std::sin(i * 0.0157079633)});
  }
  const std::vector<Vec2> fewer = without_crumbs(circle, true);
  CHECK(fewer.size() < 200);
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    CHECK(length(0.5 * (fewer[i] + fewer[(i + 1) % fewer.size()])) > 2.0 - 0.0105);
  }
  CHECK(without_crumbs({{0, 0}, {0.01, 0}, {0.02, 0}}, false) == std::vector<Vec2>{{0, 0}, {0.02, 0}});
}

}  // namespace ridgecraft
