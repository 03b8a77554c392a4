// SPDX-License-Identifier: GPL-3.0-or-later
// One thing broken at a time in a clean net of a cube: the promise that it breaks is named, and no other.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/random.hpp"
#include "cli/report/summary.hpp"
#include "verify/support.hpp"

using namespace ridgecraft;
using test::broken;
using test::cube_file;
using test::loose_file;
using test::verify_json;
using Json = nlohmann::json;
using Promises = std::vector<int>;
using Polygon = std::vector<Vec2>;

namespace {

/// Points of the plane, moved by `move`, tabs included.
template <typename Move>
void move_plane(Json& json, const Move& move) {
  const auto apply = [&move](Json& p) {
    const Vec2 moved = move(Vec2{p[0], p[1]});
    p = {moved.x, moved.y};
  };
  for (Json& p : json["vertices_coords"]) {
    apply(p);
  }
  for (Json& tab : json["ridgecraft:tabs"]) {
    for (Json& p : tab["polygon"]) {
      apply(p);
    }
  }
}

/// Two strips of this width, 50 mm long, that are joined along their length.
Json two_strips(double width) {
  Json json = loose_file(
      {{{0, 0}, {50, 0}, {50, width}, {0, width}}, {{0, 20}, {50, 20}, {50, 20 + width}, {0, 20 + width}}});
  json["file_frames"][0]["vertices_coords"] = {{0, 0, 0},     {50, 0, 0},         {50, width, 0},
                                               {0, width, 0}, {50, 2 * width, 0}, {0, 2 * width, 0}};
  json["file_frames"][0]["faces_vertices"] = {{0, 1, 2, 3}, {3, 2, 4, 5}};
  json["ridgecraft:joins"] = {{{"number", 1}, {"edges", {2, 4}}, {"tab", nullptr}, {"why", "no room"}}};
  return json;
}

}  // namespace

TEST_CASE("a clean cube has no faults and the figures that one counts by hand", "[verify]") {
  const verify::Report report = verify_json(cube_file());
  INFO((report.faults.empty() ? std::string() : report.faults.front().message));
  REQUIRE(report.sound());
  REQUIRE(report.figures.has_value());
  const verify::Figures& figures = *report.figures;
  CHECK(figures.faces == 6);
  CHECK(figures.pieces == 1);
  CHECK(figures.pages == 1);
  CHECK(figures.joins == 7);
  CHECK(figures.tabs == 7);
  CHECK(figures.joins_without_tab == 0);
  CHECK(figures.overlaps + figures.tab_overlaps + figures.bad_joins + figures.outside_page == 0);
  CHECK(figures.max_refold_error_mm < 1e-9);
  CHECK(figures.max_fold_error_deg < 1e-9);
  // 14 cut edges; each tab replaces its base by three sides, 28 mm and two slants of 6 mm at 45 degrees.
  CHECK(figures.cut_mm == Approx(7 * 40 + 7 * (28 + 12 * std::sqrt(2.0))));
  CHECK(figures.fold_mm == Approx(5 * 40 + 7 * 40));
  CHECK(figures.unlined_fold_mm == 0.0);
}

TEST_CASE("a turned and shifted net on a page without bounds stays clean", "[verify]") {
  Json json = cube_file();
  json["ridgecraft:pages"] = {{{"origin", {0, 0}}, {"size", nullptr}}};
  const double angle = 0.7;
  move_plane(json, [angle](Vec2 p) {
    return Vec2{std::cos(angle) * p.x - std::sin(angle) * p.y + 300.0,
                std::sin(angle) * p.x + std::cos(angle) * p.y};
  });
  const verify::Report report = verify_json(json);
  INFO((report.faults.empty() ? std::string() : report.faults.front().message));
  CHECK(report.sound());
  CHECK(report.figures->max_penetration_mm < 1e-9);
}

TEST_CASE("pieces that no knife cuts out are counted where they might hang on another", "[verify]") {
  CHECK(verify_json(cube_file()).figures->narrow_pieces == 0);
  CHECK(verify_json(loose_file({{{0, 0}, {50, 0}, {50, 0.9}}})).figures->narrow_pieces == 0);
  const verify::Report folded = verify_json(two_strips(0.9));
  REQUIRE(folded.figures.has_value());
  CHECK(folded.figures->narrow_pieces == 2);
  CHECK(verify_json(two_strips(1.1)).figures->narrow_pieces == 0);
}

TEST_CASE("promise 1: lengths", "[verify]") {
  SECTION("a model that is a thousandth larger") {
    Json json = cube_file();
    for (Json& p : json["file_frames"][0]["vertices_coords"]) {
      for (Json& x : p) {
        x = 1.001 * x.get<double>();
      }
    }
    CHECK(broken(json) == Promises{1, 6});
    CHECK(verify_json(json).figures->max_length_error_mm == Approx(0.04 * std::sqrt(2.0)));
  }
  SECTION("a mirrored net") {
    Json json = cube_file();
    move_plane(json, [](Vec2 p) { return Vec2{200.0 - p.x, p.y}; });
    const Promises got = broken(json);
    CHECK(std::count(got.begin(), got.end(), 1) == 1);
  }
}

TEST_CASE("promise 2: overlap", "[verify]") {
  const std::vector<Vec2> triangle = {{0, 0}, {30, 0}, {0, 30}};
  const auto shifted = [&triangle](Vec2 by) {
    std::vector<Vec2> result = triangle;
    for (Vec2& p : result) {
      p += by;
    }
    return result;
  };
  SECTION("the tolerance is a thousandth of a millimetre") {
    CHECK(broken(test::loose_file({triangle, shifted({30 - 0.0009, 0})})).empty());
    const std::vector<Vec2> left = {{-30, 0}, {0, 0}, {0, 30}, {-30, 30}};
    for (const double depth : {0.0, 0.0009, 0.0011, 0.5}) {
      std::vector<Vec2> right = triangle;
      for (Vec2& p : right) {
        p.x -= depth;
      }
      const verify::Report report = verify_json(test::loose_file({left, right}));
      CHECK(broken(report) == (depth > 0.001 ? Promises{2} : Promises{}));
      CHECK(report.figures->max_penetration_mm == Approx(depth).margin(1e-12));
    }
  }
  SECTION("every pair of a heap is counted, and listed up to the limit") {
    const Json heap = test::loose_file(std::vector<std::vector<Vec2>>(100, triangle));
    const verify::Report report = verify::verify(heap.dump(), {.max_faults = 10}, {});
    CHECK(report.figures->overlaps == 4950);
    CHECK(report.faults.size() == 10);
    CHECK(report.faults_not_listed[2] == 4940);
    CHECK(Json::parse(cli::summary("nets.fold", report).json()).at("faults_not_listed") == Json{{"2", 4940}});
  }
  SECTION("a field of thousands of faces side by side is clean") {
    std::vector<std::vector<Vec2>> field;
    for (int i = 0; i < 100; ++i) {
      for (int j = 0; j < 50; ++j) {
        field.push_back(shifted({30.0 * i, 30.0 * j}));
      }
    }
    const verify::Report report = verify_json(test::loose_file(field));
    CHECK(report.sound());
    CHECK(report.figures->faces == 5000);
  }
  SECTION("a tab over a face of its own piece") {
    Json json = cube_file();
    const Json face = json["faces_vertices"][0];
    Json polygon = Json::array();
    for (const Json& v : face) {
      polygon.push_back(json["vertices_coords"][v.get<std::size_t>()]);
    }
    json["ridgecraft:tabs"][0]["polygon"] = polygon;
    CHECK(broken(json) == Promises{2, 5});
    CHECK(verify_json(json).figures->tab_overlaps >= 1);
  }
}

TEST_CASE("promise 3: coverage", "[verify]") {
  Json json = cube_file();
  SECTION("a face is another one's model face") {
    json["ridgecraft:faces_model"][3] = 1;
    const Promises got = broken(json);
    CHECK(std::count(got.begin(), got.end(), 3) == 1);
    CHECK(verify_json(json).figures->missing_faces == 1);
    CHECK(verify_json(json).figures->double_faces == 1);
  }
  SECTION("a piece without faces") {
    Json piece = json["ridgecraft:pieces"][0];
    piece["name"] = "B";
    json["ridgecraft:pieces"].push_back(piece);
    CHECK(broken(json) == Promises{3});
  }
  SECTION("wrong parts") {
    json["ridgecraft:pieces"][0]["parts"] = {0, 0};
    CHECK(broken(json) == Promises{3});
  }
  SECTION("a part where the piece spans two") {
    json["file_frames"][0]["ridgecraft:faces_part"][2] = 7;
    json["ridgecraft:pieces"][0]["parts"] = {7, 0};
    CHECK(broken(json) == Promises{3});
    json["ridgecraft:pieces"][0]["part"] = nullptr;
    CHECK(broken(json).empty());
  }
}

TEST_CASE("promise 4: pages", "[verify]") {
  Json json = cube_file();
  SECTION("out to the left by two thousandths, and by half of one") {
    // The leftmost tab reaches 14 mm, so the margin there may be as large.
    json["ridgecraft:pages"][0]["margins"] = {14.0005, 10, 10, 10};
    const bool tab_on_the_left = verify_json(json).sound();
    json["ridgecraft:pages"][0]["margins"] = {20.002, 10, 10, 10};
    CHECK(tab_on_the_left);
    CHECK(broken(json) == Promises{4});
  }
  SECTION("pages on each other") {
    json["ridgecraft:pages"].push_back(
        {{"origin", {209.99, 0}}, {"size", {210, 297}}, {"margins", {0, 0, 0, 0}}});
    CHECK(broken(json) == Promises{4});
    json["ridgecraft:pages"][1]["origin"] = {210, 0};
    CHECK(broken(json).empty());
  }
}

TEST_CASE("promise 5: folds, joins, tabs", "[verify]") {
  Json json = cube_file();
  const auto fold = static_cast<std::size_t>(
      std::find(json["edges_assignment"].begin(), json["edges_assignment"].end(), "M") -
      json["edges_assignment"].begin());
  SECTION("an angle two hundredths of a degree off") {
    json["edges_foldAngle"][fold] = -90.02;
    CHECK(broken(json) == Promises{5, 6});
    CHECK(verify_json(json).figures->max_fold_error_deg == Approx(0.02));
  }
  SECTION("a mountain called valley") {
    json["edges_assignment"][fold] = "V";
    CHECK(broken(json) == Promises{5});
  }
  SECTION("a cut with an angle") {
    json["edges_assignment"][fold] = "B";
    const Promises got = broken(json);
    CHECK(std::count(got.begin(), got.end(), 5) == 1);
  }
  SECTION("a join is missing, and its tab goes with it") {
    json["ridgecraft:joins"].erase(json["ridgecraft:joins"].size() - 1);
    json["ridgecraft:tabs"].erase(json["ridgecraft:tabs"].size() - 1);
    CHECK(broken(json) == Promises{5});
    CHECK(verify_json(json).figures->bad_joins == 1);
  }
  SECTION("a join without tab has to say why") {
    json["ridgecraft:joins"][6]["tab"] = nullptr;
    json["ridgecraft:tabs"].erase(6);
    CHECK(broken(json) == Promises{5});
    json["ridgecraft:joins"][6]["why"] = "no room";
    CHECK(broken(json).empty());
    CHECK(verify_json(json).figures->joins_without_tab == 1);
  }
  SECTION("a join with a tab says why it has none") {
    json["ridgecraft:joins"][6]["why"] = "no room";
    CHECK(broken(json) == Promises{5});
  }
  SECTION("two joins exchange their partners") {
    std::swap(json["ridgecraft:joins"][0]["edges"][1], json["ridgecraft:joins"][1]["edges"][1]);
    CHECK(broken(json) == Promises{5});
  }
  SECTION("a tab with another number") {
    json["ridgecraft:tabs"][2]["joins"] = {99};
    CHECK(broken(json) == Promises{5});
  }
  SECTION("holes that aren't there") {
    json["ridgecraft:pieces"][0]["holes"] = 1;
    CHECK(broken(json) == Promises{5});
  }
}

TEST_CASE("promise 6: small errors of angles add up", "[verify]") {
  Json json = cube_file();
  for (Json& angle : json["edges_foldAngle"]) {
    if (angle != 0.0) {
      angle = -90.009;
    }
  }
  CHECK(broken(json) == Promises{6});
}

TEST_CASE("messages name the piece, and faults carry their indices", "[verify]") {
  Json json = cube_file();
  json["ridgecraft:pieces"][0]["name"] = "left \x1b[31m\"ear\"";
  json["ridgecraft:pieces"][0]["holes"] = 3;
  const verify::Report report = verify_json(json);
  REQUIRE(report.faults.size() == 1);
  CHECK(report.faults[0].message == "piece \"left ?[31m\"ear\"\" has 0 holes and states 3");
  const Json written = Json::parse(cli::summary("nets.fold", report).json());
  CHECK(written.at("faults").at(0).at("piece") == 0);
  CHECK(written.at("faults").at(0).at("promise") == 5);
}

TEST_CASE("a check that is stopped says so", "[verify]") {
  StopSource source;
  source.request_stop();
  Context context;
  context.stop = source.get_token();
  CHECK_THROWS_AS(verify::verify(cube_file().dump(), {}, context), Error);
}

TEST_CASE("promise 5: a tab hangs on 2 mm of paper", "[verify]") {
  // The cube is made so small that the arms of its cross are 1.6 mm wide.
  Json json = cube_file();
  const auto shrink = [](Json& p) {
    for (Json& x : p) {
      x = 0.04 * x.get<double>();
    }
  };
  for (Json& p : json["vertices_coords"]) {
    shrink(p);
  }
  for (Json& tab : json["ridgecraft:tabs"]) {
    for (Json& p : tab["polygon"]) {
      shrink(p);
    }
  }
  for (Json& p : json["file_frames"][0]["vertices_coords"]) {
    shrink(p);
  }
  const verify::Report report = verify_json(json);
  const auto hangs = [](const verify::Fault& fault) {
    return fault.message.find("hangs on less than 2 mm of paper") != std::string::npos;
  };
  CHECK(std::any_of(report.faults.begin(), report.faults.end(), hangs));
  const verify::Report sound = verify_json(cube_file());
  CHECK(std::none_of(sound.faults.begin(), sound.faults.end(), hangs));
}

// Slits that tabs are put through: what can't be cut or put together is found.

namespace {

const test::WrittenJob& slotted_house() {
  static const test::WrittenJob job(test::sample("house.obj"), {"--tabs", "slots"});
  return job;
}

/// The file with a change of the slits of all tabs: each becomes what is made of its two ends.
Json with_slits(const std::function<std::vector<Vec2>(Vec2, Vec2)>& changed) {
  Json json = Json::parse(slotted_house().fold);
  for (const char* const list : {"ridgecraft:tabs", "ridgecraft:more_tabs"}) {
    if (!json.contains(list)) {
      continue;
    }
    for (Json& tab : json[list]) {
      if (tab.contains("slit")) {
        const auto end = [&](std::size_t k) {
          return Vec2{tab["slit"][k][0].get<double>(), tab["slit"][k][1].get<double>()};
        };
        Json slit = Json::array();
        for (const Vec2 p : changed(end(0), end(1))) {
          slit.push_back({p.x, p.y});
        }
        tab["slit"] = slit;
      }
    }
  }
  return json;
}

bool tells(const Json& json, const std::string& words) {
  const verify::Report report = test::verify_json(json);
  INFO(test::first_fault(report));
  return std::any_of(report.faults.begin(), report.faults.end(), [&](const verify::Fault& fault) {
    return fault.message.find(words) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("slits that the program makes are sound, and printed", "[slits]") {
  const Json json = with_slits([](Vec2 a, Vec2 b) { return std::vector<Vec2>{a, b}; });
  CHECK(std::ranges::count_if(json["ridgecraft:tabs"], [](const Json& tab) { return tab.contains("slit"); }) >
        5);
  for (const bool of_pdf : {false, true}) {
    const verify::Report report = test::verify_pages(slotted_house().fold, slotted_house().pages(of_pdf));
    INFO(test::first_fault(report));
    CHECK(report.sound());
  }
  // Without one of them the pages have a cut too many.
  Json less = json;
  for (Json& tab : less["ridgecraft:tabs"]) {
    if (tab.contains("slit")) {
      tab.erase("slit");
      break;
    }
  }
  CHECK_FALSE(test::verify_pages(less.dump(), slotted_house().pages(true)).sound());
}

TEST_CASE("slits that can't be cut or don't fit their tabs are faults", "[slits]") {
  const auto along = [](Vec2 a, Vec2 b) { return (b - a) / length(b - a); };
  using Ends = std::vector<Vec2>;
  // To the edge, or away from it, whichever way the slit runs.
  const auto moved = [&](double mm) {
    return with_slits([&](Vec2 a, Vec2 b) {
      return Ends{a + mm * perpendicular(along(a, b)), b + mm * perpendicular(along(a, b))};
    });
  };
  CHECK((tells(moved(1.0), "from a cut or a fold") || tells(moved(-1.0), "from a cut or a fold")));
  CHECK(tells(with_slits([](Vec2 a, Vec2 b) {
                return Ends{0.7 * a + 0.3 * b, 0.3 * a + 0.7 * b};
              }),
              "doesn't let through"));
  CHECK(tells(with_slits([&](Vec2 a, Vec2 b) {
                return Ends{a - 4.0 * along(a, b), b + 4.0 * along(a, b)};
              }),
              "doesn't hold"));
  CHECK(tells(with_slits([](Vec2 a, Vec2 b) {
                const Vec2 middle = 0.5 * (a + b);
                return Ends{middle + perpendicular(a - middle), middle + perpendicular(b - middle)};
              }),
              "isn't along its edge"));
  CHECK(tells(with_slits([](Vec2 a, Vec2 b) {
                return Ends{a + Vec2{500, 0}, b + Vec2{500, 0}};
              }),
              "outside its piece"));
  CHECK(tells(with_slits([](Vec2 a, Vec2 /*b*/) { return Ends{a}; }), "slit has 1 entries, not 2"));
  Json convex = Json::parse(slotted_house().fold);
  for (Json& tab : convex["ridgecraft:tabs"]) {
    tab.erase("slit");
  }
  CHECK(tells(convex, "isn't convex"));
}

// Pieces that hang together by a thread are counted, and no others.

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
