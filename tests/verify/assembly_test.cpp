// SPDX-License-Identifier: GPL-3.0-or-later
// An order of assembly that nobody can follow is found.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "verify/cube_file.hpp"
#include "verify/written_job.hpp"

using namespace ridgecraft;
using test::statement_promise;
using Json = nlohmann::json;

namespace {

constexpr int form_promise = 0;

const Json& whale() {
  static const Json json = Json::parse(test::whale().fold);
  return json;
}

void check_found(int promise, const std::string& words, const std::function<void(Json&)>& break_order) {
  Json json = whale();
  break_order(json["ridgecraft:assembly"]);
  const verify::Report report = test::verify_json(json);
  INFO(words << ": " << test::first_fault(report));
  CHECK(test::broken(report) == std::vector<int>{promise});
  CHECK(test::first_fault(report).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("an order of assembly is sound, or isn't told", "[assembly]") {
  REQUIRE(whale().at("ridgecraft:assembly").size() > 1);
  CHECK(test::verify_json(whale()).sound());
  Json json = whale();
  json.erase("ridgecraft:assembly");
  CHECK(test::verify_json(json).sound());
}

TEST_CASE("an order of assembly that nobody can follow is found", "[assembly]") {
  check_found(statement_promise, "no step of the assembly has", [](Json& steps) { steps.erase(0); });
  check_found(statement_promise, "which stands already", [](Json& steps) {
    steps.push_back({{"pieces", steps[0]["pieces"]}, {"joins", Json::array()}});
  });
  check_found(statement_promise, "has other joins", [](Json& steps) { steps.back()["joins"].erase(0); });
  check_found(statement_promise, "isn't glued to anything that stands", [](Json& steps) {
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
    const std::size_t first = steps[0]["pieces"][0];
    const auto meets_first = [&](std::size_t piece) {
      return std::any_of(seams.begin(), seams.end(), [&](const auto& seam) {
        return (seam[0] == piece && seam[1] == first) || (seam[1] == piece && seam[0] == first);
      });
    };
    std::vector<std::size_t> order{first};
    const std::size_t count = whale().at("ridgecraft:pieces").size();
    for (const bool meets : {false, true}) {
      for (std::size_t piece = 0; piece < count; ++piece) {
        if (piece != first && meets_first(piece) == meets) {
          order.push_back(piece);
        }
      }
    }
    REQUIRE_FALSE(meets_first(order[1]));
    std::vector<std::vector<std::int64_t>> numbers(order.size());
    const auto place = [&](std::size_t piece) {
      return static_cast<std::size_t>(std::find(order.begin(), order.end(), piece) - order.begin());
    };
    for (std::size_t j = 0; j < joins.size(); ++j) {
      numbers[std::max(place(seams[j][0]), place(seams[j][1]))].push_back(joins[j]["number"]);
    }
    steps = Json::array();
    for (std::size_t i = 0; i < order.size(); ++i) {
      steps.push_back({{"pieces", {order[i]}}, {"joins", numbers[i]}});
    }
  });
}

TEST_CASE("an order of assembly in a wrong form is none", "[assembly]") {
  check_found(form_promise, "is not a list", [](Json& steps) { steps = 3; });
  check_found(form_promise, "is not an object", [](Json& steps) { steps[0] = 3; });
  check_found(form_promise, "pieces has 0 entries", [](Json& steps) { steps[0]["pieces"] = Json::array(); });
  check_found(form_promise, "pieces", [](Json& steps) { steps[0]["pieces"][0] = 1000; });
  check_found(form_promise, "is not a whole number", [](Json& steps) { steps[0]["joins"].push_back("x"); });
}
