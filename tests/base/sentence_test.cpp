// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/sentence.hpp"

#include <catch2/catch.hpp>

#include "cli/telling/summary_pieces.hpp"

using namespace ridgecraft;
using namespace ridgecraft;

TEST_CASE("words are listed as people do", "[sentence]") {
  CHECK(listed({}, "and").empty());
  CHECK(listed({"a"}, "and") == "a");
  CHECK(listed({"a", "b"}, "or") == "a or b");
  CHECK(listed({"a", "b", "c"}, "and") == "a, b and c");
  CHECK(counted(1, "page") == "1 page");
  CHECK(counted(0, "page") == "0 pages");
}

TEST_CASE("rows of piece names are short", "[sentence]") {
  unfold::Nets nets;
  for (const char* name : {"A", "B", "C", "D", "E", "F", "G", "H", "I"}) {
    unfold::Piece piece;
    piece.name = name;
    nets.pieces.push_back(std::move(piece));
  }
  const auto named = [&](const std::vector<std::uint32_t>& numbers) {
    std::vector<PieceId> pieces;
    for (const std::uint32_t i : numbers) {
      pieces.emplace_back(i);
    }
    return piece_names(nets, pieces);
  };
  CHECK(named({0}) == "A");
  CHECK(named({0, 1}) == "A, B");
  CHECK(named({1, 2, 3}) == "B to D");
  CHECK(named({0, 2}) == "A, C");
  CHECK(named({0, 1, 2, 3, 4, 5, 8}) == "A, B, C, D, E, F and 1 more");
}
