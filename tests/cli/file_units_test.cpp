// SPDX-License-Identifier: GPL-3.0-or-later
// What a file says of its unit and of where up is: told, and used by --scale and for the metres of a .urdf.
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/program_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft::test;
using Json = nlohmann::json;

namespace {

/// A tetrahedron whose edges along the axes are one metre, 40 and 40 centimetres long.
void write_tetrahedron(const TemporaryFolder& folder) {
  const std::string zero(4, '\0');
  const std::string one("\0\0\x80\x3f", 4);
  const std::string less("\xcd\xcc\xcc\x3e", 4);
  write_bytes(folder / "t.bin", zero + zero + zero + one + zero + zero + zero + less + zero + zero + zero +
                                    less + std::string("\0\2\1\0\1\3\1\2\3\0\3\2", 12));
  write_bytes(folder / "t.gltf",
              R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"tent"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"buffers":[{"byteLength":60,"uri":"t.bin"}]})");
}

Json json_of(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.emplace_back("--json");
  const Outcome outcome = run_program(words, in(folder));
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  return Json::parse(outcome.out);
}

double largest(const Json& object) {
  return object.at("size_mm").at(0).get<double>();
}

}  // namespace

TEST_CASE("a --scale counts in the unit that the file tells, unless --unit tells another") {
  const TemporaryFolder folder;
  write_tetrahedron(folder);
  write_bytes(folder / "house.obj", house);
  const auto size = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"-o", "o.fold", "--overwrite"});
    return json_of(folder, all);
  };
  CHECK(largest(size({"t.gltf", "--scale", "1:10"})) == Approx(100.0));
  CHECK(largest(size({"t.gltf", "--scale", "10:1", "--unit", "cm"})) == Approx(100.0));
  CHECK(largest(size({"t.gltf"})) == Approx(150.0));
  const Json unfolded = json_of(folder, {"unfold", "t.gltf", "--scale", "1:10"});
  CHECK(largest(unfolded) == Approx(100.0));
  CHECK(unfolded.at("file_unit_mm") == 1000.0);
  // A format without units counts in millimetres, as before.
  const Json plain = size({"house.obj", "--scale", "10:1"});
  CHECK(largest(plain) == Approx(40.0));
  CHECK(plain.at("file_unit_mm").is_null());
  CHECK(plain.at("file_up").is_null());
}

TEST_CASE("nets of a file with a unit are found to be its nets") {
  const TemporaryFolder folder;
  write_tetrahedron(folder);
  REQUIRE(run_program({"t.gltf", "--scale", "1:10", "-o", "t.fold"}, in(folder)).exit_code == 0);
  const Outcome outcome = run_program({"verify", "t.fold", "--model", "t.gltf"}, in(folder));
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("the summary and info say what a file says of its unit and of where up is") {
  const TemporaryFolder folder;
  write_tetrahedron(folder);
  const Outcome paper = run_program({"t.gltf", "-o", "t.fold"}, in(folder));
  CHECK(paper.out.find("(--size 150mm; the file counts in metres, y up: this is 1:6.67 of its size)") !=
        std::string::npos);
  const Outcome info = run_program({"info", "t.gltf"}, in(folder));
  CHECK(info.out.find("metres, y points up: 1000 x 400 x 400 mm") != std::string::npos);
  const Json told = json_of(folder, {"info", "t.gltf"});
  CHECK(told.at("file_unit_mm") == 1000.0);
  CHECK(told.at("file_up") == "y");
}

TEST_CASE("a .urdf of a file with a unit is as large as the file says") {
  const TemporaryFolder folder;
  write_tetrahedron(folder);
  REQUIRE(run_program({"hulls", "t.gltf", "-o", "a.urdf"}, in(folder)).exit_code == 0);
  CHECK(read_bytes(folder / "a.urdf").find("scale=\"1 1 1\"") != std::string::npos);
  REQUIRE(run_program({"hulls", "t.gltf", "-o", "b.urdf", "--unit", "mm"}, in(folder)).exit_code == 0);
  CHECK(read_bytes(folder / "b.urdf").find("scale=\"0.001 0.001 0.001\"") != std::string::npos);
}
