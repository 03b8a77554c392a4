// SPDX-License-Identifier: GPL-3.0-or-later
// The order in which a piece is folded: complete, possible, and free of what is in its own way.
#include <algorithm>
#include <functional>

#include <catch2/catch.hpp>

#include "verify/cube_file.hpp"
#include "verify/written_job.hpp"

using namespace ridgecraft;
using Json = nlohmann::json;

namespace {

constexpr int order_promise = 7;
constexpr const char* key = "ridgecraft:fold_order";

/// The lighthouse has pieces that are folded all at a time, and one that is folded crease by crease.
const Json& lighthouse() {
  static const test::WrittenJob job(test::sample("lighthouse.obj"));
  static const Json json = Json::parse(job.fold);
  return json;
}

/// The piece with the most steps.
std::size_t slow_piece(const Json& json) {
  const Json& order = json.at(key);
  return static_cast<std::size_t>(
      std::max_element(order.begin(), order.end(),
                       [](const Json& a, const Json& b) { return a.size() < b.size(); }) -
      order.begin());
}

void check_found(const std::string& words, const std::function<void(Json&)>& break_order) {
  Json json = lighthouse();
  break_order(json[key]);
  const verify::Report report = test::verify_json(json);
  INFO(words << ": " << test::first_fault(report));
  CHECK(test::broken(report) == std::vector<int>{order_promise});
  CHECK(test::first_fault(report).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("the program's fold orders are sound", "[fold_order]") {
  const verify::Report report = verify::verify(lighthouse().dump(), {.folding = true}, {});
  INFO(test::first_fault(report));
  CHECK(report.sound());
  REQUIRE(report.folding.has_value());
  CHECK(report.folding->not_tried == 0);
  CHECK(lighthouse().at(key).at(slow_piece(lighthouse())).size() > 10);
}

TEST_CASE("a fold order that isn't one of the folds is found", "[fold_order]") {
  const std::size_t slow = slow_piece(lighthouse());
  check_found("lacks the fold", [](Json& order) { order[0][0].erase(0); });
  check_found("lacks the fold", [&](Json& order) { order[slow].erase(3); });
  check_found("twice", [](Json& order) { order[0][0].push_back(order[0][0][0]); });
  check_found("which is no fold", [](Json& order) {
    const Json& kinds = lighthouse().at("edges_assignment");
    order[0][0].push_back(std::find(kinds.begin(), kinds.end(), "B") - kinds.begin());
  });
  check_found("which stays flat", [](Json& order) {
    const Json& kinds = lighthouse().at("edges_assignment");
    const Json& pieces = lighthouse().at("ridgecraft:faces_piece");
    const Json& faces = lighthouse().at("faces_vertices");
    // A flat fold between two faces of the first piece.
    for (std::size_t e = 0; e < kinds.size(); ++e) {
      const Json& ends = lighthouse().at("edges_vertices")[e];
      for (std::size_t f = 0; kinds[e] == "F" && f < faces.size(); ++f) {
        const bool has_both = std::count(faces[f].begin(), faces[f].end(), ends[0]) == 1 &&
                              std::count(faces[f].begin(), faces[f].end(), ends[1]) == 1;
        if (pieces[f] == 0 && has_both) {
          order[0][0].push_back(e);
          return;
        }
      }
    }
    FAIL("no flat fold in the first piece");
  });
  check_found("names edge", [&](Json& order) { std::swap(order[0], order[slow == 0 ? 1 : slow]); });
}

TEST_CASE("a fold order that paper can't follow is found", "[fold_order]") {
  const std::size_t slow = slow_piece(lighthouse());
  check_found("neither from the middle outwards nor from the tips inwards",
              [&](Json& order) { std::swap(order[slow].front(), order[slow].back()); });
  check_found("several creases in one of many steps", [&](Json& order) {
    const Json moved = order[slow][1][0];
    order[slow].erase(1);
    order[slow][0].push_back(moved);
  });
}

TEST_CASE("folds of one crease are made together", "[fold_order]") {
  // Two flat faces beside two others, hinged along one line that has two edges.
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
  Json json = lighthouse();
  json.erase(key);
  CHECK(test::broken(json) == std::vector<int>{8});
}

TEST_CASE("a piece that runs through itself on the way is found", "[fold_order]") {
  const verify::Report sound = verify::verify(lighthouse().dump(), {.folding = true}, {});
  REQUIRE_FALSE(sound.folding->with_care.empty());
  Json json = lighthouse();
  // All at a time would have been chosen if it worked.
  Json& steps = json[key][slow_piece(json)];
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
