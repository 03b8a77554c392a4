// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft hulls, cage, shell and deform from outside.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

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
