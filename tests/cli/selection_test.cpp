// SPDX-License-Identifier: GPL-3.0-or-later
// --only and --without: a model's objects and materials by their names.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
using Json = nlohmann::json;

namespace {

/// A wide ground, and two tetrahedra on it; one has a material of its own.
const char* const scene =
    "v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\n"
    "v 0 0 0\nv 5 0 0\nv 0 5 0\nv 0 0 6\nv 8 0 0\nv 12 0 0\nv 8 4 0\nv 8 0 4\n"
    "o Ground\nf 1 2 3 4\no wheel.001\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\n"
    "o wheel.002\nusemtl Red\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n";

Json made_of(const TemporaryFolder& folder, std::vector<std::string> options) {
  options.insert(options.begin(), {"scene.obj", "--json", "--overwrite", "-o", "x.fold"});
  const Outcome outcome = run_program(options, in(folder));
  CAPTURE(outcome.err, outcome.out);
  REQUIRE(outcome.exit_code == 0);
  // What was left out isn't missed by the check against the model.
  const Outcome verified = run_program({"verify", "x.fold", "--model", "scene.obj"}, in(folder));
  CAPTURE(verified.out);
  CHECK(verified.exit_code == 0);
  return Json::parse(outcome.out);
}

}  // namespace

TEST_CASE("objects and materials are taken and left out by their names", "[selection]") {
  const TemporaryFolder folder;
  write_bytes(folder / "scene.obj", scene);
  const Json all = made_of(folder, {});
  CHECK(all["ground"] == "Ground");
  CHECK(all["faces"] == 10);
  const Json wheels = made_of(folder, {"--without", "ground"});
  CHECK(wheels["ground"].is_null());
  CHECK(wheels["faces"] == 8);
  CHECK(made_of(folder, {"--only", "wheel*"})["faces"] == 8);
  CHECK(made_of(folder, {"--only", "wheel.001", "--only", "Ground"})["faces"] == 6);
  CHECK(made_of(folder, {"--only", "Red"})["faces"] == 4);
  CHECK(made_of(folder, {"--only", "wheel*", "--without", "Red"})["faces"] == 4);
  // Without the ground the wheels are as large as the paper model is to be.
  CHECK(wheels["size_mm"][0].get<double>() == Approx(150.0));
  const Json fold = Json::parse(read_bytes(folder / "x.fold"));
  CHECK(fold["ridgecraft:settings"]["only"] == "wheel*");
  CHECK(fold["ridgecraft:settings"]["without"] == "Red");
}

TEST_CASE("a name that nothing has is refused with those that there are", "[selection]") {
  const TemporaryFolder folder;
  write_bytes(folder / "scene.obj", scene);
  check_refusal(run_program({"scene.obj", "--only", "wheels"}, in(folder)), 2,
                "nothing in the model is named 'wheels'; there are Ground, wheel.001, wheel.002 and Red");
  check_refusal(run_program({"scene.obj", "--without", "*"}, in(folder)), 2, "nothing is left of the model");
  write_bytes(folder / "scene.obj", house);
  check_refusal(run_program({"scene.obj", "--only", "roof"}, in(folder)), 2, "it has no names");
}

TEST_CASE("info lists the names", "[selection]") {
  const TemporaryFolder folder;
  write_bytes(folder / "scene.obj", scene);
  CHECK(run_program({"info", "scene.obj"}, in(folder)).out.find("Ground, wheel.001, wheel.002 and Red") !=
        std::string::npos);
  const Json told = Json::parse(run_program({"info", "scene.obj", "--json"}, in(folder)).out);
  CHECK(told["names"] == std::vector<std::string>{"Ground", "wheel.001", "wheel.002", "Red"});
}

TEST_CASE("the name of a plate stands for all that is on it", "[selection]") {
  const TemporaryFolder folder;
  std::string plates = scene;
  for (const auto& [name, longer] :
       {std::pair{"wheel.001", "plate1/wheel"}, std::pair{"wheel.002", "plate2/wheel"}}) {
    plates.replace(plates.find(name), std::string_view(name).size(), longer);
  }
  write_bytes(folder / "scene.obj", plates);
  CHECK(made_of(folder, {"--only", "plate1"})["faces"] == 4);
  CHECK(made_of(folder, {"--without", "plate1", "--without", "Ground"})["faces"] == 4);
  check_refusal(run_program({"scene.obj", "--only", "plate"}, in(folder)), 2,
                "nothing in the model is named 'plate'");
}
