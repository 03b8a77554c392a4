// SPDX-License-Identifier: GPL-3.0-or-later
// What a file says of itself. The program's own file is changed in every sensible way, and the changes that
// no checker can see are listed one by one with the reason why.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "unfold/net/options.hpp"
#include "verify/support.hpp"

using namespace ridgecraft;
using test::statement_promise;
using Json = nlohmann::json;

namespace {

/// Small, with tabs, several pieces of some parts, and folds of both kinds.
const Json& house() {
  static const test::WrittenJob job(test::sample("house.obj"));
  static const Json json = Json::parse(job.fold);
  return json;
}

/// A change has to be found, as a fault of this promise, among others that it brings.
void check_found(const std::string& words, const std::function<void(Json&)>& change,
                 int promise = statement_promise) {
  Json json = house();
  change(json);
  const verify::Report report = test::verify_json(json);
  INFO(words << ": " << test::first_fault(report));
  CHECK(std::any_of(report.faults.begin(), report.faults.end(), [&](const verify::Fault& fault) {
    return static_cast<int>(fault.promise) == promise && fault.message.find(words) != std::string::npos;
  }));
}

bool is_weight(const std::string& setting) {
  return setting.starts_with("weigh_");
}

Json& settings(Json& json) {
  return json["ridgecraft:settings"];
}

}  // namespace

TEST_CASE("what the program says of its files is so, whatever it was asked for", "[statements][slow]") {
  const std::string any_weight(unfold::term_names().front());
  const std::vector<std::vector<std::string>> jobs = {
      {},
      {"--no-tabs", "--margin", "0", "--max-faces", "9"},
      {"--all-tabs", "--paper", "letter-landscape"},
      {"--scale", "1:2", "--faces", "keep", "--pieces", "few", "--weigh", any_weight + "=3", "--seed", "5"},
      {"--faces", "20", "--hide-folds", "12.5", "--tab-angle", "61.3", "--tab-height", "0.3in"},
      {"--tabs", "slots", "--border-tabs"},
      {"--thickness", "2mm", "--hinge", "front"}};
  for (const std::vector<std::string>& options : jobs) {
    const test::WrittenJob job(test::sample("house.obj"), options);
    const verify::Report report = verify::verify(job.fold, {.folding = true}, {});
    INFO((options.empty() ? "" : options[0]) << ": " << test::first_fault(report));
    CHECK(report.sound());
  }
}

TEST_CASE("kind 1: settings that nobody knows, or that no option takes", "[statements]") {
  check_found("unknown setting", [](Json& json) { settings(json)["colour"] = "red"; });
  check_found("unknown setting", [](Json& json) { settings(json)["weigh_"] = 1; });
  check_found("unknown setting", [](Json& json) { settings(json)["weigh_seam2"] = 1; });
  check_found("unknown setting", [](Json& json) { settings(json)["searched_colour"] = "red"; });
  check_found("no option takes", [](Json& json) { settings(json)["searched_seed"] = "many"; });
  std::size_t weights = 0;
  for (const auto& [key, value] : house().at("ridgecraft:settings").items()) {
    const std::string name = key;
    weights += is_weight(name) ? 1U : 0U;
    // The size may be told by the scale, which weights there are is left to the program, and not all models
    // have bodies.
    if (name != "size_mm" && name != "bodies" && name != "standing" && !is_weight(name)) {
      check_found("the settings lack \"" + name, [&](Json& json) { settings(json).erase(name); });
    }
    for (const Json& bad : {Json(), Json(-1), Json("many"), Json::object(), Json::array({1, "a"})}) {
      check_found("\"" + name + "\" has a value that no option takes",
                  [&](Json& json) { settings(json)[name] = bad; });
    }
  }
  CHECK(weights > 0);
  check_found("no option takes", [](Json& json) { settings(json)["seed"] = 1.5; });
  check_found("no option takes", [](Json& json) { settings(json)["concavity"] = 3; });
  check_found("no option takes", [](Json& json) { settings(json)["faces"] = 2; });
  check_found("the size or the scale", [](Json& json) { settings(json).erase("size_mm"); });
  check_found("the size or the scale", [](Json& json) { settings(json)["mm_per_unit"] = 2; });
  check_found("can't have \"paper_mm\"", [](Json& json) { settings(json)["whole"] = true; });
  check_found("can't have \"weigh_", [](Json& json) { settings(json)["whole"] = true; });
}

TEST_CASE("kind 2: settings that the nets contradict", "[statements]") {
  check_found("ask for a size of 151 mm", [](Json& json) { settings(json)["size_mm"] = 151; });
  check_found("isn't as large as the paper", [](Json& json) { settings(json)["paper_mm"] = {297, 210}; });
  check_found("aren't those of the settings", [](Json& json) { settings(json)["margin_mm"] = 9; });
  check_found("less than 5 mm apart", [](Json& json) { settings(json)["gap_mm"] = 5; });
  check_found("mm high, the settings allow 4.9 mm",
              [](Json& json) { settings(json)["tab_height_mm"] = 4.9; });
  check_found("the settings ask for no tabs", [](Json& json) { settings(json)["tabs"] = false; });
  check_found("flat faces, the settings allow 2", [](Json& json) { settings(json)["max_faces"] = 2; });
  // A join by hand may make a piece of two that have as many faces as are allowed, and no more of it.
  check_found("flat faces, the settings allow 2", [](Json& json) {
    settings(json)["max_faces"] = 1;
    settings(json)["edits"] = "cut 3 4\njoin 1 2";
  });
  Json joined = house();
  settings(joined)["max_faces"] = 6;
  settings(joined)["edits"] = "cut 3 4\njoin 1 2";
  const std::vector<verify::Fault> faults = test::verify_json(joined).faults;
  CHECK(std::none_of(faults.begin(), faults.end(), [](const verify::Fault& fault) {
    return fault.message.find("the settings allow") != std::string::npos;
  }));
  check_found("all tabs and for none", [](Json& json) {
    settings(json)["tabs"] = false;
    settings(json)["all_tabs"] = true;
  });
  check_found("don't keep its faces", [](Json& json) { settings(json)["cuts"] = "0123456789abcdef"; });
}

TEST_CASE("kind 3: the hash of the model, and what is up", "[statements]") {
  check_found("no hash of a model", [](Json& json) { json.erase("ridgecraft:model_digest"); });
  check_found("no hash of a model", [](Json& json) { json["ridgecraft:model_digest"] = "0123"; });
  check_found(
      "is not a text", [](Json& json) { json["ridgecraft:model_digest"] = 7; }, 0);
  check_found(
      "ridgecraft:up is \"north\", not one of \"x\", \"y\", \"z\"",
      [](Json& json) { json["ridgecraft:up"] = "north"; }, 0);
}

TEST_CASE("kind 4: vertices that nothing uses, keys that are unknown or missing", "[statements]") {
  check_found("belongs to no face", [](Json& json) { json["vertices_coords"].push_back({0, 0}); });
  check_found("belongs to no face", [](Json& json) {
    json["file_frames"][0]["vertices_coords"].push_back({0, 0, 0});
  });
  check_found("unknown key \"ridgecraft:fold_ordr\" of the file",
              [](Json& json) { json["ridgecraft:fold_ordr"] = json["ridgecraft:fold_order"]; });
  check_found("ridgecraft:fold_order is missing", [](Json& json) { json.erase("ridgecraft:fold_order"); });
  check_found("\"hole\" of ridgecraft:pieces[1]",
              [](Json& json) { json["ridgecraft:pieces"][1]["hole"] = 1; });
  check_found("\"tap\" of ridgecraft:joins[0]", [](Json& json) { json["ridgecraft:joins"][0]["tap"] = 1; });
  check_found("\"kind\" of ridgecraft:tabs[2]", [](Json& json) { json["ridgecraft:tabs"][2]["kind"] = 1; });
  check_found("\"name\" of ridgecraft:pages[0]", [](Json& json) { json["ridgecraft:pages"][0]["name"] = 1; });
}

TEST_CASE("kind 5: pages that aren't those of the settings", "[statements]") {
  check_found("aren't those of the settings",
              [](Json& json) { json["ridgecraft:pages"][0]["margins"][2] = 9.5; });
  check_found("isn't as large as the paper", [](Json& json) {
    json["ridgecraft:pages"][1]["size"] = {210, 297.5};
  });
  check_found("isn't as large as the paper",
              [](Json& json) { json["ridgecraft:pages"][0]["size"] = nullptr; });
}

TEST_CASE("kind 6: numbers that two seams share", "[statements]") {
  check_found("have the same number and are no row of edges", [](Json& json) {
    Json& joins = json["ridgecraft:joins"];
    const Json number = joins.front()["number"];
    joins.back()["number"] = number;
    json["ridgecraft:tabs"][joins.back()["tab"].get<std::size_t>()]["joins"] = {number};
  });
}

TEST_CASE("kind 7: chains that aren't rows of joins", "[statements]") {
  const auto longest = [](Json& json) -> Json& {
    Json& chains = json["ridgecraft:chains"];
    return *std::max_element(chains.begin(), chains.end(), [](const Json& a, const Json& b) {
      return a["joins"].size() < b["joins"].size();
    });
  };
  Json clean = house();
  REQUIRE(longest(clean)["joins"].size() > 2);
  check_found("ridgecraft:chains is missing", [](Json& json) { json.erase("ridgecraft:chains"); });
  check_found("is in 0 chains, not in one", [&](Json& json) { longest(json)["joins"].erase(0); });
  check_found("is in 2 chains, not in one",
              [](Json& json) { json["ridgecraft:chains"].push_back(json["ridgecraft:chains"][0]); });
  check_found("has joins of another number", [&](Json& json) {
    longest(json)["number"] = 1 + json["ridgecraft:chains"].back()["number"].get<int>();
  });
  check_found("don't follow each other on both of its pieces", [&](Json& json) {
    Json& joins = longest(json)["joins"];
    std::swap(joins[0], joins[1]);
  });
  // Every other join the other way round is the same chain.
  Json turned = house();
  std::swap(turned["ridgecraft:joins"][1]["edges"][0], turned["ridgecraft:joins"][1]["edges"][1]);
  CHECK(test::verify_json(turned).sound());
}

TEST_CASE("files of other programs need not speak as this one does", "[statements]") {
  Json json = test::cube_file();
  REQUIRE(test::broken(json).empty());
  json["file_creator"] = "somebody's script";
  json["ridgecraft:settings"] = {{"own", {{"deep", 3}}}, {"seed", "none"}};
  json["file_classes"] = {"multiModel", "animation"};
  json["frame_attributes"] = {"2D", "noCuts"};
  json["vertices_coords"].push_back({300, 300});
  json["ridgecraft:note"] = "made by hand";
  json["ridgecraft:pieces"][0]["name"] = "left ear";
  json["file_frames"].push_back({{"frame_title", "a picture"}});
  const verify::Report report = test::verify_json(json);
  INFO(test::first_fault(report));
  CHECK(report.sound());
}

namespace {

/// Every value of the file, with its path; of long lists the first, the middle and the last entry.
void visit(const Json& json, const std::string& path, const Json::json_pointer& at,
           const std::function<void(const std::string&, const Json::json_pointer&)>& see) {
  if (!path.empty()) {
    see(path, at);
  }
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      visit(value, path + "/" + key, at / key, see);
    }
  } else if (json.is_array()) {
    const std::size_t n = json.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (n <= 3 || i == 0 || i == n / 2 || i == n - 1) {
        visit(json[i], path + "/#", at / i, see);
      }
    }
  }
}

std::vector<Json> changes_of(const Json& value) {
  std::vector<Json> changes{nullptr};
  if (value.is_boolean()) {
    changes.emplace_back(!value.get<bool>());
  } else if (value.is_number()) {
    const auto x = value.get<double>();
    if (value.is_number_integer()) {
      changes.emplace_back(value.get<std::int64_t>() + 1);
      changes.emplace_back(value.get<std::int64_t>() - 1);
    }
    for (const double other : {x + 1.0, x - 1.0, 1.01 * x, -x, 0.0, 1e6, x + 0.5}) {
      changes.emplace_back(other);
    }
    changes.emplace_back(value.dump());
  } else if (value.is_string()) {
    changes.insert(changes.end(), {"", value.get<std::string>() + "x", 3});
  } else if (value.is_array()) {
    changes.emplace_back(Json::array());
    changes.emplace_back(3);
    if (!value.empty()) {
      Json other = value;
      other.erase(other.size() - 1);
      changes.push_back(other);
      other = value;
      other.push_back(value.back());
      changes.push_back(other);
      other = value;
      std::reverse(other.begin(), other.end());
      changes.push_back(other);
      other = value;
      std::swap(other.front(), other[other.size() > 2 ? 1 : 0]);
      changes.push_back(other);
    }
  } else if (value.is_object()) {
    Json other = value;
    other["ridgecraft:extra"] = 1;
    changes.push_back(other);
    changes.emplace_back(3);
  }
  return changes;
}

/// Where a change can't be seen in the file alone.
const std::set<std::string> free_paths = {
    "/file_title", "/file_creator",  // names are whatever they are
    "/file_classes", "/frame_classes", "/frame_attributes", "/file_frames/#/frame_classes",
    "/file_frames/#/frame_attributes", "/file_frames/#/frame_attributes/#",  // there may be more of them
    "/file_frames",                                                          // and further frames
    // The contract leaves names, order and reasons to the program, but for what it says of part and page.
    "/ridgecraft:pieces", "/ridgecraft:pieces/#/name", "/ridgecraft:pieces/#/reason", "/ridgecraft:pages",
    "/ridgecraft:joins", "/ridgecraft:joins/#", "/ridgecraft:joins/#/why", "/ridgecraft:tabs",
    "/ridgecraft:tabs/#/joins",
    "/edges_vertices",                                   // two flat folds that change their numbers
    "/edges_vertices/#",                                 // an edge has no direction
    "/ridgecraft:joins/#/edges",                         // nor has a join
    "/ridgecraft:chains", "/ridgecraft:chains/#/joins",  // nor a chain
    "/ridgecraft:fold_order/#/#",                        // what is folded together comes in no order
    "/edges_foldAngle/#",                                // within the tolerance of small angles
    "/file_frames/#/frame_inherit",                      // false is what it means when it is left out
    "/ridgecraft:pieces/#/holes",                        // as is 0
    "/ridgecraft:pages/#/origin/#",                      // a hundredth of nothing
    // How nets were searched leaves no trace in them, and limits may be wider than what came of them.
    "/ridgecraft:settings/concavity", "/ridgecraft:settings/seed", "/ridgecraft:settings/max_faces",
    "/ridgecraft:settings/gap_mm", "/ridgecraft:settings/tab_height_mm", "/ridgecraft:settings/tab_angle_deg",
    "/ridgecraft:settings/hide_folds_deg",
    // A tab may have any convex shape as high as the settings allow; the printed pages know which.
    "/ridgecraft:tabs/#/polygon", "/ridgecraft:tabs/#/polygon/#", "/ridgecraft:tabs/#/polygon/#/#",
    // Equal pieces are optional.
    "/ridgecraft:equal_pieces", "/ridgecraft:equal_pieces/#", "/ridgecraft:equal_pieces/#/#",
    // Nor what stands on others, which may have any outline and any tabs there.
    "/ridgecraft:glue", "/ridgecraft:glue/#", "/ridgecraft:glue/#/outlines", "/ridgecraft:glue/#/outlines/#",
    "/ridgecraft:glue/#/outlines/#/#", "/ridgecraft:glue/#/outlines/#/#/#", "/ridgecraft:more_tabs",
    "/ridgecraft:more_tabs/#", "/ridgecraft:more_tabs/#/polygon", "/ridgecraft:more_tabs/#/polygon/#",
    "/ridgecraft:more_tabs/#/polygon/#/#", "/ridgecraft:more_tabs/#/foot", "/ridgecraft:settings/bodies",
    "/ridgecraft:settings/standing",
    // Nor need the order of assembly; what stands alone may come in any.
    "/ridgecraft:assembly",
    // Nor what is up.
    "/ridgecraft:up",
    // One that is symmetric itself is a mirror image as well.
    "/ridgecraft:equal_pieces/#/#/mirrored"};

/// What pieces cost has shaped the search, too.
bool is_free(const std::string& path) {
  const std::string place = "/ridgecraft:settings/";
  return free_paths.contains(path) || (path.starts_with(place) && is_weight(path.substr(place.size())));
}

}  // namespace

TEST_CASE("every value of a file, changed in every sensible way, is found or free", "[statements][slow]") {
  const Json& clean = house();
  std::size_t changes = 0;
  std::size_t accepted = 0;
  const auto check = [&](const std::string& path, const Json& changed, const std::string& how) {
    ++changes;
    if (test::verify_json(changed).sound()) {
      ++accepted;
      INFO(path << " " << how);
      CHECK(is_free(path));
    }
  };
  visit(clean, "", Json::json_pointer(), [&](const std::string& path, const Json::json_pointer& at) {
    for (const Json& change : changes_of(clean[at])) {
      if (change != clean[at] || change.type() != clean[at].type()) {
        Json json = clean;
        json[at] = change;
        check(path, json, "as " + change.dump().substr(0, 60));
      }
    }
    Json json = clean;
    Json& parent = json[at.parent_pointer()];
    if (parent.is_object()) {
      parent.erase(at.back());
    } else {
      parent.erase(std::stoul(at.back()));
    }
    check(path, json, "left out");
  });
  CHECK(changes > 1000);
  CHECK(accepted < changes / 5);
}

// An order of assembly that can't be followed is found.

namespace {

constexpr int form_promise = 0;

const Json& whale() {
  static const Json json = Json::parse(test::whale().fold);
  return json;
}

void check_order(int promise, const std::string& words, const std::function<void(Json&)>& break_order) {
  Json json = whale();
  break_order(json["ridgecraft:assembly"]);
  const verify::Report report = test::verify_json(json);
  INFO(words << ": " << test::first_fault(report));
  CHECK(test::broken(report) == std::vector<int>{promise});
  CHECK(test::first_fault(report).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("an order of assembly is sound, or missing", "[assembly]") {
  REQUIRE(whale().at("ridgecraft:assembly").size() > 1);
  CHECK(test::verify_json(whale()).sound());
  Json json = whale();
  json.erase("ridgecraft:assembly");
  CHECK(test::verify_json(json).sound());
}

TEST_CASE("an order of assembly that can't be followed is found", "[assembly]") {
  check_order(statement_promise, "no step of the assembly has", [](Json& steps) { steps.erase(0); });
  check_order(statement_promise, "which stands already", [](Json& steps) {
    steps.push_back({{"pieces", steps[0]["pieces"]}, {"joins", Json::array()}});
  });
  check_order(statement_promise, "has other joins", [](Json& steps) { steps.back()["joins"].erase(0); });
  check_order(statement_promise, "isn't glued to anything that stands", [](Json& steps) {
    // Two pieces that are no neighbours begin: the second has nothing to stand on.
    const Json& joins = whale().at("ridgecraft:joins");
    const Json& faces = whale().at("ridgecraft:faces_piece");
    const Json& corners = whale().at("faces_vertices");
    const auto piece_at = [&](const Json& edge) {
      const Json& ends = whale().at("edges_vertices").at(edge.get<std::size_t>());
      for (std::size_t f = 0; f < corners.size(); ++f) {
        const auto& face = corners[f];
        for (std::size_t k = 0; k < 3; ++k) {
          const Json& a = face[k];
          const Json& b = face[(k + 1) % 3];
          if ((a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0])) {
            return faces[f].get<std::size_t>();
          }
        }
      }
      return faces.size();
    };
    std::vector<std::array<std::size_t, 2>> seams;
    for (const Json& join : joins) {
      seams.push_back({piece_at(join["edges"][0]), piece_at(join["edges"][1])});
    }
    const auto meet = [&](std::size_t p, std::size_t q) {
      return std::any_of(seams.begin(), seams.end(), [&](const auto& seam) {
        return (seam[0] == p && seam[1] == q) || (seam[1] == p && seam[0] == q);
      });
    };
    const std::size_t count = whale().at("ridgecraft:pieces").size();
    std::vector<std::size_t> order;
    for (std::size_t first = 0; first < count && (order.size() < 2 || meet(order[0], order[1])); ++first) {
      order = {first};
      for (const bool meets : {false, true}) {
        for (std::size_t piece = 0; piece < count; ++piece) {
          if (piece != first && meet(first, piece) == meets) {
            order.push_back(piece);
          }
        }
      }
    }
    REQUIRE_FALSE(meet(order[0], order[1]));
    std::vector<std::vector<std::int64_t>> numbers(order.size());
    const auto place = [&](std::size_t piece) {
      return static_cast<std::size_t>(std::find(order.begin(), order.end(), piece) - order.begin());
    };
    for (std::size_t j = 0; j < joins.size(); ++j) {
      std::vector<std::int64_t>& own = numbers[std::max(place(seams[j][0]), place(seams[j][1]))];
      if (own.empty() || own.back() != joins[j]["number"]) {
        own.push_back(joins[j]["number"]);
      }
    }
    steps = Json::array();
    for (std::size_t i = 0; i < order.size(); ++i) {
      steps.push_back({{"pieces", {order[i]}}, {"joins", numbers[i]}});
    }
  });
}

TEST_CASE("an order of assembly in a wrong form is none", "[assembly]") {
  check_order(form_promise, "is not a list", [](Json& steps) { steps = 3; });
  check_order(form_promise, "is not an object", [](Json& steps) { steps[0] = 3; });
  check_order(form_promise, "pieces has 0 entries", [](Json& steps) { steps[0]["pieces"] = Json::array(); });
  check_order(form_promise, "pieces", [](Json& steps) { steps[0]["pieces"][0] = 1000; });
  check_order(form_promise, "is not a whole number", [](Json& steps) { steps[0]["joins"].push_back("x"); });
}
