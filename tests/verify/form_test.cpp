// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes of any kind: one fault of promise 0 without figures, and never anything else.
#include <catch2/catch.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "cli/telling/summary.hpp"
#include "verify/cube_file.hpp"
#include "verify/replaced.hpp"

using namespace ridgecraft;
using test::replaced;
using Json = nlohmann::json;

namespace {

void check_refused(std::string_view bytes) {
  const verify::Report report = verify::verify(bytes, {}, {});
  REQUIRE(report.faults.size() == 1);
  CHECK(report.faults[0].promise == verify::Promise::form);
  CHECK_FALSE(report.faults[0].message.empty());
  CHECK_FALSE(report.figures.has_value());
  const Json json = Json::parse(cli::summary("nets.fold", report).json());
  CHECK(json.at("faces").is_null());
  CHECK(json.at("cut_mm").is_null());
}

}  // namespace

TEST_CASE("what isn't JSON is refused", "[verify]") {
  const std::string clean = test::cube_file().dump();
  for (const std::string_view bytes :
       {std::string_view(""), std::string_view("   \n"), std::string_view("null"), std::string_view("[]"),
        std::string_view("{}"), std::string_view("{\"file_spec\": NaN}"), std::string_view("\0\0\0\0", 4),
        std::string_view("\xff\xfe{\0}\0", 6), std::string_view("solid cube\n")}) {
    check_refused(bytes);
  }
  check_refused(clean.substr(0, clean.size() / 2));
  check_refused(clean + "{}");
  check_refused("\xEF\xBB\xBF" + clean);
  check_refused(std::string(1'000'000, '['));
  std::string nested;
  for (int i = 0; i < 200'000; ++i) {
    nested += "{\"a\":";
  }
  check_refused(nested);
  check_refused(replaced(clean, "\"file_spec\":1.2",
                         "\"file_spec\":1.2,\"deep\":" + std::string(100, '[') + std::string(100, ']')));
}

TEST_CASE("numbers that are no lengths, angles or indices are refused", "[verify]") {
  const std::string clean = test::cube_file().dump();
  REQUIRE(verify::verify(clean, {}, {}).sound());
  check_refused(replaced(clean, "\"file_spec\":1.2", "\"file_spec\":1e999"));
  check_refused(
      replaced(clean, "\"file_title\":\"cube\"", "\"file_title\":\"cube\",\"file_title\":\"cube\""));
  check_refused(replaced(clean, "\"reason\":\"component\"", "\"reason\":\"component\",\"holes\":4000000000"));
  for (const char* number : {"1e308", "-1e300", "1e999", "NaN", "\"1\"", "null", "true", "[]", "10000001"}) {
    check_refused(
        replaced(clean, "\"vertices_coords\":[[60.0", std::string("\"vertices_coords\":[[") + number));
  }
  for (const char* index : {"1e18", "1000000000000000000", "18446744073709551615", "99999999999999999999999",
                            "-1", "0.5", "1.0", "6", "null", "\"0\"", "false", "{}"}) {
    check_refused(replaced(clean, "\"ridgecraft:faces_model\":[0",
                           std::string("\"ridgecraft:faces_model\":[") + index));
    check_refused(replaced(clean, "\"ridgecraft:faces_piece\":[0",
                           std::string("\"ridgecraft:faces_piece\":[") + index));
  }
}

TEST_CASE("every key, left out or of another type, is noticed or not needed", "[verify]") {
  const Json clean = test::cube_file();
  for (const auto& [key, value] : clean.items()) {
    Json json = clean;
    json.erase(key);
    check_refused(json.dump());
    for (const Json& other :
         {Json(), Json(-7), Json("text"), Json(true), Json{{"a", 1}}, Json{{1, 2}, {3}}}) {
      json = clean;
      json[key] = other;
      INFO(json[key].dump());
      const verify::Report report = test::verify_json(json);
      const bool same_type =
          (value.is_string() && other.is_string()) || (value.is_object() && other.is_object());
      if (!same_type) {
        CHECK_FALSE(report.figures.has_value());
      }
    }
  }
}

TEST_CASE("damaged bytes never do harm", "[verify]") {
  const std::string clean = test::cube_file().dump();
  Random random(20);
  constexpr std::string_view spare = "0123456789.eE+-[]{},:\"MVBFnull ";
  for (int round = 0; round < 4000; ++round) {
    std::string bytes = clean;
    for (std::uint32_t edits = 1 + random.below(3); edits > 0; --edits) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
      switch (random.below(4)) {
        case 0:
          bytes[at] = spare[random.below(static_cast<std::uint32_t>(spare.size()))];
          break;
        case 1:
          bytes.erase(at, 1 + random.below(6));
          break;
        case 2:
          bytes.insert(at, 1, spare[random.below(static_cast<std::uint32_t>(spare.size()))]);
          break;
        default:
          bytes[at] = static_cast<char>(random.below(256));
      }
    }
    const verify::Report report = verify::verify(bytes, {}, {});
    // Nothing but a form fault goes without figures, and it goes alone.
    const bool form = !report.figures.has_value();
    CHECK(form == (report.faults.size() == 1 && report.faults[0].promise == verify::Promise::form));
    CHECK_FALSE(Json::parse(cli::summary("nets.fold", report).json()).empty());
  }
}
