// SPDX-License-Identifier: GPL-3.0-or-later
// A tower on a plate through the whole program: parted, glued onto the plate, and the same with nets made
// before.
#include <filesystem>
#include <string>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/program.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using Json = nlohmann::json;
using test::in;
using test::Outcome;
using test::read_bytes;
using test::run_program;
using test::TemporaryFolder;
using test::write_bytes;
namespace fs = std::filesystem;

namespace {

/// A plate of 80 x 80 x 10, and a tower with a foot of 30 x 20 that runs into it and stands 40 high over it.
const std::string tower =
    "o plate\nv 0 0 0\nv 80 0 0\nv 80 80 0\nv 0 80 0\nv 0 0 10\nv 80 0 10\nv 80 80 10\nv 0 80 10\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
    "o tower\nv 20 30 5\nv 50 30 5\nv 50 50 5\nv 20 50 5\nv 20 30 50\nv 50 30 50\nv 50 50 50\nv 20 50 50\n"
    "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";

}  // namespace

TEST_CASE("a tower is glued onto its plate, and is so with nets made before", "[standing]") {
  const TemporaryFolder folder;
  write_bytes(folder / "tower.obj", tower);
  const Outcome made = run_program({"tower.obj", "--size", "80mm", "--json", "-o", "out/"}, in(folder));
  INFO(made.err);
  REQUIRE(made.exit_code == 0);
  const Json json = Json::parse(made.out);
  CHECK(json["united"]["standing"] == 1);
  REQUIRE(json["bodies"].size() == 2);
  CHECK(json["bodies"][0].contains("glued_onto") != json["bodies"][1].contains("glued_onto"));
  CHECK(json["glue_outlines"].size() == 1);
  CHECK(json["additional_tabs"] == 4);
  const fs::path fold = folder / "out" / "tower.fold";
  const Json nets = Json::parse(read_bytes(fold));
  CHECK(nets["ridgecraft:more_tabs"].size() == 4);
  CHECK(nets["ridgecraft:settings"]["standing"] == "apart");
  CHECK(run_program({"verify", "out/tower.fold", "--model", "tower.obj"}, in(folder)).exit_code == 0);
  // One after the other, as a user goes on from what was made last.
  fs::copy_file(fold, folder / "a.fold");
  for (const char* const next : {"b.fold", "c.fold"}) {
    const Outcome again = run_program(
        {"tower.obj", "--from", next[0] == 'b' ? "a.fold" : "b.fold", "--json", "-o", next}, in(folder));
    INFO(next << ": " << again.err);
    REQUIRE(again.exit_code == 0);
    const Json same = Json::parse(again.out);
    CHECK(same["bodies"].size() == 2);
    CHECK(same["additional_tabs"] == 4);
    CHECK(same["pieces"] == json["pieces"]);
    CHECK(Json::parse(read_bytes(folder / next))["ridgecraft:settings"]["standing"] == "apart");
  }
}

TEST_CASE("with --keep-bodies or --faces keep nothing is parted", "[standing]") {
  const TemporaryFolder folder;
  write_bytes(folder / "tower.obj", tower);
  for (const auto& [option, value] : {std::pair{"--faces", "keep"}, {"--tab-height", "4mm"}}) {
    const Outcome made =
        run_program({"tower.obj", "--size", "80mm", "--json", option, value, "-o", "x.fold"}, in(folder));
    INFO(option << ": " << made.err);
    REQUIRE(made.exit_code == 0);
    CHECK(Json::parse(made.out)["united"]["standing"] == (std::string(option) == "--faces" ? 0 : 1));
  }
  const Outcome kept = run_program({"tower.obj", "--keep-bodies", "--json", "-o", "x.fold"}, in(folder));
  CHECK(Json::parse(kept.out)["united"]["standing"] == 0);
  CHECK_FALSE(Json::parse(read_bytes(folder / "x.fold"))["ridgecraft:settings"].contains("standing"));
}
