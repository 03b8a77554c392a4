// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft segment from outside.
#include <map>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/shapes.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_CASE("parts are compared with other people's", "[verb_segment]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "same.seg", "4 4 4 4 4 4 4");
  write_bytes(folder / "roof.seg", "0\n0\n0\n0\n0\n1\n1\n");
  write_bytes(folder / "short.seg", "0\n0\n");
  write_bytes(folder / "long.seg", "0 0 0 0 0 0 0 0");
  write_bytes(folder / "words.seg", "0 0 0 roof 0 0 0");
  const Json json = Json::parse(
      run_program({"segment", "house.obj", "--json", "--compare", "same.seg", "roof.seg"}, in(folder)).out);
  CHECK(json["volume_ratio"].get<double>() == Approx(1.0).margin(0.02));
  REQUIRE(json["compare"].size() == 2);
  CHECK(json["compare"][0]["rand_error"] == 0.0);
  CHECK(json["compare"][0]["cut_discrepancy"] == 0.0);
  CHECK(json["compare"][1]["rand_error"].get<double>() == Approx(10.0 / 21.0));
  CHECK(json["compare"][1]["gce"].get<double>() == Approx(0.0).margin(1e-12));
  CHECK(json["compare"][1]["cut_discrepancy"].is_null());
  CHECK(json["compare_mean"]["rand_error"].get<double>() == Approx(5.0 / 21.0));
  for (const char* bad : {"short.seg", "long.seg", "words.seg", "none.seg"}) {
    const auto run = run_program({"segment", "house.obj", "--compare", bad, "-o", "x.ply"}, in(folder));
    CHECK(run.exit_code == 3);
    CHECK(run.err.find(bad) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "x.ply"));
  }
}

TEST_CASE("parts leave in the numbers of the file, however extreme", "[verb_segment]") {
  const TemporaryFolder folder;
  write_bytes(folder / "far.obj",
              "v 0 0 0\nv 1e71 0 0\nv 0 1e71 0\nv 0 0 1e71\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const Outcome outcome =
      run_program({"segment", "far.obj", "-o", "p.off", "-o", "p.ply", "--json"}, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(read_bytes(folder / "p.off").find("\n1e+71 0 0\n") != std::string::npos);
  CHECK(Json::parse(outcome.out)["part"][0]["hull_volume"].get<double>() == Approx(1e213 / 6.0));
  const Json ply = Json::parse(run_program({"info", "p.ply", "--json"}, in(folder)).out);
  CHECK(ply["size"][0].get<double>() == Approx(1e71));
}

TEST_CASE("a file that is no label file is refused before the work", "[verb_segment]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  write_bytes(folder / "notes", "somebody's own");
  // After the segmentation, other people's labels would have been missed first.
  for (const char* option : {"--labels", "--hierarchy"}) {
    check_refusal(
        run_program({"segment", "house.obj", option, "notes", "--compare", "missing.seg"}, in(folder)), 7,
        "notes");
  }
  REQUIRE(run_program({"segment", "house.obj", "--labels", "l", "--hierarchy", "h"}, in(folder)).exit_code ==
          0);
  CHECK(run_program({"segment", "house.obj", "--labels", "l", "--hierarchy", "h"}, in(folder)).exit_code ==
        0);
}

TEST_CASE("a hierarchy made from the model is replaced, with other parts too", "[verb_segment]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  REQUIRE(run_program({"segment", "house.obj", "--hierarchy", "h.json"}, in(folder)).exit_code == 0);
  Json tree = Json::parse(read_bytes(folder / "h.json"));
  REQUIRE(tree.contains("ridgecraft:model_digest"));
  tree["leaves"] = 7;  // as another version of the program might find them
  write_bytes(folder / "h.json", tree.dump());
  CHECK(run_program({"segment", "house.obj", "--hierarchy", "h.json"}, in(folder)).exit_code == 0);
  tree["ridgecraft:model_digest"] = "0123456789abcdef";
  write_bytes(folder / "h.json", tree.dump());
  check_refusal(run_program({"segment", "house.obj", "--hierarchy", "h.json"}, in(folder)), 7, "h.json");
}

TEST_CASE("whoever reads the hierarchy has the parts of every number", "[verb_segment]") {
  const TemporaryFolder folder;
  // A table: its top and four legs.
  const auto table = voxels({{0, 0, 1},
                             {1, 0, 1},
                             {2, 0, 1},
                             {0, 1, 1},
                             {1, 1, 1},
                             {2, 1, 1},
                             {0, 2, 1},
                             {1, 2, 1},
                             {2, 2, 1},
                             {0, 0, 0},
                             {2, 0, 0},
                             {0, 2, 0},
                             {2, 2, 0}},
                            2);
  std::ostringstream obj;
  for (const auto& p : table.points()) {
    obj << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }
  for (std::uint32_t f = 0; f < table.face_count(); ++f) {
    obj << 'f';
    for (const auto v : table.vertices(ridgecraft::FaceId(f))) {
      obj << ' ' << v.value() + 1;
    }
    obj << '\n';
  }
  write_bytes(folder / "table.obj", obj.str());
  REQUIRE(run_program({"segment", "table.obj", "--hierarchy", "h.json"}, in(folder)).exit_code == 0);
  const Json tree = Json::parse(read_bytes(folder / "h.json"));
  const auto leaves = tree["leaves"].get<std::size_t>();
  REQUIRE(leaves >= 5);
  REQUIRE(tree["leaf_concavity"].size() == leaves);
  REQUIRE(tree["leaf_of_polygon"].size() == table.face_count());
  REQUIRE(tree["joinings"].size() == leaves - 1);
  // Joinings as the file tells them, one after the other; at each number of parts the program's own labels.
  std::vector<std::size_t> node_of = tree["leaf_of_polygon"].get<std::vector<std::size_t>>();
  double last = 0.0;
  for (std::size_t n = leaves; n >= 1; --n) {
    if (n == 5 || n == 3 || n == 1) {
      REQUIRE(
          run_program({"segment", "table.obj", "--parts", std::to_string(n), "--labels", "l", "--overwrite"},
                      in(folder))
              .exit_code == 0);
      std::istringstream labels(read_bytes(folder / "l"));
      std::map<std::size_t, std::size_t> label_of;
      for (const std::size_t node : node_of) {
        std::size_t label = 0;
        REQUIRE(labels >> label);
        CHECK(label_of.try_emplace(node, label).first->second == label);
      }
      CHECK(label_of.size() == n);
    }
    if (n > 1) {
      const Json& joining = tree["joinings"][leaves - n];
      CHECK(joining["node"] == 2 * leaves - n);
      CHECK(joining["concavity"].get<double>() >= last);
      last = joining["concavity"].get<double>();
      for (std::size_t& node : node_of) {
        if (node == joining["of"][0] || node == joining["of"][1]) {
          node = 2 * leaves - n;
        }
      }
    }
  }
}
