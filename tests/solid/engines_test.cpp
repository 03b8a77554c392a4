// SPDX-License-Identifier: GPL-3.0-or-later
// Hulls in the engines that their formats are for: read by MuJoCo and Gazebo's reader, and ten of a kind
// stand on each other.
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <mujoco/mujoco.h>
#include <sdf/sdf.hh>

#include "support/program.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft {
namespace {

/// A flat box with a groove below, 40 x 40 x 10 mm: several hulls, and no part of it is convex as a whole.
std::string grooved() {
  std::string text;
  const std::vector<std::array<double, 2>> outline{{0, 0},  {10, 0}, {10, 4},  {30, 4},
                                                   {30, 0}, {40, 0}, {40, 10}, {0, 10}};
  for (const double y : {0.0, 40.0}) {
    for (const auto& [x, z] : outline) {
      text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    }
  }
  std::string faces;
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    faces += "4 " + std::to_string(i) + " " + std::to_string(i + 8) + " " + std::to_string(j + 8) + " " +
             std::to_string(j) + "\n";
  }
  faces += "8 0 1 2 3 4 5 6 7\n8 15 14 13 12 11 10 9 8\n";
  return "OFF\n16 10 0\n" + text + faces;
}

/// Makes hulls of it in a format; its file.
std::string written(const test::TemporaryFolder& folder, const std::string& suffix) {
  test::write_bytes(folder / "b.off", grooved());
  test::RunOptions in_folder;
  in_folder.folder = folder.path();
  REQUIRE(
      test::run_program({"hulls", "b.off", "-o", "b" + suffix, "--concavity", "0.02"}, in_folder).exit_code ==
      0);
  return (folder / ("b" + suffix)).string();
}

std::string read_text(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

}  // namespace

TEST_CASE("MuJoCo reads MJCF, and a stack of ten is at rest after five seconds") {
  const test::TemporaryFolder folder;
  std::string text = read_text(written(folder, ".xml"));
  // Debian's MuJoCo has no such attribute of meshes yet.
  const std::string shell = " inertia=\"shell\"";
  text.erase(text.find(shell), shell.size());
  // Ten of its bodies on each other, on a plane.
  const std::size_t from = text.find("    <body name=");
  const std::size_t to = text.find("</body>", from) + 8;
  std::string bodies = "    <geom type=\"plane\" size=\"1 1 0.1\"/>\n";
  for (int i = 0; i < 10; ++i) {
    std::string body = text.substr(from, to - from);
    body.replace(body.find("name=\"b\""), 8,
                 "name=\"b" + std::to_string(i) + "\" pos=\"0 0 " + std::to_string(0.01 * i) + "\"");
    for (std::size_t at = body.find("<geom class=\"collision\" name=\""); at != std::string::npos;
         at = body.find("<geom class=\"collision\" name=\"", at + 1)) {
      body.insert(at + 30, "b" + std::to_string(i) + "_");
    }
    bodies += body;
  }
  text.replace(from, to - from, bodies);
  test::write_bytes(folder / "stack.xml", text);

  std::array<char, 1000> error{};
  mjModel* const model = mj_loadXML((folder / "stack.xml").string().c_str(), nullptr, error.data(), 1000);
  INFO(error.data());
  REQUIRE(model != nullptr);
  // 40 x 40 x 10 mm without the groove of 20 x 40 x 4 mm, of 1,000 kg/m^3.
  CHECK(model->body_mass[1] == Approx(0.0128).epsilon(1e-6));
  mjData* const data = mj_makeData(model);
  while (data->time < 5.0) {
    mj_step(model, data);
  }
  double fastest = 0.0;
  for (int i = 0; i < model->nv; ++i) {
    // Of each body's six numbers the first three; soft contacts let it tremble.
    fastest = i % 6 < 3 ? std::fmax(fastest, std::fabs(data->qvel[i])) : fastest;
  }
  CHECK(fastest < 0.02);
  for (int i = 0; i < 10; ++i) {
    CHECK(data->qpos[7 * i + 2] == Approx(0.01 * i).margin(0.005));
    CHECK(std::hypot(data->qpos[7 * i], data->qpos[7 * i + 1]) < 0.002);
  }
  mj_deleteData(data);
  mj_deleteModel(model);
}

TEST_CASE("Gazebo's reader takes SDFormat as it is") {
  const test::TemporaryFolder folder;
  sdf::Root root;
  const sdf::Errors errors = root.Load(written(folder, ".sdf"));
  for (const sdf::Error& error : errors) {
    FAIL_CHECK(error.Message());
  }
  REQUIRE(root.Model() != nullptr);
  const sdf::Link& link = *root.Model()->LinkByIndex(0);
  CHECK(link.CollisionCount() >= 2);
  CHECK(link.Inertial().MassMatrix().Mass() == Approx(0.0128).epsilon(1e-6));
  CHECK(link.Inertial().MassMatrix().IsValid());
}

}  // namespace ridgecraft
