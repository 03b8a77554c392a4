// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces that hang together by a thread are counted, and no others.
#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "base/random.hpp"
#include "verify/cube_file.hpp"

using namespace ridgecraft;
using Polygon = std::vector<Vec2>;

namespace {

std::size_t thin_necks(const nlohmann::json& json) {
  const verify::Report report = test::verify_json(json);
  REQUIRE(report.figures.has_value());
  return report.figures->thin_necks;
}

std::size_t thin_necks(Polygon polygon) {
  return thin_necks(test::loose_file({std::move(polygon)}));
}

/// Two squares of this size, joined by a bar of this width and length at some height of theirs.
Polygon dumbbell(double size, double width, double length, double height) {
  return {{0, 0},
          {size, 0},
          {size, height},
          {size + length, height},
          {size + length, 0},
          {2 * size + length, 0},
          {2 * size + length, size},
          {size + length, size},
          {size + length, height + width},
          {size, height + width},
          {size, size},
          {0, size}};
}

Polygon turned(Polygon polygon, double angle) {
  for (Vec2& p : polygon) {
    p = {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
  }
  return polygon;
}

/// Two squares of 10 mm, one above the other, with a fold between them that is so long.
nlohmann::json folded_squares(double fold) {
  const Polygon lower{{0, 0}, {10, 0}, {10, 10}, {10 - fold, 10}, {0, 10}};
  const Polygon upper{{10 - fold, 10}, {10, 10}, {20, 10}, {20, 20}, {10 - fold, 20}};
  nlohmann::json json = test::loose_file({lower, upper});
  const std::vector<int> merged{0, 1, 2, 3, 4, 3, 2, 5, 6, 7};
  const auto remaining = [](nlohmann::json& points) {
    points.erase(5);
    points.erase(5);
    for (nlohmann::json& p : points) {
      if (p.size() == 3) {
        p[2] = 0.0;
      }
    }
  };
  remaining(json["vertices_coords"]);
  remaining(json["file_frames"][0]["vertices_coords"]);
  for (nlohmann::json* faces : {&json["faces_vertices"], &json["file_frames"][0]["faces_vertices"]}) {
    for (nlohmann::json& face : *faces) {
      for (nlohmann::json& v : face) {
        v = merged[v.get<std::size_t>()];
      }
    }
  }
  for (nlohmann::json& edge : json["edges_vertices"]) {
    for (nlohmann::json& v : edge) {
      v = merged[v.get<std::size_t>()];
    }
  }
  for (const char* key : {"edges_vertices", "edges_assignment", "edges_foldAngle"}) {
    json[key].erase(5);
  }
  json["edges_assignment"][2] = "F";
  json["ridgecraft:faces_piece"] = {0, 0};
  json["ridgecraft:pieces"].erase(1);
  return json;
}

}  // namespace

TEST_CASE("a thread between two stretches of paper is found, however it lies", "[verify]") {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    const double size = 5.5 + 20.0 * random.unit();
    const double width = 0.02 + 1.96 * random.unit();
    const double length = 0.1 + 30.0 * random.unit();
    const double height = (size - width) * random.unit();
    CAPTURE(size, width, length, height);
    CHECK(thin_necks(turned(dumbbell(size, width, length, height), 6.3 * random.unit())) ==
          (width < 1.0 ? 1U : 0U));
  }
}

TEST_CASE("what holds little, or is a gap, is no thread", "[verify]") {
  CHECK(thin_necks(test::cube_file()) == 0);
  CHECK(thin_necks(dumbbell(4.9, 0.5, 2.0, 1.0)) == 0);
  CHECK(thin_necks(dumbbell(5.1, 0.5, 2.0, 1.0)) == 1);
  // A slit into a square, from its border and from a corner; a tip.
  CHECK(thin_necks(Polygon{{0, 0}, {20, 0}, {20, 9.8}, {5, 10}, {20, 10.2}, {20, 20}, {0, 20}}) == 0);
  CHECK(thin_necks(Polygon{{0, 0}, {20, 0}, {20, 9.8}, {0.5, 10}, {20, 10.2}, {20, 20}, {0, 20}}) == 1);
  CHECK(thin_necks(Polygon{{0, 0}, {40, 0}, {0, 1.0}}) == 0);
  // Flaps at the two ends of a needle, one on either side; side by side they share a wide fold line.
  CHECK(thin_necks(Polygon{{0, 0},
                           {0, -20},
                           {10, -20},
                           {10, 0},
                           {75, 0},
                           {86, 0},
                           {86, 30},
                           {75, 30},
                           {75, 0.02},
                           {0, 0.02}}) == 1);
  CHECK(thin_necks(Polygon{{0, 0}, {0, -20}, {10, -20}, {10, 0}, {11, 0}, {11, 0.02}, {10, 30}, {0, 30}}) ==
        0);
}

TEST_CASE("a short fold is a thread", "[verify]") {
  for (const double fold : {0.3, 0.9, 1.1, 6.0}) {
    CAPTURE(fold);
    const nlohmann::json json = folded_squares(fold);
    CHECK(test::broken(json).empty());
    CHECK(thin_necks(json) == (fold < 1.0 ? 1U : 0U));
  }
}

TEST_CASE("the net of a cube with one corner moved is broken and hangs by a thread", "[verify]") {
  nlohmann::json json = test::cube_file();
  CHECK(thin_necks(json) == 0);
  // The corner that the cross's lower arm shares with its side comes near the arm's other side.
  json["vertices_coords"][2] = json["vertices_coords"][3];
  json["vertices_coords"][2][0] = json["vertices_coords"][2][0].get<double>() - 0.4;
  CHECK(thin_necks(json) == 1);
}
