// SPDX-License-Identifier: GPL-3.0-or-later
// Which edges share a number, and where ticks show how two sides lie against each other.
#include "export/page/seam_marks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <catch2/catch.hpp>

using namespace ridgecraft;
using export_::Layer;
using export_::PieceDrawing;

namespace {

/// A piece whose outline has these corners, counterclockwise; the edge that begins at each is of this number.
/// Edges in a row with one number are a side of a chain.
PieceDrawing piece_of(const std::vector<Vec2>& corners, const std::vector<std::uint32_t>& numbers) {
  PieceDrawing piece;
  piece.rims.emplace_back();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    export_::Seam seam;
    seam.number = numbers[i];
    seam.join = JoinId(i);
    seam.edge = {corners[i], corners[(i + 1) % corners.size()]};
    if (i == 0 || numbers[i] != numbers[i - 1]) {
      piece.sides.emplace_back();
    }
    piece.sides.back().push_back(i);
    piece.seams.push_back(seam);
    piece.rims[0].insert(piece.rims[0].begin(), i);
  }
  return piece;
}

std::vector<std::vector<std::size_t>> rows_of(const PieceDrawing& piece) {
  std::vector<std::vector<std::size_t>> rows;
  for (const export_::NumberedRow& row : export_::numbered_rows(piece)) {
    rows.push_back(row.seams);
  }
  return rows;
}

using Rows = std::vector<std::vector<std::size_t>>;

std::vector<export_::Line> ticks_of(PieceDrawing piece) {
  std::vector<export_::Line> ticks;
  const std::size_t before = piece.group.lines.size();
  export_::add_ticks(piece);
  ticks.assign(piece.group.lines.begin() + static_cast<std::ptrdiff_t>(before), piece.group.lines.end());
  return ticks;
}

}  // namespace

TEST_CASE("a number stands between sharp corners and about every 40 mm", "[seam_marks]") {
  // A square of 30 mm, one chain all around: a number at each side.
  CHECK(rows_of(piece_of({{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {1, 1, 1, 1})) == Rows{{0}, {1}, {2}, {3}});
  // Its lower side in six: still one number there; of 120 mm in six: three.
  std::vector<Vec2> corners;
  for (int i = 0; i < 6; ++i) {
    corners.push_back({5.0 * i, 0.0});
  }
  for (const Vec2 corner : {Vec2{30, 0}, Vec2{30, 30}, Vec2{0, 30}}) {
    corners.push_back(corner);
  }
  const std::vector<std::uint32_t> numbers{1, 1, 1, 1, 1, 1, 2, 3, 4};
  CHECK(rows_of(piece_of(corners, numbers)) == Rows{{0, 1, 2, 3, 4, 5}, {6}, {7}, {8}});
  for (Vec2& corner : corners) {
    corner = 4.0 * corner;
  }
  CHECK(rows_of(piece_of(corners, numbers)) == Rows{{0, 1}, {2, 3}, {4, 5}, {6}, {7}, {8}});
}

TEST_CASE("short ticks stand where edges of a chain meet unseen, at the same places on both sides",
          "[seam_marks]") {
  const PieceDrawing piece =
      piece_of({{0, 0}, {10, 0}, {25, 0}, {40, 0}, {40, 50}, {0, 50}}, {1, 1, 1, 2, 3, 4});
  const std::vector<export_::Line> ticks = ticks_of(piece);
  REQUIRE(ticks.size() == 2);
  std::vector<double> places;
  for (const export_::Line& tick : ticks) {
    CHECK(tick.layer == Layer::mark);
    CHECK(length(tick.points[1] - tick.points[0]) == Approx(1.1));
    CHECK(tick.points[1].y == Approx(1.1));  // into the piece
    places.push_back(tick.points[0].x);
  }
  std::ranges::sort(places);
  CHECK(places == std::vector<double>{10.0, 25.0});
  // A fold that ends there shows it.
  PieceDrawing folded = piece;
  folded.group.lines.push_back({Layer::mountain, {{10, 0}, {10, 50}}, false, export_::Fold::mountain});
  CHECK(ticks_of(folded).size() == 1);
}

TEST_CASE("long edges are divided alike from both ends", "[seam_marks]") {
  const PieceDrawing piece = piece_of({{0, 0}, {110, 0}, {110, 50}, {0, 50}}, {1, 2, 3, 4});
  std::vector<double> below;
  std::vector<double> above;
  for (const export_::Line& tick : ticks_of(piece)) {
    (tick.points[0].y < 25.0 ? below : above).push_back(tick.points[0].x);
  }
  REQUIRE(below.size() == 2);
  REQUIRE(above.size() == 2);
  for (const double x : below) {
    CHECK(std::ranges::any_of(above, [&](double other) { return std::abs(x + other - 110.0) < 1e-9; }));
  }
}

TEST_CASE("a longer tick parts two chains where no sharp corner does", "[seam_marks]") {
  // The outline bends by 30 degrees between chain 1, of two edges, and chain 2; folds end where they meet.
  const Vec2 bend{20.0 + 20.0 * std::cos(0.5), 20.0 * std::sin(0.5)};
  PieceDrawing piece = piece_of({{0, 0}, {10, 0}, {20, 0}, bend, {0, 50}}, {1, 1, 2, 3, 4});
  piece.group.lines.push_back({Layer::valley, {{20, 0}, {15, 30}}, false, export_::Fold::valley});
  const auto longer = [](const PieceDrawing& drawn) {
    std::vector<export_::Line> ticks = ticks_of(drawn);
    std::erase_if(ticks,
                  [](const export_::Line& tick) { return length(tick.points[1] - tick.points[0]) < 1.5; });
    return ticks;
  };
  REQUIRE(longer(piece).size() == 1);
  const export_::Line tick = longer(piece).front();
  CHECK(length(tick.points[0] - Vec2{20, 0}) < 1e-9);
  CHECK(length(tick.points[1] - tick.points[0]) == Approx(2.0));
  // In the middle of the wider angle that the fold leaves.
  const Vec2 way = tick.points[1] - tick.points[0];
  CHECK(std::atan2(way.y, way.x) > 0.5);
  CHECK(std::abs(std::atan2(30.0, -5.0) - std::atan2(way.y, way.x)) > 0.5);
  // Chains of one edge each have their numbers at the edges that meet there.
  CHECK(longer(piece_of({{0, 0}, {20, 0}, bend, {0, 50}}, {1, 2, 3, 4})).empty());
}

TEST_CASE("a chain that closes shows where it begins", "[seam_marks]") {
  std::vector<Vec2> corners;
  for (int i = 0; i < 12; ++i) {
    corners.push_back({10.0 * std::cos(i * 0.5235987755982988), 10.0 * std::sin(i * 0.5235987755982988)});
  }
  const std::vector<export_::Line> ticks = ticks_of(piece_of(corners, std::vector<std::uint32_t>(12, 1)));
  REQUIRE(ticks.size() == 1);
  CHECK(length(ticks[0].points[0] - corners[0]) < 1e-9);
  CHECK(length(ticks[0].points[1]) == Approx(8.0));  // towards the middle
}
