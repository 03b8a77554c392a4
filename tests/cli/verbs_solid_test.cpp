// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft hulls, cage, shell and deform from outside.
#include <array>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "mesh/mesh.hpp"
#include "support/shapes.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// A board on four legs: five hulls.
std::string table() {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      cells.push_back({x, y, 3});
      if (x % 4 == 0 && y % 4 == 0) {
        cells.push_back({x, y, 2});
        cells.push_back({x, y, 1});
      }
    }
  }
  return ridgecraft::mesh::write_obj(voxels(cells, 1));
}

}  // namespace

TEST_CASE("hulls, cages, shells and deformed models are made from the command line", "[verbs_solid]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  const Json hulls = Json::parse(
      run_program({"hulls", "house.obj", "-o", "hulls.obj", "--max-vertices", "8", "--json"}, in(folder))
          .out);
  CHECK(hulls["parts"] == 1);
  REQUIRE(hulls["bodies"].size() == 1);
  CHECK(hulls["bodies"][0]["vertices"].get<int>() <= 8);
  CHECK(run_program({"hulls", "house.obj", "-o", "house.urdf"}, in(folder)).exit_code == 0);
  CHECK(folder.names() == std::set<std::string>{"house.obj", "hulls.obj", "house.urdf", "house-visual.obj",
                                                "house-hull-1.obj"});
  CHECK(run_program({"cage", "house.obj", "-o", "cage.off", "--faces", "80"}, in(folder)).exit_code == 0);
  CHECK(run_program({"deform", "house.obj", "--cage", "cage.off", "--to", "cage.off", "-o", "same.obj"},
                    in(folder))
            .exit_code == 0);
  // A cage that doesn't move moves nothing.
  const Json before = Json::parse(run_program({"info", "house.obj", "--json"}, in(folder)).out);
  const Json after = Json::parse(run_program({"info", "same.obj", "--json"}, in(folder)).out);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(after["size"][i].get<double>() == Approx(before["size"][i].get<double>()).margin(1e-3));
  }
  CHECK(run_program({"shell", "house.obj", "-o", "shell.ply", "--opening", "10%"}, in(folder)).exit_code ==
        0);
  const Json shell = Json::parse(run_program({"info", "shell.ply", "--json"}, in(folder)).out);
  CHECK(shell["components"] == 1);

  CHECK(run_program({"hulls", "house.obj", "-o", "hulls.stl"}, in(folder)).exit_code == 2);
  CHECK(run_program({"hulls", "house.obj"}, in(folder)).exit_code == 2);
  CHECK(run_program({"shell", "house.obj", "-o", "x.obj", "--opening", "0"}, in(folder)).exit_code == 2);
  CHECK(run_program({"deform", "house.obj", "--cage", "cage.off", "--to", "house.obj", "-o", "x.obj"},
                    in(folder))
            .exit_code == 4);
  CHECK_FALSE(fs::exists(folder / "x.obj"));
}

TEST_CASE("hulls and cages take the options of parts that segment has", "[verbs_solid]") {
  const TemporaryFolder folder;
  write_bytes(folder / "table.obj", table());
  const auto parts = [&](std::vector<std::string> arguments) {
    arguments.push_back("--json");
    return Json::parse(run_program(arguments, in(folder)).out)["parts"];
  };
  CHECK(parts({"hulls", "table.obj", "-o", "a.obj"}) == 5);
  CHECK(parts({"hulls", "table.obj", "-o", "b.obj", "--parts", "3"}) == 3);
  CHECK(parts({"hulls", "table.obj", "-o", "c.obj", "--concavity", "1"}) == 1);
  CHECK(parts({"hulls", "table.obj", "-o", "f.obj", "--concavity", "10m"}) == 1);
  CHECK(parts({"hulls", "table.obj", "-o", "g.obj", "--concavity", "0.1mm"}) == 5);
  CHECK(parts({"cage", "table.obj", "-o", "d.obj", "--parts", "2"}) == 2);
  CHECK(parts({"hulls", "table.obj", "-o", "e.obj", "--effort", "3", "--planes"}) ==
        parts({"segment", "table.obj", "--effort", "3", "--planes"}));
  check_refusal(run_program({"hulls", "table.obj", "-o", "x.obj", "--parts", "3", "--planes"}, in(folder)), 2,
                "--parts");
  check_refusal(run_program({"hulls", "table.obj", "-o", "x.obj", "--parts", "999"}, in(folder)), 2, "999");
}

TEST_CASE("hulls say how well they fit, and keep to their limits", "[verbs_solid]") {
  const TemporaryFolder folder;
  write_bytes(folder / "table.obj", table());
  const auto told = [&](std::vector<std::string> options) {
    std::vector<std::string> words{"hulls", "table.obj", "-o", "a.obj", "--overwrite", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_program(words, in(folder));
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(outcome.out);
  };
  const Json all = told({});
  CHECK(all["uncovered"].get<double>() <= 1e-3);
  CHECK(all["volume_ratio"].get<double>() == Approx(1.0).margin(0.02));
  CHECK(all["notes"].empty());
  const Json few = told({"--max-hulls", "3", "--max-vertices", "16"});
  CHECK(few["parts"] == 5);
  CHECK(few["bodies"].size() == 3);
  CHECK(few["uncovered"].get<double>() <= 1e-3);
  CHECK(few["volume_ratio"].get<double>() > 1.1);
  // What isn't closed encloses nothing that is known.
  write_bytes(folder / "sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome sheet = run_program({"hulls", "sheet.obj", "-o", "s.obj", "--json"}, in(folder));
  CHECK(Json::parse(sheet.out)["uncovered"].is_null());
  CHECK(Json::parse(sheet.out)["notes"].dump().find("closed") != std::string::npos);
  check_refusal(run_program({"hulls", "table.obj", "-o", "x.obj", "--max-hulls", "0"}, in(folder)), 2,
                "--max-hulls");
}

TEST_CASE("a cage has to be closed, and is told of when it doesn't surround the model", "[verbs_solid]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  // A box with points from `low` to `high` in each direction, its last triangles left out or turned around.
  const auto box = [](const std::string& low, const std::string& high, const std::string& last) {
    std::string text;
    for (const char* corner : {"000", "100", "110", "010", "001", "101", "111", "011"}) {
      text += "v";
      for (const char* c = corner; *c != '\0'; ++c) {
        text += " " + (*c == '1' ? high : low);
      }
      text += "\n";
    }
    return text +
           "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\n"
           "f 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\n" +
           last;
  };
  const std::string whole = "f 4 5 8\n";
  const auto deform = [&](const std::string& cage) {
    write_bytes(folder / "cage.obj", cage);
    return run_program({"deform", "house.obj", "--cage", "cage.obj", "--to", "cage.obj", "-o", "moved.obj"},
                       in(folder));
  };
  const auto notes = [&](const std::string& cage) {
    write_bytes(folder / "cage.obj", cage);
    const Outcome outcome = run_program(
        {"deform", "house.obj", "--cage", "cage.obj", "--to", "cage.obj", "-o", "moved.obj", "--json"},
        in(folder));
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return Json::parse(outcome.out)["notes"];
  };
  check_refusal(deform(box("-1", "7", "")), 4, "cage.obj isn't closed, as a cage has to be: 3 edges have a");
  check_refusal(deform(box("-1", "7", "f 4 8 5\n")), 4, "3 edges lie between triangles that face opposite");
  check_refusal(deform(box("-1", "7", whole + "f 1 2 9\nf 2 1 9\nv 0 0 9\n")), 4,
                "1 edge has more than two triangles");
  CHECK_FALSE(fs::exists(folder / "moved.obj"));

  CHECK(notes(box("-1", "7", whole)).empty());
  // The house is 4 x 5 x 6: its corner at the origin lies on these boxes, which isn't outside.
  CHECK(notes(box("0", "6", whole)).empty());
  CHECK(notes(box("0", "5", whole))[0]["text"] ==
        "2 of 10 points lie outside cage.obj, where they follow it less well");
  CHECK(notes(box("8", "9", whole)).size() == 1);
  // Two boxes that overlap; and a format in which each triangle has points of its own.
  std::string second = box("-0.5", "8", whole);
  for (std::size_t at = second.find("f "); at != std::string::npos; at = second.find("f ", at + 1)) {
    // Points counted from the end mean those of this box.
    for (std::size_t k = at + 2; second[k] != '\n'; ++k) {
      if (second[k] != ' ') {
        const int number = second[k] - '0';
        const std::string from_end = std::to_string(number - 9);
        second.replace(k, 1, from_end);
        k += from_end.size() - 1;
      }
    }
  }
  CHECK(notes(box("-1", "4.5", whole) + second).empty());
  const std::string stl = [] {
    const double p[8][3] = {{-1, -1, -1}, {7, -1, -1}, {7, 7, -1}, {-1, 7, -1},
                            {-1, -1, 7},  {7, -1, 7},  {7, 7, 7},  {-1, 7, 7}};
    const int f[12][3] = {{1, 3, 2}, {1, 4, 3}, {5, 6, 7}, {5, 7, 8}, {1, 2, 6}, {1, 6, 5},
                          {2, 3, 7}, {2, 7, 6}, {3, 4, 8}, {3, 8, 7}, {4, 1, 5}, {4, 5, 8}};
    std::string text = "solid cage\n";
    for (const auto& triangle : f) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : triangle) {
        text += "vertex";
        for (const double x : p[corner - 1]) {
          text += " " + std::to_string(x);
        }
        text += "\n";
      }
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid cage\n";
  }();
  CHECK(notes(stl).empty());
}

TEST_CASE("what was made from a model is replaced when it is made again", "[verbs_solid]") {
  const TemporaryFolder folder;
  write_bytes(folder / "house.obj", house);
  for (const char* output : {"hulls.obj", "hulls.urdf"}) {
    CAPTURE(output);
    CHECK(run_program({"hulls", "house.obj", "-o", output}, in(folder)).exit_code == 0);
    CHECK(run_program({"hulls", "house.obj", "-o", output}, in(folder)).exit_code == 0);
  }
  write_bytes(folder / "other-visual.obj", house);
  check_refusal(run_program({"hulls", "house.obj", "-o", "other.urdf"}, in(folder)), 7, "other-visual.obj");
}

TEST_CASE("all meshes of a robot have the numbers of the file, however extreme", "[verbs_solid]") {
  const TemporaryFolder folder;
  const auto tetrahedron = [](const std::string& size) {
    return "v 0 0 0\nv " + size + " 0 0\nv 0 " + size + " 0\nv 0 0 " + size +
           "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  };
  write_bytes(folder / "far.obj", tetrahedron("1e61"));
  REQUIRE(run_program({"hulls", "far.obj", "-o", "far.urdf"}, in(folder)).exit_code == 0);
  for (const char* mesh : {"far-visual.obj", "far-hull-1.obj"}) {
    CAPTURE(mesh);
    CHECK(read_bytes(folder / mesh).find("\nv 1e+61 0 0\n") != std::string::npos);
  }
  // Mass times the square of a length doesn't fit into a double here.
  write_bytes(folder / "farther.obj", tetrahedron("1e71"));
  check_refusal(run_program({"hulls", "farther.obj", "-o", "farther.urdf"}, in(folder)), 4, "farther.obj");
}

TEST_CASE("hulls of an earlier description go with it, and nothing else does", "[verbs_solid]") {
  const TemporaryFolder folder;
  write_bytes(folder / "table.obj", table());
  REQUIRE(run_program({"hulls", "table.obj", "-o", "t.urdf"}, in(folder)).exit_code == 0);
  REQUIRE(fs::exists(folder / "t-hull-5.obj"));
  // Somebody's own hull, and the same model's hulls under names that no description gives.
  write_bytes(folder / "t-hull-9.obj", house);
  REQUIRE(run_program({"hulls", "table.obj", "-o", "t-hull.obj"}, in(folder)).exit_code == 0);
  const std::set<std::string> kept{"table.obj", "t.urdf", "t-visual.obj", "t-hull.obj", "t-hull-9.obj"};
  const auto with = [&](std::set<std::string> more) {
    more.insert(kept.begin(), kept.end());
    return more;
  };
  REQUIRE(run_program({"hulls", "table.obj", "-o", "t.urdf", "--parts", "3"}, in(folder)).exit_code == 0);
  CHECK(folder.names() == with({"t-hull-1.obj", "t-hull-2.obj", "t-hull-3.obj"}));
  // The description of another model, made of one of the hulls: the model itself stays.
  REQUIRE(run_program({"hulls", "t-hull-3.obj", "-o", "t.urdf", "--overwrite"}, in(folder)).exit_code == 0);
  CHECK(folder.names() == with({"t-hull-1.obj", "t-hull-3.obj"}));
}

TEST_CASE("hulls that close openings are told, with what keeps them open", "[verbs_solid]") {
  const TemporaryFolder folder;
  // A frame of eight cubes around a hole, and a table, whose five hulls leave the room below it open.
  std::vector<std::array<int, 3>> frame;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (x != 1 || y != 1) {
        frame.push_back({x, y, 0});
      }
    }
  }
  write_bytes(folder / "frame.obj", ridgecraft::mesh::write_obj(voxels(frame, 1)));
  write_bytes(folder / "table.obj", table());
  const auto notes = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "hulls");
    words.insert(words.end(), {"-o", "h.obj", "--overwrite", "--json"});
    return Json::parse(run_program(words, in(folder)).out)["notes"];
  };
  const Json closed = notes({"frame.obj", "--parts", "1"});
  REQUIRE(closed.size() == 1);
  CHECK(closed[0]["code"] == "hulls_close_openings");
  CHECK(closed[0]["text"].get<std::string>().find("--pockets") != std::string::npos);
  CHECK(notes({"table.obj"}).empty());
}
