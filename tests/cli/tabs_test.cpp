// SPDX-License-Identifier: GPL-3.0-or-later
// Tabs, numbers and sizes by choice, through the whole program: what is asked is done, what is wrong is told.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "cli/arguments/parse.hpp"
#include "cli/files/input_files.hpp"
#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::cli;
using nlohmann::json;
using test::run_program;

namespace {

std::string refusal_of(const std::string& text) {
  try {
    static_cast<void>(read_tab_file("tabs.txt", text));
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::unreadable_input);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a file of tabs is read line by line", "[tabs]") {
  const auto tabs =
      read_tab_file("tabs.txt", "# mine\n12 B\n\n13 none # no glue\n14 height=8mm angle=90\r\n15 both A");
  REQUIRE(tabs.size() == 4);
  CHECK(tabs[0].number == 12);
  CHECK(tabs[0].piece == "B");
  CHECK(tabs[0].where == "tabs.txt, line 2");
  CHECK_FALSE(tabs[1].wanted);
  CHECK(*tabs[2].height_mm == 8.0);
  CHECK(*tabs[2].angle == Approx(1.5707963));
  CHECK(tabs[3].both);
  CHECK(tabs[3].piece == "A");
  for (const auto& [text, words] :
       std::vector<std::pair<std::string, std::string>>{{"12 B\nx none", "line 2: 'x'"},
                                                        {"0 none", "line 1: '0'"},
                                                        {"12", "line 1: after the number"},
                                                        {"12 none B", "line 1: an edge with no tab"},
                                                        {"12 height=99", "line 1: height= takes 1.5 to 50mm"},
                                                        {"12 height=", "line 1: height= takes a length"},
                                                        {"12 angle=5", "line 1: angle= takes a number"},
                                                        {"12 width=3", "line 1: 'width=3'"},
                                                        {"12 B C", "line 1: 'C'"}}) {
    CAPTURE(text);
    CHECK(refusal_of(text).find(words) != std::string::npos);
  }
}

TEST_CASE("tabs by choice keep every promise", "[tabs][slow]") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "house.obj", test::house);
  const auto run = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"house.obj", "--size", "90mm", "--json", "-o", "out.fold", "-o",
                                     "out.pdf", "--no-guide", "--overwrite"});
    const auto outcome = run_program(options, test::in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto checked =
        run_program({"verify", "out.fold", "--pages", "out.pdf", "--json"}, test::in(folder));
    INFO(checked.out);
    CHECK(checked.exit_code == 0);
    return json::parse(outcome.out);
  };
  const json plain = run({});
  CHECK(plain.at("additional_tabs") == 0);
  for (const char* const sides : {"one-side", "alternate"}) {
    CHECK(run({"--tabs", sides}).at("tabs") == plain.at("tabs"));
  }
  CHECK(run({"--tabs", "both"}).at("additional_tabs") > 0);
  const json slots = run({"--tabs", "slots"});
  CHECK(slots.at("joins_in_slits") > 0);
  CHECK(slots.at("joins_without_tab") == plain.at("joins_without_tab"));
  CHECK(run({"--tabs", "none"}).at("tabs") == 0);
  CHECK(run({"--tab-height", "3mm,20mm:6mm", "--tab-angle", "60,25mm:90"}).at("tabs") > 0);
  CHECK(run({"--tab-shadow"}).at("tabs") == plain.at("tabs"));
  for (const char* const numbers : {"tabs", "outside", "back"}) {
    CHECK(run({"--numbers", numbers}).at("labels_left_out") == 0);
  }
  CHECK(run({"--calibrate", "100.4x99.6"}).at("pages") == plain.at("pages"));
  test::write_bytes(folder / "tabs.txt", "1 none\n2 height=3mm\n");
  const json chosen = run({"--tab-file", "tabs.txt"});
  CHECK(chosen.at("joins_without_tab") > plain.at("joins_without_tab"));
  test::write_bytes(folder / "tabs.txt", "1 none\n999 none\n");
  test::check_refusal(run_program({"house.obj", "--tab-file", "tabs.txt", "-o", "x.fold"}, test::in(folder)),
                      3, "tabs.txt, line 2");
}

TEST_CASE("a model gets the height, width or depth that is asked for", "[tabs]") {
  const test::TemporaryFolder folder;
  // 40 wide, 32 high, 25 deep: a file that says nothing else has y up.
  test::write_bytes(folder / "box.obj",
                    "v 0 0 0\nv 40 0 0\nv 40 32 0\nv 0 32 0\nv 0 0 25\nv 40 0 25\nv 40 32 25\nv 0 32 25\n"
                    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const auto check = [&](const char* option, double x, double y, double z, const std::string& up = {}) {
    std::vector<std::string> words{"box.obj", option, "60mm", "--json", "-o", "x.fold", "--overwrite"};
    if (!up.empty()) {
      words.insert(words.end(), {"--up", up});
    }
    const auto outcome = run_program(words, test::in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto size = json::parse(outcome.out).at("size_mm").get<std::vector<double>>();
    CHECK(size[0] == Approx(x).margin(0.01));
    CHECK(size[1] == Approx(y).margin(0.01));
    CHECK(size[2] == Approx(z).margin(0.01));
  };
  check("--width", 60.0, 48.0, 37.5);
  check("--height", 75.0, 60.0, 46.875);
  check("--depth", 96.0, 76.8, 60.0);
  // What is said to point up counts more.
  check("--height", 60.0, 48.0, 37.5, "x");
  check("--height", 75.0, 60.0, 46.875, "y");
  check("--height", 96.0, 76.8, 60.0, "z");
  CHECK(run_program({"verify", "x.fold", "--model", "box.obj"}, test::in(folder)).exit_code == 0);
  CHECK(json::parse(test::read_bytes(folder / "x.fold")).at("ridgecraft:settings").at("up") == "z");
  test::check_refusal(run_program({"box.obj", "--up", "w", "-o", "y.fold"}, test::in(folder)), 2, "--up");
}

TEST_CASE("tabs at borders of a model in colours", "[tabs]") {
  const test::TemporaryFolder folder;
  // A box without a lid, red outside.
  test::write_bytes(folder / "box.mtl", "newmtl red\nKd 0.9 0.1 0.1\n");
  test::write_bytes(folder / "box.obj",
                    "mtllib box.mtl\nusemtl red\n"
                    "v 0 0 0\nv 40 0 0\nv 40 32 0\nv 0 32 0\nv 0 0 25\nv 40 0 25\nv 40 32 25\nv 0 32 25\n"
                    "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const auto outcome = run_program(
      {"box.obj", "--skins", "both", "--border-tabs", "-o", "x.pdf", "-o", "x.fold"}, test::in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(run_program({"verify", "x.fold", "--pages", "x.pdf"}, test::in(folder)).exit_code == 0);
}
