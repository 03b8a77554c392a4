// SPDX-License-Identifier: GPL-3.0-or-later
// Slits that tabs are put through: what can't be cut or put together is found.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "verify/cube_file.hpp"
#include "verify/written_job.hpp"

using namespace ridgecraft;
using Json = nlohmann::json;

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
              "beside its piece"));
  CHECK(tells(with_slits([](Vec2 a, Vec2 /*b*/) { return Ends{a}; }), "slit has 1 entries, not 2"));
  Json convex = Json::parse(slotted_house().fold);
  for (Json& tab : convex["ridgecraft:tabs"]) {
    tab.erase("slit");
  }
  CHECK(tells(convex, "isn't convex"));
}
