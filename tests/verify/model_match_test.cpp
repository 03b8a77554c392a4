// SPDX-License-Identifier: GPL-3.0-or-later
// Nets against the model that they are said to be of.
#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>

#include "support/temporary_folder.hpp"
#include "verify/geometry/geometry.hpp"
#include "verify/support.hpp"

using namespace ridgecraft;

namespace {

/// A cube from 0 to 1 of 12 triangles.
verify::ModelSurface unit_cube() {
  verify::ModelSurface cube;
  for (int i = 0; i < 8; ++i) {
    cube.points.push_back(
        {static_cast<double>(i % 2), static_cast<double>(i / 2 % 2), static_cast<double>(i / 4)});
  }
  for (const auto& q : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}}) {
    cube.faces.push_back({q[0], q[1], q[2]});
    cube.faces.push_back({q[0], q[2], q[3]});
  }
  return cube;
}

constexpr int model_promise = 9;

}  // namespace

TEST_CASE("the nets of the samples are their models'", "[model][slow]") {
  for (const char* name : {"gem.stl", "house.obj", "torus.off", "vase.ply"}) {
    for (const std::vector<std::string>& options : {std::vector<std::string>{},
                                                    {"--faces", "keep", "--scale", "0.7"},
                                                    {"--faces", "40", "--size", "9cm"}}) {
      const test::WrittenJob job(test::sample(name), options);
      const verify::Report report = test::verify_model(job.fold, test::surface_of(test::sample(name)));
      INFO(name << ' ' << (options.empty() ? "" : options[1]) << ": " << test::first_fault(report));
      CHECK(report.sound());
      REQUIRE(report.model.has_value());
      CHECK(report.model->same_file == true);
      const bool counted = !options.empty() && options[1] == "40";
      CHECK(report.model->allowed_mm.has_value() == !counted);
      CHECK(report.model->deviation_mm < (counted ? 30.0 : 0.001));
      if (!options.empty() && !counted) {
        CHECK(report.model->mm_per_unit == Approx(0.7));
      }
    }
  }
}

TEST_CASE("another model, another scale, a dent and a hole are found", "[model]") {
  const test::WrittenJob job(test::sample("house.obj"), {"--faces", "keep", "--scale", "1.5"});
  const verify::ModelSurface house = test::surface_of(test::sample("house.obj"));
  CHECK(test::verify_model(job.fold, house).sound());
  const auto broken = [&](const verify::ModelSurface& other) {
    return test::broken(test::verify_model(job.fold, other)) == std::vector<int>{model_promise};
  };
  CHECK(broken(test::surface_of(test::sample("fish.obj"))));
  verify::ModelSurface other = house;
  for (Vec3& p : other.points) {
    p = 1.001 * p;
  }
  CHECK(broken(other));
  other = house;
  other.points[other.faces[10][0]].z += 0.05;
  CHECK(broken(other));
  other = house;
  other.faces.pop_back();
  CHECK(broken(other));
  other = house;
  for (Vec3& p : other.points) {
    p = {-p.y, p.x, p.z};
  }
  CHECK(broken(other));
  // The model somewhere else is the same model.
  other = house;
  for (Vec3& p : other.points) {
    p += Vec3{100, -7, 3};
  }
  CHECK_FALSE(broken(other));
  // Each face twice: every point is where it should be, and still it is twice the paper.
  other = house;
  other.faces.insert(other.faces.end(), house.faces.begin(), house.faces.end());
  CHECK(broken(other));
}

TEST_CASE("nets of another program are laid on the model by their sizes", "[model]") {
  const auto json = test::cube_file();
  verify::ModelSurface cube = unit_cube();
  const verify::Report report = test::verify_model(json.dump(), cube);
  INFO(test::first_fault(report));
  CHECK(report.sound());
  CHECK(report.model->mm_per_unit == Approx(40.0));
  CHECK_FALSE(report.model->same_file.has_value());
  cube.points[7] += Vec3{0.0, 0.0, -0.01};
  CHECK(test::broken(test::verify_model(json.dump(), cube)) == std::vector<int>{model_promise});
}

TEST_CASE("a simplified surface may leave the model by what its settings allow", "[model]") {
  auto json = test::cube_file();
  verify::ModelSurface cube = unit_cube();
  // A ridge on top: 0.4 mm at the size of the nets, which is 1 % of the size.
  cube.points.push_back({0.5, 0.5, 1.01});
  cube.faces.resize(10);
  for (const auto& [a, b] : std::vector<std::array<std::uint32_t, 2>>{{4, 5}, {5, 7}, {7, 6}, {6, 4}}) {
    cube.faces.push_back({a, b, 8});
  }
  CHECK_FALSE(test::verify_model(json.dump(), cube).sound());
  json["ridgecraft:settings"]["faces"] = "auto";
  const verify::Report report = test::verify_model(json.dump(), cube);
  CHECK(report.sound());
  CHECK(report.model->deviation_mm == Approx(0.3).margin(0.15));
  CHECK(report.model->allowed_mm.value() == Approx(2.0).margin(0.02));
  cube.points[8].z = 1.12;
  CHECK_FALSE(test::verify_model(json.dump(), cube).sound());
  json["ridgecraft:settings"]["faces"] = 12;
  CHECK(test::verify_model(json.dump(), cube).sound());
}

TEST_CASE("the nearest point of a triangle", "[model]") {
  const verify::Triangle3 t{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};
  CHECK(verify::nearest_on(t, {1, 1, 5}) == Vec3{1, 1, 0});
  CHECK(verify::nearest_on(t, {-1, -1, 5}) == Vec3{0, 0, 0});
  CHECK(verify::nearest_on(t, {2, -3, 1}) == Vec3{2, 0, 0});
  CHECK(verify::nearest_on(t, {4, 4, 0}) == Vec3{2, 2, 0});
  CHECK(verify::nearest_on({Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{2, 0, 0}}, {3, 1, 0}) == Vec3{3, 0, 0});
}

namespace {

/// A box of quads, with a floor or without; `first`: number of its first point in the file.
void write_box(std::ostream& out, Vec3 low, Vec3 high, bool floor, int first) {
  for (int i = 0; i < 8; ++i) {
    out << "v " << (i % 2 == 0 ? low.x : high.x) << ' ' << (i / 2 % 2 == 0 ? low.y : high.y) << ' '
        << (i / 4 == 0 ? low.z : high.z) << '\n';
  }
  for (const auto& q : std::vector<std::array<int, 4>>{
           {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}, {0, 2, 3, 1}}) {
    if (floor || q[0] != 0 || q[1] != 2) {
      out << "f " << q[0] + first << ' ' << q[1] + first << ' ' << q[2] + first << ' ' << q[3] + first
          << '\n';
    }
  }
}

}  // namespace

TEST_CASE("what is left out as too small needn't be in the nets, all else must", "[model]") {
  const test::TemporaryFolder folder;
  const std::filesystem::path model = folder / "mast.obj";
  const auto write = [&](double width) {
    std::ofstream out(model);
    write_box(out, {0, 0, 0}, {150, 100, 80}, true, 1);
    write_box(out, {70, 50, 80}, {70 + width, 50 + width, 105}, true, 9);
  };
  write(2.0);
  const test::WrittenJob job(model, {"--size", "150mm"});
  CHECK(test::verify_model(job.fold, test::surface_of(model)).sound());
  write(20.0);
  const verify::Report report = test::verify_model(job.fold, test::surface_of(model));
  CHECK(test::broken(report) == std::vector<int>{model_promise});
}

TEST_CASE("nets of bodies that became one skin", "[model]") {
  // A tower without a floor, a bay that sticks out of its wall and is open below, a chest inside.
  const test::TemporaryFolder folder;
  const std::filesystem::path model = folder / "tower.obj";
  const auto write = [&](double bay) {
    std::ofstream out(model);
    write_box(out, {0, 0, 0}, {2, 2, 3}, false, 1);
    write_box(out, {1, 0.5, 1.5}, {2 + bay, 1.5, 2.5}, false, 9);
    write_box(out, {0.5, 0.5, 0.25}, {1, 1, 0.75}, true, 17);
  };
  write(1.0);
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--faces", "keep"}, {}, {"--faces", "keep", "--scale", "20"}}) {
    const test::WrittenJob job(model, options);
    CHECK(job.fold.find("\"bodies\": \"united\"") != std::string::npos);
    const verify::Report report = test::verify_model(job.fold, test::surface_of(model));
    INFO(test::first_fault(report));
    CHECK(report.sound());
    CHECK(report.model->deviation_mm < 0.001);
    // Without the setting what is hidden is missing.
    std::string without = job.fold;
    without.replace(without.find("\"bodies\": \"united\", "), std::string("\"bodies\": \"united\", ").size(),
                    "");
    CHECK(test::broken(test::verify_model(without, test::surface_of(model))) ==
          std::vector<int>{model_promise});
  }
  // Kept as they are, all is there.
  const test::WrittenJob kept(model, {"--faces", "keep", "--keep-bodies"});
  CHECK(kept.fold.find("\"bodies\"") == std::string::npos);
  CHECK(test::verify_model(kept.fold, test::surface_of(model)).sound());
  // A bay that is seen, but isn't in the nets.
  const test::WrittenJob job(model, {"--faces", "keep"});
  verify::ModelSurface other = test::surface_of(model);
  for (Vec3& p : other.points) {
    p.z = p.z == 2.5 ? 2.75 : p.z;
  }
  CHECK(test::broken(test::verify_model(job.fold, other)) == std::vector<int>{model_promise});
}

TEST_CASE("a model that lies far from the origin is held against its nets all the same", "[model]") {
  const test::TemporaryFolder folder;
  std::string obj;
  for (const Vec3 p : unit_cube().points) {
    obj += "v " + std::to_string(1000000000000000 + static_cast<int>(p.x)) + " " +
           std::to_string(1000000000000000 + static_cast<int>(p.y)) + " " +
           std::to_string(static_cast<int>(p.z)) + "\n";
  }
  for (const auto& [a, b, c] : unit_cube().faces) {
    obj += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  }
  test::write_bytes(folder / "far.obj", obj);
  const test::WrittenJob job(folder / "far.obj", {});
  const verify::Report report = test::verify_model(job.fold, test::surface_of(folder / "far.obj"));
  INFO(test::first_fault(report));
  CHECK(report.sound());
}

TEST_CASE("a body that can't be seen may be missing, one that can be seen may not", "[model]") {
  // Nets of a box around a cube: the cube is left out of them, and may be, as long as the box is closed.
  verify::ModelSurface model = unit_cube();
  for (Vec3& p : model.points) {
    p = 100.0 * p;
  }
  const auto add = [&](Vec3 at, double size) {
    const auto first = static_cast<std::uint32_t>(model.points.size());
    for (const Vec3 p : unit_cube().points) {
      model.points.push_back(at + size * p);
    }
    for (const auto& [a, b, c] : unit_cube().faces) {
      model.faces.push_back({first + a, first + b, first + c});
    }
  };
  const test::TemporaryFolder folder;
  std::string obj;
  for (const Vec3 p : model.points) {
    obj += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (const auto& [a, b, c] : model.faces) {
    obj += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  }
  test::write_bytes(folder / "box.obj", obj);
  const test::WrittenJob job(folder / "box.obj", {"--faces", "keep", "--scale", "1"});
  const std::string united =
      test::replaced(job.fold, "\"concavity\"", "\"bodies\": \"united\", \"concavity\"");
  const std::string& fold = job.fold.find("\"bodies\"") == std::string::npos ? united : job.fold;
  model.digest.clear();
  const auto is_sound = [&] {
    const verify::Report report = test::verify_model(fold, model);
    return std::ranges::none_of(test::broken(report), [](int promise) { return promise == model_promise; });
  };
  CHECK(is_sound());
  add({40, 40, 40}, 20.0);
  CHECK(is_sound());
  add({110, 40, 40}, 20.0);
  CHECK_FALSE(is_sound());
}
