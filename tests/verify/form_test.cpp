// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes of any kind: one fault of promise 0 without figures, and never anything else; and the cases of the
// independent checker.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/context.hpp"
#include "base/random.hpp"
#include "cli/report/summary.hpp"
#include "support/temporary_folder.hpp"
#include "verify/support.hpp"

using namespace ridgecraft;
using test::replaced;
using Json = nlohmann::json;
namespace fs = std::filesystem;

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

// Agreement with the independent checker's own cases: some 370 files, clean and broken.

namespace {

const fs::path checkers = fs::path(RIDGECRAFT_SHARED_DIR) / "check";

bool run_python(const std::string& arguments) {
  return std::system(("/usr/bin/python3 " + arguments + " > /dev/null").c_str()) == 0;
}

/// Asks the other checker about every file of the folder, in one go.
constexpr const char* ask = R"(
import json, os, sys
sys.path.insert(0, sys.argv[1])
import check_nets
folder = sys.argv[2]
out = {}
for name in sorted(os.listdir(folder)):
    if name.endswith('.fold') and not name.startswith('p0_'):
        with open(os.path.join(folder, name), 'rb') as fh:
            out[name] = check_nets.check_bytes(fh.read())
with open(os.path.join(folder, 'reports.json'), 'w') as fh:
    json.dump(out, fh)
)";

constexpr std::array counts = {"faces", "pieces", "pages", "joins", "joins_without_tab", "tabs"};
constexpr std::array fault_counts = {"overlaps",     "tab_overlaps", "missing_faces",
                                     "double_faces", "outside_page", "bad_joins"};
constexpr std::array lengths = {"max_length_error_mm",
                                "max_penetration_mm",
                                "max_fold_error_deg",
                                "max_refold_error_mm",
                                "cut_mm",
                                "fold_mm"};

void compare_figures(const std::string& name, const Json& ours, const Json& theirs, bool clean) {
  INFO(name);
  for (const char* key : counts) {
    CHECK(ours.at(key) == theirs.at(key));
  }
  for (const char* key : fault_counts) {
    if (clean) {
      CHECK(ours.at(key) == 0);
      CHECK(theirs.at(key) == 0);
    }
  }
  for (const char* key : lengths) {
    const double a = ours.at(key);
    const double b = theirs.at(key);
    INFO(key);
    if (clean) {
      CHECK(std::abs(a - b) <= 1e-9 + 1e-9 * std::abs(b));
    }
  }
}

}  // namespace

TEST_CASE("every case of the independent checker is judged as it says", "[verify]") {
  if (!fs::exists(checkers / "make_cases.py")) {
    WARN("skipped: " << checkers << " is missing");
    return;
  }
  const test::TemporaryFolder folder;
  REQUIRE(run_python((checkers / "make_cases.py").string() + " " + folder.path().string()));
  const Json index = Json::parse(test::read_bytes(folder / "index.json"));
  REQUIRE(index.size() > 300);
  std::set<std::string> clean;
  for (const auto& [name, expected] : index.items()) {
    const verify::Report report = verify::verify(test::read_bytes(folder / name), {}, {});
    const std::vector<int> must = expected.at("faults");
    const std::vector<int> may = expected.at("also");
    const std::vector<int> got = test::broken(report);
    INFO(name << ": " << (report.faults.empty() ? "clean" : report.faults.front().message));
    for (const int promise : must) {
      CHECK(std::count(got.begin(), got.end(), promise) == 1);
    }
    for (const int promise : got) {
      CHECK(std::count(must.begin(), must.end(), promise) + std::count(may.begin(), may.end(), promise) > 0);
    }
    CHECK(report.figures.has_value() == (must != std::vector<int>{0}));
    if (must == std::vector<int>{0}) {
      CHECK(report.faults.size() == 1);
    }
    if (got.empty()) {
      clean.insert(name);
    }
  }
  CHECK(clean.size() >= 40);

  test::write_bytes(folder / "ask.py", ask);
  REQUIRE(run_python((folder / "ask.py").string() + " " + checkers.string() + " " + folder.path().string()));
  const Json reports = Json::parse(test::read_bytes(folder / "reports.json"));
  for (const auto& [name, theirs] : reports.items()) {
    const Json ours =
        Json::parse(cli::summary(name, verify::verify(test::read_bytes(folder / name), {}, {})).json());
    compare_figures(name, ours, theirs, clean.contains(name));
  }
}
