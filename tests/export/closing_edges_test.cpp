// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers are left out only where the paper itself says what is glued to what.
#include "export/page/closing_edges.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <catch2/catch.hpp>

#include "base/elementary.hpp"

namespace ridgecraft {
namespace {

using export_::NumberAt;

/// A piece whose outline has these numbers, clockwise; those with a minus sign have no place. No seam is
/// where the number is 0: a border.
export_::PieceDrawing outline(const std::vector<int>& numbers) {
  export_::PieceDrawing piece;
  piece.rims.emplace_back();
  const auto corner = [&](std::size_t i) {
    const double turn =
        -6.283185307179586 * static_cast<double>(i % numbers.size()) / static_cast<double>(numbers.size());
    return Vec2{elementary::cos(turn), elementary::sin(turn)};
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != 0) {
      export_::Seam seam;
      seam.number = static_cast<std::uint32_t>(std::abs(numbers[i]));
      seam.edge = {corner(i + 1), corner(i)};  // its face on the left
      seam.at = numbers[i] > 0 ? NumberAt::edge : NumberAt::list;
      piece.rims[0].push_back(piece.seams.size());
      piece.seams.push_back(seam);
    }
  }
  return piece;
}

/// Places in the outline, borders left out, whose numbers needed none.
std::vector<std::size_t> left_out(const std::vector<int>& numbers) {
  export_::PieceDrawing piece = outline(numbers);
  export_::leave_out_closing(piece);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < piece.seams.size(); ++i) {
    if (piece.seams[i].at == NumberAt::closing) {
      places.push_back(i);
    }
  }
  return places;
}

using Places = std::vector<std::size_t>;

}  // namespace

TEST_CASE("an edge beside the one with its number needs none", "[closing_edges]") {
  CHECK(left_out({1, 2, -2, 3}) == Places{2});
  CHECK(left_out({1, -2, 2, 3}) == Places{1});
  CHECK(left_out({-2, 1, 3, 2}) == Places{0});  // over the end of the outline
  CHECK(left_out({1, 2, 3, 4}).empty());
}

TEST_CASE("what closes like a zip needs no number from its end on", "[closing_edges]") {
  CHECK(left_out({1, 2, 3, 3, -2, 4}) == Places{4});
  CHECK(left_out({1, 2, 3, 3, 5, 5, -2, 4}) == Places{6});
  // 3 is glued elsewhere, so the two edges of 2 don't meet by themselves.
  CHECK(left_out({1, 2, 3, -2, 4, 3}).empty());
  CHECK(left_out({1, 2, 3, 4, 3, 4, -2, 5}).empty());
}

TEST_CASE("a border parts edges", "[closing_edges]") {
  CHECK(left_out({1, 2, 0, -2, 3}).empty());
  CHECK(left_out({1, 2, 3, 0, 3, -2, 4}).empty());
}

}  // namespace ridgecraft
