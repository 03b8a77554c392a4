// SPDX-License-Identifier: GPL-3.0-or-later
// Hulls as simulators read them: URDF, MJCF, SDFormat, USD, GLB.
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "base/encodings.hpp"
#include "mesh/mesh.hpp"
#include "segment/segment.hpp"
#include "solid/solid.hpp"
#include "support/shapes.hpp"
#include "support/temporary_folder.hpp"

namespace ridgecraft {
namespace {

/// An L of five cells in centimetres, two hulls.
struct Described {
  mesh::Surface surface = test::voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {0, 0, 2}}, 1);
  std::vector<solid::Body> hulls =
      solid::model_hulls(surface, segment::segment(surface, {}, {}, Context{}), {}, Context{}).bodies;
  solid::RigidBody body{.name = "an \"L\" <&>",
                        .comment = "two -- dashes",
                        .visual_file = "l-visual.obj",
                        .mesh_files = {},
                        .metres_per_unit = 0.01,
                        .density = 500.0,
                        .mass = *solid::mass_properties(surface, Context{})};
  Described() {
    for (std::size_t i = 0; i < hulls.size(); ++i) {
      body.mesh_files.push_back("l-hull-" + std::to_string(i + 1) + ".obj");
    }
  }
  [[nodiscard]] solid::Body visual() const {
    solid::Body all;
    all.points.assign(surface.points().begin(), surface.points().end());
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      const auto [a, b, c] = surface.vertices(f);
      all.triangles.push_back({a.value(), b.value(), c.value()});
    }
    return all;
  }
};

/// 5 cells of 1 cm^3 at 500 kg/m^3.
constexpr double mass = 0.0025;

std::vector<double> numbers(const std::string& text) {
  std::vector<double> result;
  const char* at = text.c_str();
  char* end = nullptr;
  for (double x = std::strtod(at, &end); end != at; x = std::strtod(at, &end)) {
    result.push_back(x);
    at = end;
  }
  return result;
}

/// R diag R^T of a unit quaternion w, x, y, z, built from turned axes alone.
std::array<double, 6> tensor_of(const std::array<double, 3>& moments, const std::array<double, 4>& q) {
  const Vec3 v{q[1], q[2], q[3]};
  std::array<double, 6> sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 e{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    const Vec3 a = e + 2.0 * q[0] * cross(v, e) + 2.0 * cross(v, cross(v, e));
    const std::array<double, 6> products{a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z};
    for (std::size_t k = 0; k < 6; ++k) {
      sum[k] += moments[i] * products[k];
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("check_urdf accepts a model of hulls") {
  if (std::system("command -v check_urdf > /dev/null") != 0) {
    WARN("skipped: check_urdf isn't installed");
    return;
  }
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "l.urdf", solid::write_urdf(Described().body));
  const std::string command = "check_urdf '" + (folder / "l.urdf").string() + "' > /dev/null";
  CHECK(std::system(command.c_str()) == 0);
}

TEST_CASE("Principal moments and axes make the inertia that they come from") {
  const std::vector<std::array<double, 6>> tensors{{3, 2, 1, 0, 0, 0},
                                                   {2, 2, 2, 0, 0, 0},
                                                   {5, 4, 3, 1, -0.5, 0.25},
                                                   {1, 1, 2, 0.3, 0, 0},
                                                   {7e-9, 5e-9, 3e-9, 1e-9, 0, -1e-9}};
  for (const auto& tensor : tensors) {
    const solid::PrincipalInertia principal = solid::principal_inertia(tensor);
    CHECK(principal.moments[0] <= principal.moments[1]);
    CHECK(principal.moments[1] <= principal.moments[2]);
    const std::array<double, 6> again = tensor_of(principal.moments, principal.rotation);
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(again[k] == Approx(tensor[k]).margin(1e-12 * tensor[0]));
    }
  }
}

TEST_CASE("MJCF names its meshes, and has the mass of the model in metres") {
  const Described l;
  pugi::xml_document document;
  REQUIRE(document.load_string(solid::write_mjcf(l.body).c_str()));
  const pugi::xml_node root = document.child("mujoco");
  CHECK(root.attribute("model").as_string() == l.body.name);
  std::vector<std::string> files;
  for (const pugi::xml_node mesh : root.child("asset").children("mesh")) {
    files.emplace_back(mesh.attribute("file").as_string());
    CHECK(numbers(mesh.attribute("scale").as_string()) == std::vector{0.01, 0.01, 0.01});
  }
  REQUIRE(files.size() == 1 + l.hulls.size());
  CHECK(files.front() == "l-visual.obj");
  CHECK(files.back() == l.body.mesh_files.back());
  const pugi::xml_node body = root.child("worldbody").child("body");
  CHECK(body.child("inertial").attribute("mass").as_double() == Approx(mass));
  CHECK(numbers(body.child("inertial").attribute("fullinertia").as_string()).size() == 6);
  std::size_t geoms = 0;
  for (const pugi::xml_node geom : body.children("geom")) {
    geoms += std::string(geom.attribute("class").as_string()) == "collision" ? 1U : 0U;
  }
  CHECK(geoms == l.hulls.size());
}

TEST_CASE("SDFormat has a collision a hull, and the mass of the model in metres") {
  const Described l;
  pugi::xml_document document;
  REQUIRE(document.load_string(solid::write_sdf(l.body).c_str()));
  const pugi::xml_node model = document.child("sdf").child("model");
  CHECK(model.attribute("name").as_string() == l.body.name);
  const pugi::xml_node link = model.child("link");
  CHECK(link.child("inertial").child("mass").text().as_double() == Approx(mass));
  CHECK(numbers(link.child("inertial").child("pose").text().as_string())[0] ==
        Approx(0.01 * (3 * 0.5 + 1.5 + 2.5) / 5.0));
  std::size_t hulls = 0;
  for (const pugi::xml_node collision : link.children("collision")) {
    CHECK(collision.child("geometry").child("mesh").child("uri").text().as_string() ==
          l.body.mesh_files[hulls]);
    ++hulls;
  }
  CHECK(hulls == l.hulls.size());
}

TEST_CASE("USD says what is a rigid body, what is a convex hull, and how long its unit is") {
  const Described l;
  const std::string text = solid::write_usd(l.body, l.visual(), l.hulls);
  CHECK(text.starts_with("#usda 1.0\n"));
  CHECK(text.find("metersPerUnit = 0.01\n") != std::string::npos);
  CHECK(text.find("def Xform \"an__L_____\"") != std::string::npos);  // names are identifiers
  const std::string before = "physics:mass = ";
  CHECK(std::stod(text.substr(text.find(before) + before.size())) == Approx(mass));
  std::size_t hulls = 0;
  for (std::size_t at = text.find("approximation = \"convexHull\""); at != std::string::npos;
       at = text.find("approximation = \"convexHull\"", at + 1)) {
    ++hulls;
  }
  CHECK(hulls == l.hulls.size());
}

TEST_CASE("A GLB is read as the model that it shows, and its colliders are the hulls") {
  const Described l;
  const test::TemporaryFolder folder;
  const std::string bytes = solid::write_glb(l.body, l.visual(), l.hulls);
  test::write_bytes(folder / "l.glb", bytes);
  const mesh::Model shown = mesh::read((folder / "l.glb").string(), {}, Context{});
  CHECK(shown.polygon_count == l.surface.face_count());
  CHECK(shown.file_scale * shown.surface.bounds().size().x == Approx(0.03).epsilon(1e-6));

  const std::size_t length = static_cast<std::size_t>(little_endian(std::string_view(bytes).substr(12, 4)));
  const auto json = nlohmann::json::parse(bytes.substr(20, length));
  CHECK(little_endian(std::string_view(bytes).substr(8, 4)) == bytes.size());
  const auto& motion = json["nodes"][0]["extensions"]["KHR_physics_rigid_bodies"]["motion"];
  CHECK(motion["mass"].get<double>() == Approx(mass));
  std::size_t hulls = 0;
  for (const auto& child : json["nodes"][0]["children"]) {
    const auto& node = json["nodes"][child.get<std::size_t>()];
    if (!node.contains("extensions")) {
      continue;
    }
    const auto& geometry = node["extensions"]["KHR_physics_rigid_bodies"]["collider"]["geometry"];
    CHECK(geometry["convexHull"] == true);
    const auto& mesh =
        json["meshes"][json["nodes"][geometry["node"].get<std::size_t>()]["mesh"].get<std::size_t>()];
    const auto& points =
        json["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    CHECK(points["count"] == l.hulls[hulls].points.size());
    ++hulls;
  }
  CHECK(hulls == l.hulls.size());
}

}  // namespace ridgecraft
