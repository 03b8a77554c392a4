// SPDX-License-Identifier: GPL-3.0-or-later
// Agreement with the independent checker's own cases: some 370 files, clean and broken.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/telling/summary.hpp"
#include "support/temporary_folder.hpp"
#include "verify/cube_file.hpp"

using namespace ridgecraft;
namespace fs = std::filesystem;
using Json = nlohmann::json;

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
    WARN("the independent checker is not here: " << checkers);
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
