// SPDX-License-Identifier: GPL-3.0-or-later
// The order in which a piece is folded: complete, possible, and free of what is in its own way.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/vector.hpp"
#include "support/temporary_folder.hpp"
#include "verify/support.hpp"

using namespace ridgecraft;
using Json = nlohmann::json;

namespace {

constexpr int order_promise = 7;
constexpr const char* key = "ridgecraft:fold_order";

/// Sheets bent along parallel lines, next to each other: a seam as cans have it, in which each edge is bent
/// back into the other, so that no crease is free; one that winds inwards, which has to be folded crease by
/// crease from one of its ends; and one bent twice.
std::string bent_sheets() {
  const std::vector<std::vector<Vec2>> profiles{{{40, 103},
                                                 {70, 103},
                                                 {70, 100},
                                                 {0, 100},
                                                 {0, 0},
                                                 {100, 0},
                                                 {100, 104.5},
                                                 {38, 104.5},
                                                 {38, 101.5},
                                                 {67, 101.5}},
                                                {{0.0, 0.0},
                                                 {10.6, 0.0},
                                                 {6.6, -20.3},
                                                 {-15.0, 4.2},
                                                 {-2.7, 17.0},
                                                 {27.5, -11.2},
                                                 {10.9, -25.8},
                                                 {13.3, 0.4}},
                                                {{0, 0}, {40, 0}, {40, 30}, {60, 30}}};
  std::string obj;
  int first = 1;
  double shift = 0.0;
  for (const std::vector<Vec2>& profile : profiles) {
    for (const Vec2 p : profile) {
      obj += fmt::format("v {} {} 0\nv {} {} 30\n", p.x + shift, p.y, p.x + shift, p.y);
    }
    for (std::size_t i = 0; i + 1 < profile.size(); ++i, first += 2) {
      obj += fmt::format("f {} {} {} {}\n", first, first + 2, first + 3, first + 1);
    }
    first += 2;
    shift += 150.0;
  }
  return obj;
}

const Json& sheets() {
  static const Json json = [] {
    const test::TemporaryFolder folder;
    test::write_bytes(folder / "sheets.obj", bent_sheets());
    return Json::parse(
        test::WrittenJob(folder / "sheets.obj", {"--scale", "1", "--unit", "mm", "--faces", "keep",
                                                 "--concavity", "2", "--paper", "A2", "--pieces", "few"})
            .fold);
  }();
  return json;
}

/// The piece with so many creases. That of the seam has 8, that which is wound 6, the third 2, folded at
/// once.
std::size_t piece_with(std::size_t creases) {
  const Json& order = sheets().at(key);
  const auto count = [](const Json& steps) {
    std::size_t edges = 0;
    for (const Json& step : steps) {
      edges += step.size();
    }
    return edges;
  };
  return static_cast<std::size_t>(
      std::find_if(order.begin(), order.end(), [&](const Json& steps) { return count(steps) == creases; }) -
      order.begin());
}
std::size_t slow_piece() {
  return piece_with(6);
}
std::size_t quick_piece() {
  return piece_with(2);
}

void check_order_found(const std::string& words, const std::function<void(Json&)>& break_order) {
  Json json = sheets();
  break_order(json[key]);
  const verify::Report report = test::verify_json(json);
  INFO(words << ": " << test::first_fault(report));
  CHECK(test::broken(report) == std::vector<int>{order_promise});
  CHECK(test::first_fault(report).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("the program's fold orders are sound", "[fold_order]") {
  const verify::Report report = verify::verify(sheets().dump(), {.folding = true}, {});
  INFO(test::first_fault(report));
  CHECK(report.sound());
  REQUIRE(report.folding.has_value());
  CHECK(report.folding->not_tried == 0);
  CHECK(report.folding->with_care.size() == 1);
  CHECK(sheets().at(key).at(slow_piece()).size() == 6);
  CHECK(sheets().at(key).at(piece_with(8)).size() == 8);
  CHECK(sheets().at(key).at(quick_piece()).size() == 1);
}

TEST_CASE("a fold order that isn't one of the folds is found", "[fold_order]") {
  const std::size_t slow = slow_piece();
  const std::size_t quick = quick_piece();
  check_order_found("lacks the fold", [&](Json& order) { order[quick][0].erase(0); });
  check_order_found("lacks the fold", [&](Json& order) { order[slow].erase(3); });
  check_order_found("twice", [&](Json& order) { order[quick][0].push_back(order[quick][0][0]); });
  check_order_found("which is no fold", [&](Json& order) {
    const Json& kinds = sheets().at("edges_assignment");
    order[quick][0].push_back(std::find(kinds.begin(), kinds.end(), "B") - kinds.begin());
  });
  check_order_found("which stays flat", [&](Json& order) {
    const Json& kinds = sheets().at("edges_assignment");
    const Json& pieces = sheets().at("ridgecraft:faces_piece");
    const Json& faces = sheets().at("faces_vertices");
    // A flat fold between two faces of the piece.
    for (std::size_t e = 0; e < kinds.size(); ++e) {
      const Json& ends = sheets().at("edges_vertices")[e];
      for (std::size_t f = 0; kinds[e] == "F" && f < faces.size(); ++f) {
        const bool has_both = std::count(faces[f].begin(), faces[f].end(), ends[0]) == 1 &&
                              std::count(faces[f].begin(), faces[f].end(), ends[1]) == 1;
        if (pieces[f] == quick && has_both) {
          order[quick][0].push_back(e);
          return;
        }
      }
    }
    FAIL("no flat fold in the piece");
  });
  check_order_found("names edge", [&](Json& order) { std::swap(order[quick], order[slow]); });
}

TEST_CASE("a fold order that paper can't follow is found", "[fold_order]") {
  const std::size_t slow = slow_piece();
  check_order_found("several creases in one of many steps", [&](Json& order) {
    const Json moved = order[slow][1][0];
    order[slow].erase(1);
    order[slow][0].push_back(moved);
  });
}

TEST_CASE("pieces that don't fold together are no answer to the wish that all do", "[fold_order]") {
  Json json = sheets();
  json["ridgecraft:settings"]["fold_linear"] = true;
  const verify::Report report = test::verify_json(json);
  CHECK(test::broken(report) == std::vector<int>{order_promise});
  CHECK(test::first_fault(report).find("where the settings ask for all creases together") !=
        std::string::npos);
  // An edge that was to be kept can't be cut for it.
  json["ridgecraft:settings"]["keep"] = "0123456789abcdef";
  CHECK(test::broken(json).empty());
}

TEST_CASE("folds of one crease are made together", "[fold_order]") {
  // Two flat faces next to two others, hinged along one line that has two edges.
  Json json = test::cube_file();
  Json order = Json::array({Json::array()});
  for (std::size_t e = 0; e < json["edges_assignment"].size(); ++e) {
    if (json["edges_assignment"][e] == "M") {
      order[0].push_back(Json::array({e}));
    }
  }
  json[key] = order;
  CHECK(test::broken(json).empty());
  json[key][0].erase(0);
  CHECK(test::broken(json) == std::vector<int>{order_promise});
}

TEST_CASE("a fold order in a wrong form is no fold order", "[fold_order]") {
  for (const Json& bad :
       {Json(3), Json(nullptr), Json::array(), Json::array({3}), Json::array({Json::array({3})}),
        Json::array({Json::array({Json::array()})}), Json::array({Json::array({Json::array({1000})})}),
        Json::array({Json::array({Json::array({"a"})})})}) {
    Json json = test::cube_file();
    json[key] = bad;
    INFO(bad.dump());
    CHECK(test::broken(json) == std::vector<int>{0});
  }
  // Whoever doesn't know an order need not tell one; this program does.
  Json json = sheets();
  json.erase(key);
  CHECK(test::broken(json) == std::vector<int>{8});
}

TEST_CASE("a piece that runs through itself on the way is found", "[fold_order]") {
  const verify::Report sound = verify::verify(sheets().dump(), {.folding = true}, {});
  REQUIRE_FALSE(sound.folding->with_care.empty());
  Json json = sheets();
  // All at a time would have been chosen if it worked.
  Json& steps = json[key][slow_piece()];
  Json all = Json::array();
  for (const Json& step : steps) {
    all.insert(all.end(), step.begin(), step.end());
  }
  steps = Json::array({all});
  const verify::Report report = verify::verify(json.dump(), {.folding = true}, {});
  INFO(test::first_fault(report));
  CHECK(test::broken(report) == std::vector<int>{order_promise});
  CHECK(test::first_fault(report).find("runs through itself") != std::string::npos);
  // Where motion isn't asked for, nothing is said about it.
  CHECK(test::broken(json).empty());
  CHECK_FALSE(test::verify_json(json).folding.has_value());
}
