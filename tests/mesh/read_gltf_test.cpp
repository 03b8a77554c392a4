// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/random.hpp"
#include "mesh/file_writers.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/text_scanner.hpp"
#include "mesh/seeds.hpp"
#include "reading.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::Colour;
using mesh::RepairKind;
using mesh::Soup;
namespace fs = std::filesystem;

namespace {

/// The points of a triangle strip of two, as float values: a square in the plane z = 0.
const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

struct Parts {
  std::string nodes = R"({"mesh":0})";
  std::string roots = "0";
  std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string points = float_bytes(square);
  std::string indices = std::string("\0\1\2\1\3\2", 6);
  std::string more;        ///< accessors behind the two
  std::string more_views;  ///< and their views
  std::string more_bytes;  ///< begin after 64 bytes
  std::string top;         ///< keys of the whole file
};

std::string json_of(const Parts& p, const std::string& buffer_keys = {}) {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],"meshes":[{{"primitives":[{}]}}],)"
      R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},)"
      R"({{"bufferView":1,"componentType":5121,"count":{},"type":"SCALAR"}}{}],)"
      R"("bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}{}],)"
      R"("buffers":[{{"byteLength":{}{}}}]{}}})",
      p.roots, p.nodes, p.primitive, p.points.size() / 12, p.indices.size(), p.more, p.points.size(),
      p.points.size(), p.indices.size(), p.more_views,
      std::max<std::size_t>(64, p.points.size() + p.indices.size()) + p.more_bytes.size(), buffer_keys,
      p.top);
}

std::string bytes_of(const Parts& p) {
  std::string bytes = p.points + p.indices;
  bytes.resize(std::max<std::size_t>(64, bytes.size()), '\0');
  return bytes + p.more_bytes;
}

std::string glb_of(const Parts& p) {
  return glb(json_of(p), bytes_of(p));
}

Soup read(const Parts& p) {
  return parsed(glb_of(p), "glb");
}

std::string why(const Parts& p) {
  return refusal(glb_of(p), "glb");
}

bool near(Vec3 a, Vec3 b) {
  return length(a - b) < 1e-12;
}

std::vector<Vec3> corners(const Soup& soup, std::size_t polygon) {
  std::vector<Vec3> points;
  for (const std::uint32_t p : soup.polygon(polygon)) {
    points.push_back(soup.points[p]);
  }
  return points;
}

}  // namespace

TEST_CASE("glTF: random triangles come back as GLB, as text, and with a file beside") {
  Random random(21);
  const TemporaryFolder folder(memory());
  for (int round = 0; round < 40; ++round) {
    Parts p;
    const std::uint32_t count = 3 + random.below(200);
    std::vector<float> values;
    for (std::uint32_t i = 0; i < 3 * count; ++i) {
      values.push_back(static_cast<float>(random.unit() * 200 - 100));
    }
    p.points = float_bytes(values);
    p.indices.clear();
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < 3 * (1 + random.below(60)); ++i) {
      wanted.push_back(random.below(count));
    }
    for (std::size_t i = 0; i < wanted.size() / 3 * 3; ++i) {
      p.indices.push_back(static_cast<char>(wanted[i]));
    }
    wanted.resize(p.indices.size());
    write_bytes(folder / "a b.bin", bytes_of(p));
    write_bytes(folder / "beside.gltf", json_of(p, R"(,"uri":"a%20b.bin")"));
    for (const Soup& soup :
         {read(p), parsed(json_of(p, ",\"uri\":\"data:;base64," + base64(bytes_of(p)) + "\""), "gltf"),
          mesh::read_soup(folder / "beside.gltf", {})}) {
      REQUIRE(soup.points.size() == count);
      for (std::uint32_t i = 0; i < count; ++i) {
        REQUIRE(soup.points[i] ==
                Vec3{double{values[3 * i]}, double{values[3 * i + 1]}, double{values[3 * i + 2]}});
      }
      REQUIRE(soup.corner_point == wanted);
      REQUIRE(soup.frame == mesh::FileFrame{1000.0, mesh::Axis::y});
    }
  }
}

TEST_CASE("glTF: what other files hold is part of a model's mark") {
  const TemporaryFolder folder(memory());
  Parts p;
  write_bytes(folder / "m.gltf", json_of(p, R"(,"uri":"m.bin")"));
  write_bytes(folder / "m.bin", bytes_of(p));
  const std::string digest = mesh::read(folder / "m.gltf", {}, {}).digest;
  p.points = float_bytes({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 2, 0});
  write_bytes(folder / "m.bin", bytes_of(p));
  CHECK(mesh::read(folder / "m.gltf", {}, {}).digest != digest);
}

TEST_CASE("glTF: strips and fans are triangles that face one way") {
  Parts p;
  p.indices = std::string("\0\1\2\3", 4);
  p.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5})";
  const Soup strip = read(p);
  CHECK(strip.corner_point == std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2});
  p.indices = std::string("\0\1\3\2", 4);
  p.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":6})";
  CHECK(read(p).corner_point == std::vector<std::uint32_t>{0, 1, 3, 0, 3, 2});
  // Strips are tied together by triangles without area.
  p.indices = std::string("\0\1\2\2\1\3", 6);
  p.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5})";
  CHECK(read(p).polygon_count() == 2);
  p.primitive = R"({"attributes":{"POSITION":0},"mode":5})";
  CHECK(read(p).corner_point == std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2});
  for (int mode = 0; mode < 4; ++mode) {
    p.primitive = fmt::format(R"({{"attributes":{{"POSITION":0}},"mode":{}}})", mode);
    CHECK(why(p) == "4 model.glb has points or lines, but no faces that could be unfolded");
  }
}

TEST_CASE("glTF: nodes place, turn, scale and mirror what they hold") {
  const Soup soup = parsed(rich_glb(), "glb");
  REQUIRE(soup.polygon_count() == 24);
  // The tetrahedron of volume 1/6, twice as large; again in its mirrored child; all with their outside
  // outside.
  const double large = 8.0 / 6.0;
  for (const std::size_t first : {0U, 4U, 8U, 12U}) {
    CHECK(signed_volume(soup, first, first + 4) == Approx(large));
  }
  CHECK(near(soup.points[soup.polygon(0)[0]], {1, 2, 3}));
  // x goes to (0.28, 0.96, 0) by the turn, twice as far by the scale.
  CHECK(near(soup.points[1], {1 + 2 * 0.28, 2 + 2 * 0.96, 3}));
  std::vector<std::string> names;
  for (const auto& object : soup.objects) {
    names.push_back(object.second);
  }
  CHECK(names == std::vector<std::string>{"left", "right", "", "strip"});
  CHECK(soup.objects[1].first == 8);
  CHECK(soup.remarks.count(RepairKind::motion_ignored) == 1);
  CHECK(soup.remarks.count(RepairKind::element_ignored) == 1);
}

TEST_CASE("glTF: a matrix and the three parts of it are the same") {
  Parts parts;
  parts.nodes = R"({"mesh":0,"translation":[1,2,3],"rotation":[0,0,0.6,0.8],"scale":[2,3,4]})";
  Parts matrix;
  matrix.nodes = R"({"mesh":0,"matrix":[0.56,1.92,0,0,-2.88,0.84,0,0,0,0,4,0,1,2,3,1]})";
  const Soup a = read(parts);
  const Soup b = read(matrix);
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    CHECK(near(a.points[i], b.points[i]));
  }
}

TEST_CASE("glTF: a mesh that many nodes hold is there as often") {
  Parts p;
  p.nodes = R"({"mesh":0,"name":"a"},{"mesh":0,"translation":[5,0,0]},{"mesh":0})";
  p.roots = "0,1";
  const Soup soup = read(p);
  CHECK(soup.polygon_count() == 4);
  CHECK(corners(soup, 2)[0] == Vec3{5, 0, 0});
  // Node 2 is in no scene.
  CHECK(soup.points.size() == 8);
}

TEST_CASE("glTF: joints and shape keys are taken at rest") {
  const Soup soup = parsed(rich_glb(), "glb");
  // The skinned mesh stands where its joint (node 0) does, not where its own node does.
  CHECK(near(corners(soup, 16)[0], {1, 2, 3}));
  // Half of the shape key, which holds the mesh's points themselves, is added to the strip: point 1 is
  // sparse.
  const std::vector<Vec3> strip = corners(soup, 20);
  CHECK(near(strip[0], {0, 0, 0}));
  CHECK(near(strip[1], {2.5, 0, 0}));
  CHECK(near(strip[2], {0, 1.5, 0}));
}

TEST_CASE("glTF: values may lie apart, and integers may stand for shares") {
  Parts p;
  // 16-bit corners, 8 bytes apart, as KHR_mesh_quantization has them.
  p.more = R"(,{"bufferView":2,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"})";
  p.more_views = R"(,{"buffer":0,"byteOffset":64,"byteLength":24,"byteStride":8})";
  const auto point = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return bytes2(x) + bytes2(y) + bytes2(z) + "..";
  };
  p.more_bytes = point(0, 0, 32767) + point(32767, 0, 0) + point(0, 0x8000, 0);
  p.primitive = R"({"attributes":{"POSITION":2}})";
  p.top = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  CHECK(corners(read(p), 0) == std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}});
}

TEST_CASE("glTF: colours are those that screens show") {
  Parts p;
  p.top = R"(,"materials":[{"name":"half","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1]}}])";
  p.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":0})";
  const Soup plain = read(p);
  REQUIRE(plain.materials.size() == 1);
  CHECK(plain.materials[0].name == "half");
  // Half of the light is 188 of 255 on a screen.
  CHECK(plain.materials[0].colour == Colour{1, 188 / 255.0, 0});
  CHECK(plain.polygon_material == std::vector<std::uint32_t>{0, 0});
  p.more = R"(,{"bufferView":2,"componentType":5126,"count":4,"type":"VEC3"})";
  p.more_views = R"(,{"buffer":0,"byteOffset":64,"byteLength":48})";
  p.more_bytes = float_bytes({1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0});
  p.primitive = R"({"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0})";
  const Soup own = read(p);
  REQUIRE(own.materials.size() == 2);
  CHECK(own.polygon_material == std::vector<std::uint32_t>{0, 1});
  CHECK(own.materials[0].colour == Colour{1, 188 / 255.0, 0});
  // Two of three corners: two thirds of the light.
  CHECK((*own.materials[1].colour)[0] == Approx(213 / 255.0));
  p.primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  CHECK(read(p).materials.empty());
}

TEST_CASE("glTF: pictures are found within the file and beside it, and nowhere else") {
  const TemporaryFolder folder(memory());
  fs::create_directories(folder / "in/sub");
  write_bytes(folder / "in/sub/a.png", tiny_png());
  write_bytes(folder / "outside.png", tiny_png());
  fs::create_symlink(folder / "outside.png", folder / "in/link.png");
  Parts p;
  p.more = R"(,{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"})";
  p.more_views =
      R"(,{"buffer":0,"byteOffset":64,"byteLength":32},{"buffer":0,"byteOffset":96,"byteLength":33})";
  p.more_bytes = float_bytes({0, 0, 1, 0, 0, 1, 1, 1}) + tiny_png();
  p.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0})";
  const auto with = [&](const std::string& image) {
    p.top =
        R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],)"
        R"("images":[)" +
        image + "]";
    write_bytes(folder / "in/m.glb", glb_of(p));
    return mesh::read_soup(folder / "in/m.glb", {});
  };
  const Soup within = with(R"({"bufferView":3,"mimeType":"image/png"})");
  REQUIRE(within.materials.size() == 1);
  REQUIRE(within.materials[0].picture);
  CHECK(*within.materials[0].picture == tiny_png());
  // v runs down in the file, and up in what is read.
  CHECK(within.texture_points[within.corner_texture[0]] == Vec2{0, 1});
  CHECK(within.texture_points[within.corner_texture[2]] == Vec2{0, 0});
  CHECK(within.remarks.entries().empty());
  const Soup beside = with(R"({"uri":"sub/a.png"})");
  CHECK(beside.materials[0].texture_file == "sub/a.png");
  REQUIRE(beside.materials[0].picture);
  CHECK(*beside.materials[0].picture == tiny_png());
  CHECK(*with(R"({"uri":"data:image/png;base64,)" + base64(tiny_png()) + "\"}").materials[0].picture ==
        tiny_png());
  for (const std::string uri :
       {"../outside.png", "sub/../../outside.png", "link.png", "https://example.org/a.png",
        "file:///etc/passwd", "/etc/passwd", "none.png", "%2e%2e/outside.png", "..\\\\outside.png"}) {
    INFO(uri);
    const Soup soup = with("{\"uri\":\"" + uri + "\"}");
    CHECK(soup.remarks.count(RepairKind::texture_missing) == 1);
    CHECK(soup.corner_texture.empty());
    CHECK_FALSE(soup.materials[0].has_picture());
  }
}

TEST_CASE("glTF: buffers lie in the model's folder or below") {
  const TemporaryFolder folder(memory());
  fs::create_directories(folder / "in/sub");
  const Parts p;
  write_bytes(folder / "in/sub/a.bin", bytes_of(p));
  write_bytes(folder / "a.bin", bytes_of(p));
  fs::create_symlink(folder.path(), folder / "in/up");
  const auto answer = [&](const std::string& uri) -> std::string {
    write_bytes(folder / "in/m.gltf", json_of(p, ",\"uri\":\"" + uri + "\""));
    try {
      (void)mesh::read_soup(folder / "in/m.gltf", {});
    } catch (const Error& error) {
      const std::string sentence = error.what();
      CHECK(error.kind() == ErrorKind::unreadable_input);
      return sentence.substr(sentence.find("its file"));
    }
    return {};
  };
  CHECK(answer("sub/a.bin").empty());
  CHECK(answer("./sub//a.bin").empty());
  CHECK(answer("sub\\\\a.bin").empty());
  for (const std::string uri : {"../a.bin", "up/a.bin", "sub/../../a.bin", "%2E%2E/a.bin"}) {
    CHECK(answer(uri).find("lies outside the model's folder, where nothing is read") != std::string::npos);
  }
  CHECK(answer("/dev/zero").find("outside") != std::string::npos);
  CHECK(answer("http://example.org/a.bin") ==
        "its file \"http://example.org/a.bin\" lies elsewhere: nothing is fetched, put the file beside the "
        "model and "
        "name it there");
  CHECK(answer("b.bin") == "its file \"b.bin\" was not found beside the model");
  CHECK(answer("sub") == "its file \"sub\" was not found beside the model");
  CHECK(refusal(json_of(p, R"(,"uri":"a.bin")"), "gltf") ==
        "3 model.gltf, buffers[0]: its file \"a.bin\" can't be found: nothing lies beside standard input");
}

TEST_CASE("glTF: what can't be read is refused with its place") {
  Parts p;
  const auto starts = [&](const std::string& start) {
    const std::string sentence = why(p);
    INFO(sentence);
    CHECK(sentence.starts_with(start));
    p = {};
  };
  p.indices = std::string("\0\1\4", 3);
  starts("3 model.glb, meshes[0].primitives[0]: it names point 4, but its points are numbered 0 to 3");
  p.indices = std::string("\0\1", 2);
  starts("3 model.glb, meshes[0].primitives[0]: its 2 corners are no triangles");
  p.points = float_bytes({0, 0, 0, 1, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 1, 1, 1});
  starts("4 model.glb, meshes[0].primitives[0]: a coordinate of point 2 is not finite");
  p.nodes = R"({"mesh":7})";
  starts("3 model.glb, nodes[0]: it names meshes[7], but there are only meshes[0] to meshes[0]");
  p.nodes = R"({"mesh":-1})";
  starts("3 model.glb, nodes[0]: \"mesh\" is no whole number");
  p.nodes = R"({"children":[1]},{"children":[0]})";
  starts("3 model.glb, nodes[0]: it is in two other nodes, or in itself");
  p.nodes = R"({"mesh":0,"matrix":[1,2]})";
  starts("3 model.glb, nodes[0]: \"matrix\" has 2 numbers instead of 16");
  p.nodes = R"({"mesh":0,"rotation":[0,0,0,0]})";
  starts("3 model.glb, nodes[0]: \"rotation\" is no turn");
  p.primitive = R"({"attributes":{"POSITION":4294967296}})";
  starts("3 model.glb, meshes[0].primitives[0].attributes: it names accessors[4294967296]");
  p.primitive = R"({"attributes":{"POSITION":1}})";
  starts("3 model.glb, accessors[1]: its elements have 1 numbers");
  p.more_views = R"(,{"buffer":0,"byteOffset":60,"byteLength":18446744073709551615})";
  p.more = R"(,{"bufferView":2,"componentType":5126,"count":1,"type":"VEC3"})";
  p.primitive = R"({"attributes":{"POSITION":2}})";
  starts("3 model.glb, bufferViews[2]: it ends after its buffer");
  p.more = R"(,{"bufferView":0,"componentType":5126,"count":6148914691236517206,"type":"VEC3"})";
  p.primitive = R"({"attributes":{"POSITION":2}})";
  starts("3 model.glb, accessors[2]: it");
  p.more = R"(,{"componentType":5126,"count":3,"type":"VEC3"})";
  p.primitive = R"({"attributes":{"POSITION":2}})";
  starts("3 model.glb, accessors[2]: nothing says where its values are");
  p.top = R"(,"extensionsRequired":["NEW_thing"])";
  starts("3 model.glb can only be read with the extension \"NEW_thing\", which isn't known");
  p.top = R"(,"extensionsRequired":["KHR_materials_unlit","KHR_texture_basisu"])";
  CHECK(why(p).empty());
  CHECK(refusal("{\"asset\":{}}", "gltf") ==
        "3 model.gltf can't be read as glTF: \"asset\" with its \"version\" is missing");
  CHECK(refusal(R"({"asset":{"version":"1.0"}})", "gltf").find("is a glTF 1.0 model, and only version 2") !=
        std::string::npos);
  CHECK(refusal(R"({"meshes":{}})", "gltf").find("is a glTF 1.0 model") != std::string::npos);
  CHECK(refusal("{\n\"asset\":{]", "gltf") == "3 model.gltf, line 2: this is no valid JSON");
  CHECK(refusal("{\n\"asset\":{", "gltf") == "3 model.gltf, line 2: the JSON ends here, cut off");
  CHECK(refusal("{\"asset\":1e999}", "gltf") == "3 model.gltf holds a number that is too large");
  CHECK(refusal(R"({"asset":{"version":"2.0"}})", "gltf") == "4 model.gltf has no faces");
}

TEST_CASE("glTF: GLB files that end early, and bytes after the end") {
  const std::string whole = glb_of({});
  for (std::size_t size = 12; size < whole.size(); ++size) {
    INFO(size);
    REQUIRE(refusal(whole.substr(0, size), "glb").find("is cut off") != std::string::npos);
  }
  const Soup soup = parsed(whole + "more", "glb");
  CHECK(soup.remarks.count(RepairKind::trailing_data_ignored) == 4);
  CHECK(parsed(whole, "obj").remarks.count(RepairKind::content_is_other_format) == 1);
}

TEST_CASE("glTF: a few bytes can't ask for much") {
  const std::size_t levels = 100'000;
  CHECK(refusal(R"({"asset":{"version":"2.0","extras":)" + std::string(levels, '[') +
                    std::string(levels, ']') + "}}",
                "gltf") == "3 model.gltf is nested more than 200 levels deep");
  // 10,000 primitives of 20,000 corners each.
  Parts p;
  p.points = float_bytes(std::vector<float>(3 * 20'000, 1.0F));
  p.indices = std::string(21'000, '\1');
  for (int i = 0; i < 10'000; ++i) {
    p.primitive += R"(,{"attributes":{"POSITION":0},"indices":1})";
  }
  CHECK(why(p) == "4 model.glb repeats its objects until they have more than 2000000 triangles");
}

TEST_CASE("glTF: a million small things beside each other are a matter of seconds") {
  std::string things = "0";
  for (int i = 0; i < 1'000'000; ++i) {
    things += ",{}";
  }
  const auto with = [](const std::string& extras) {
    return refusal(R"({"asset":{"version":"2.0"},"extras":[)" + extras + "]}", "gltf");
  };
  CHECK(with(things) == "4 model.gltf has no faces");
  CHECK(with(things + "," + things + "," + things + "," + things) ==
        "3 model.gltf has more than 4000000 values besides its buffers");
}

TEST_CASE("glTF: points that seams divide are joined in silence") {
  Parts p;
  p.points = float_bytes({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  p.indices = std::string("\0\1\2\3\5\4", 6);
  const mesh::Model model = mesh::read(mesh::ModelFile{glb_of(p), "m.glb", "m", {}}, {}, {});
  CHECK(model.surface.vertex_count() == 4);
  CHECK(model.repairs.count(RepairKind::points_joined) == 0);
  CHECK(model.frame.mm_per_unit == 1000.0);
}

namespace {

/// A tetrahedron with the corners (0,0,0), (2,0,0), (0,2,0), (0,0,2) by the encoders of Draco and meshopt.
constexpr std::string_view draco_tetrahedron =
    "RFJBQ08CAgEBAAAABAQBAwAAAS8BARD/"
    "AmZAAv8AAAAAAAEACQMAAAABAwkCAAEAAAAAAAAAAAAAAABAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAAAAAAAAQA"
    "AAAAAAAAAAAACAPwAAgD8AAAAAAACAPwAAAAAAAAAAAACAPwAAAAA=";
constexpr std::string_view meshopt_points =
    "oAAAAAE8AAAAgH8AAAABDwAAAIB/AAAAAQMAAACAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=";
constexpr std::string_view meshopt_corners = "4f4OAhHwBAB2h1ZneKmGZYlomAFpAAA=";

std::string compressed(std::string_view extension, const std::string& accessors, const std::string& views,
                       const std::string& primitive, const std::string& bytes) {
  return glb(
      fmt::format(
          R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
          R"("extensionsRequired":["{}"],"meshes":[{{"primitives":[{}]}}],"accessors":[{}],)"
          R"("bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
          extension, primitive, accessors, views, bytes.size()),
      bytes);
}

std::string draco_glb(const std::string& bytes) {
  return compressed(
      "KHR_draco_mesh_compression",
      R"({"componentType":5126,"count":4,"type":"VEC3"},{"componentType":5125,"count":12,"type":"SCALAR"},)"
      R"({"componentType":5126,"count":4,"type":"VEC2"})",
      fmt::format(R"({{"buffer":0,"byteLength":{}}})", bytes.size()),
      R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"extensions":{"KHR_draco_mesh_compression":)"
      R"({"bufferView":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}}})",
      bytes);
}

std::string meshopt_glb(const std::string& points, const std::string& corners) {
  const auto view = [](std::size_t at, std::size_t size, const char* rest, std::size_t unpacked) {
    return fmt::format(
        R"({{"buffer":0,"byteLength":{3},"extensions":{{"EXT_meshopt_compression":{{"buffer":0,)"
        R"("byteOffset":{0},"byteLength":{1},{2}}}}}}})",
        at, size, rest, unpacked);
  };
  return compressed(
      "EXT_meshopt_compression",
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"})",
      view(0, points.size(), R"("byteStride":12,"count":4,"mode":"ATTRIBUTES")", 48) + "," +
          view(points.size(), corners.size(), R"("byteStride":2,"count":12,"mode":"TRIANGLES")", 24),
      R"({"attributes":{"POSITION":0},"indices":1})", points + corners);
}

}  // namespace

TEST_CASE("glTF: primitives that name the same accessors have what Draco packed for each") {
  const std::string draco = mesh::from_base64(draco_tetrahedron).value();
  const auto primitive = [](int view, int indices) {
    return fmt::format(
        R"({{"attributes":{{"POSITION":0}},"indices":{},"extensions":{{"KHR_draco_mesh_compression":)"
        R"({{"bufferView":{},"attributes":{{"POSITION":0}}}}}}}})",
        indices, view);
  };
  const Soup soup = parsed(
      compressed(
          "KHR_draco_mesh_compression",
          R"({"componentType":5126,"count":4,"type":"VEC3"},)"
          R"({"componentType":5125,"count":12,"type":"SCALAR"},)"
          R"({"componentType":5125,"count":12,"type":"SCALAR"})",
          fmt::format(R"({{"buffer":0,"byteLength":{0}}},{{"buffer":0,"byteLength":{0}}})", draco.size()),
          primitive(0, 1) + "," + primitive(1, 2), draco),
      "glb");
  CHECK(soup.points.size() == 8);
  CHECK(soup.polygon_count() == 8);
  CHECK(signed_volume(soup, 0, 8) == Approx(16.0 / 6.0));
}

TEST_CASE("glTF: Draco and meshopt are unpacked, and damaged data is refused") {
  const std::string draco = mesh::from_base64(draco_tetrahedron).value();
  const std::string points = mesh::from_base64(meshopt_points).value();
  const std::string corners = mesh::from_base64(meshopt_corners).value();
  for (const std::string& bytes : {draco_glb(draco), meshopt_glb(points, corners)}) {
    const Soup soup = parsed(bytes, "glb");
    CHECK(soup.polygon_count() == 4);
    CHECK(signed_volume(soup, 0, 4) == Approx(8.0 / 6.0));
  }
  CHECK(refusal(draco_glb("DRACO" + std::string(60, 'x')), "glb").find("its Draco data is damaged") !=
        std::string::npos);
  CHECK(refusal(meshopt_glb(std::string(62, 'x'), corners), "glb").find("its meshopt data is damaged") !=
        std::string::npos);
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    std::string bytes = i % 2 == 0 ? draco_glb(draco) : meshopt_glb(points, corners);
    const std::size_t packed = i % 2 == 0 ? draco.size() : points.size() + corners.size();
    bytes[bytes.size() - 1 - random.below(static_cast<std::uint32_t>(packed))] =
        static_cast<char>(random.below(256));
    (void)refusal(bytes, "glb");
  }
}

TEST_CASE("glTF: copies by EXT_mesh_gpu_instancing stand where the file says") {
  Parts p;
  p.nodes = R"({"mesh":0,"translation":[0,0,5],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":)"
            R"({"TRANSLATION":2,"SCALE":3}}}})";
  p.more = R"(,{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"})"
           R"(,{"bufferView":2,"componentType":5126,"byteOffset":24,"count":2,"type":"VEC3"})";
  p.more_views = R"(,{"buffer":0,"byteOffset":64,"byteLength":48})";
  p.more_bytes = float_bytes({10, 0, 0, 0, 20, 0, 1, 1, 1, 3, 3, 3});
  const Soup soup = read(p);
  REQUIRE(soup.polygon_count() == 4);
  CHECK(near(corners(soup, 0)[0], {10, 0, 5}));
  CHECK(near(corners(soup, 0)[1], {11, 0, 5}));
  CHECK(near(corners(soup, 2)[0], {0, 20, 5}));
  CHECK(near(corners(soup, 2)[1], {3, 20, 5}));
}

TEST_CASE("glTF: a picture in WebP is taken, one in KTX2 is named") {
  const auto textured = [](const std::string& extension, const std::string& picture) {
    Parts p;
    p.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0})";
    p.more = R"(,{"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"})";
    p.top = fmt::format(
        R"(,"images":[{{"uri":"data:image/x;base64,{}"}}],"textures":[{{"extensions":{{"{}":{{"source":0)"
        R"(}}}}}}],"materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],)"
        R"("extensionsRequired":["{}"])",
        base64(picture), extension, extension);
    return read(p);
  };
  const std::string webp =
      mesh::from_base64(
          "UklGRjwAAABXRUJQVlA4TDAAAAAvAkAAAC8gECBI8R9pQyCQpLA/7AIBgiT/ceY/8IkhbBUoZBsBTu0egzO7iP7HeAE=")
          .value();
  const Soup soup = textured("EXT_texture_webp", webp);
  REQUIRE(soup.materials.size() == 1);
  REQUIRE(soup.materials[0].picture);
  CHECK(*soup.materials[0].picture == webp);
  const Soup named = textured("KHR_texture_basisu", "\xabKTX 20\xbb\r\n\x1a\n and more");
  REQUIRE(named.remarks.count(RepairKind::texture_missing) == 1);
  CHECK(named.remarks.entries().back().detail ==
        "images[0] is a KTX2 picture, which isn't read: save it as PNG");
}

TEST_CASE("glTF: what the file has and isn't used is told") {
  Parts p;
  p.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":0})";
  p.top = R"(,"materials":[{"alphaMode":"BLEND"}])";
  const Soup soup = read(p);
  REQUIRE(soup.remarks.count(RepairKind::feature_ignored) == 1);
  CHECK(soup.remarks.entries().back().detail == "transparency of 1 material");
}
