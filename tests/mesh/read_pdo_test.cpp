// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/pdo/read_pdo.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <zlib.h>

#include "base/random.hpp"
#include "mesh/file_writers.hpp"
#include "mesh/mesh.hpp"
#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::RepairKind;
using mesh::Soup;

namespace {

std::vector<PdoStyle> all_styles() {
  std::vector<PdoStyle> styles;
  for (const std::uint32_t version : {4U, 5U, 6U}) {
    for (const std::uint32_t shift : {0U, 77U, 230U}) {
      styles.push_back({version, false, false, shift, false});
      styles.push_back({version, true, false, shift, false});
      styles.push_back({version, true, true, shift, false});
    }
  }
  return styles;
}

std::string told(const PdoStyle& style) {
  return fmt::format("version {}, wide {}, length in bytes {}, shift {}", style.version, style.wide,
                     style.length_in_bytes, style.shift);
}

PdoTestFile cube_file() {
  PdoTestFile file;
  file.objects = {pdo_cube()};
  return file;
}

std::string pdo_refusal(const PdoTestFile& file, const PdoStyle& style = {}) {
  return refusal(pdo(file, style), "pdo");
}

/// Edges of the cube by the numbers of their ends, from their places.
using Edges = std::set<std::array<int, 2>>;
Edges edges_of(const std::vector<std::array<Vec3, 2>>& segments) {
  const auto number = [](Vec3 p) { return (p.x > 1 ? 1 : 0) + (p.y > 1 ? 2 : 0) + (p.z > 1 ? 4 : 0); };
  Edges edges;
  for (const auto& [a, b] : segments) {
    edges.insert({std::min(number(a), number(b)), std::max(number(a), number(b))});
  }
  return edges;
}

/// The bytes that a chunk of a PNG file holds.
std::string chunk(const std::string& png, const std::string& kind) {
  const std::size_t at = png.find(kind);
  std::size_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    size = size << 8U | static_cast<unsigned char>(png[at - 4 + i]);
  }
  return png.substr(at + 4, size);
}

}  // namespace

TEST_CASE("PDO: models of all versions and all kinds of strings come back") {
  Random random(3);
  const auto coordinate = [&] { return static_cast<double>(random.below(1U << 30U)) / 1e4 - 5e4; };
  for (const PdoStyle& style : all_styles()) {
    INFO(told(style));
    PdoTestFile file;
    for (const std::string name : {"left", "right"}) {
      PdoTestObject object;
      object.name = name;
      for (int i = 0; i < 20; ++i) {
        object.points.push_back({coordinate(), coordinate(), coordinate()});
      }
      for (int i = 0; i < 12; ++i) {
        PdoTestFace face;
        for (std::uint32_t k = 0; k < 3 + random.below(4); ++k) {
          face.points.push_back(random.below(20));
        }
        object.faces.push_back(face);
      }
      file.objects.push_back(object);
    }
    const Soup soup = parsed(pdo(file, style), "pdo");
    REQUIRE(soup.format == mesh::FileFormat::pdo);
    CHECK(soup.remarks.entries().empty());
    REQUIRE(soup.objects.size() == 2);
    CHECK(soup.objects[0].second == "left");
    CHECK(soup.objects[1].second == "right");
    std::size_t polygon = 0;
    for (const PdoTestObject& object : file.objects) {
      for (const PdoTestFace& face : object.faces) {
        const auto corners = soup.polygon(polygon++);
        REQUIRE(corners.size() == face.points.size());
        for (std::size_t k = 0; k < corners.size(); ++k) {
          CHECK(soup.points[corners[k]] == object.points[face.points[k]]);
        }
      }
    }
    CHECK(polygon == soup.polygon_count());
  }
}

TEST_CASE("PDO: a cube is closed, and its unit is what the nets make of it") {
  PdoTestFile file = cube_file();
  file.scale = 25.0;
  const mesh::Model model = mesh::read(mesh::ModelFile{pdo(file), "m.pdo", "m", {}}, {}, {});
  CHECK(model.surface.face_count() == 12);
  CHECK(model.surface.vertex_count() == 8);
  CHECK(model.repairs.entries().empty());
  CHECK(model.frame.mm_per_unit == 25.0);
  CHECK_FALSE(model.frame.up.has_value());
  file.scale.reset();
  CHECK_FALSE(parsed(pdo(file), "pdo").frame.mm_per_unit.has_value());
  file.scale = -1.0;
  CHECK_FALSE(parsed(pdo(file), "pdo").frame.mm_per_unit.has_value());
}

TEST_CASE("PDO: faces have the colours and pictures of the file") {
  const Soup soup = parsed(pdo(rich_pdo_file()), "pdo");
  REQUIRE(soup.materials.size() == 2);
  CHECK(soup.materials[0].name == "red");
  CHECK(soup.materials[0].colour == mesh::Colour{1.0, 0.5, 0.25});
  CHECK(soup.polygon_material ==
        std::vector<std::uint32_t>{1, 0, Soup::none, Soup::none, Soup::none, Soup::none});
  // Corner 0 of the first face lies at the picture's lower left, which is the origin.
  REQUIRE(soup.corner_texture.at(0) != Soup::none);
  CHECK(soup.texture_points.at(soup.corner_texture[0]) == Vec2{0, 0});
  CHECK(soup.texture_points.at(soup.corner_texture[3]) == Vec2{0, 1});
  CHECK(soup.corner_texture[4] == Soup::none);
  // The hidden triangle is told.
  CHECK(soup.polygon_count() == 6);
  CHECK(soup.remarks.count(RepairKind::element_ignored) == 1);
  // The picture, unpacked again, row after row.
  REQUIRE(soup.materials[1].picture != nullptr);
  const std::string& png = *soup.materials[1].picture;
  CHECK(chunk(png, "IHDR") == std::string("\0\0\0\2\0\0\0\2\x08\2\0\0\0", 13));
  const std::string packed = chunk(png, "IDAT");
  std::string rows(100, '\0');
  uLongf size = rows.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                     reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
  CHECK(rows.substr(0, size) == std::string("\0\xff\0\0\0\xff\0\0\0\0\xff\xff\xff\xff", 14));
}

TEST_CASE("PDO: pictures that can't be used are told, and the model is read") {
  const auto missing = [](std::uint32_t width, std::uint32_t height, const std::string& pixels) {
    PdoTestFile file = cube_file();
    file.materials = {{"wood", {1, 1, 1}, width, height, pixels}};
    file.objects[0].faces[0].material = 0;
    const Soup soup = parsed(pdo(file), "pdo");
    return soup.remarks.count(RepairKind::texture_missing) == 1 && !soup.materials[0].picture &&
           soup.polygon_count() == 6;
  };
  CHECK_FALSE(missing(2, 1, "abcdef"));
  CHECK(missing(2, 1, "abcdefg"));
  CHECK(missing(2, 1, "abcde"));
  CHECK(missing(0, 1, "abcdef"));
  CHECK(missing(2, 0, ""));
  CHECK(missing(100'000, 100'000, "abcdef"));
  CHECK(missing(4'000'000'000, 4'000'000'000, "abcdef"));
  CHECK(missing(3'000, 3'000, "abcdef"));
}

TEST_CASE("PDO: an edge is folded where two faces of a piece lie at it together") {
  for (const PdoStyle& style : all_styles()) {
    INFO(told(style));
    const mesh::FileSeams seams = mesh::read_seams(pdo(cube_file(), style), "cube.pdo", {});
    CHECK(seams.points.size() == 8);
    CHECK(edges_of(seams.keep) == Edges{{1, 5}, {3, 7}, {0, 4}, {4, 5}});
    CHECK(edges_of(seams.cut) == Edges{{0, 1}, {0, 2}, {1, 3}, {2, 3}, {2, 6}, {5, 7}, {4, 6}, {6, 7}});
    CHECK(seams.keep.size() + seams.cut.size() == 12);
  }
  // The bottom in the piece of the others, where it lies beside the front.
  PdoTestFile file = cube_file();
  file.objects[0].faces[5].piece = 0;
  CHECK(edges_of(mesh::read_seams(pdo(file), "cube.pdo", {}).keep) ==
        Edges{{0, 1}, {1, 5}, {3, 7}, {0, 4}, {4, 5}});
  // Faces in no piece ask for nothing.
  file.objects[0].faces[5].piece = -1;
  const mesh::FileSeams open = mesh::read_seams(pdo(file), "cube.pdo", {});
  CHECK(open.keep.size() == 4);
  CHECK(open.cut.size() == 4);
}

TEST_CASE("PDO: what can't be read is refused with its place") {
  const auto seams_refusal = [](const std::string& bytes) {
    try {
      (void)mesh::read_seams(bytes, "m.pdo", {});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  PdoTestFile flat = cube_file();
  flat.scale.reset();
  CHECK(seams_refusal(pdo(flat)) == "m.pdo holds no nets: unfold the model in Pepakura Designer first");
  CHECK(pdo_refusal({}) == "4 model.pdo has no faces");
  const std::string locked =
      "3 model.pdo is locked by its author with a password: save it without one in Pepakura Designer, or ask "
      "its author";
  CHECK(pdo_refusal(cube_file(), {.version = 5, .locked = true}) == locked);
  CHECK(pdo_refusal(cube_file(), {.version = 6, .wide = true, .length_in_bytes = true, .locked = true}) ==
        locked);
  CHECK(
      pdo_refusal(cube_file(), {.version = 7}) ==
      "3 model.pdo is a Pepakura file of version 3.7, and only 3.4 to 3.6 are read (Designer 2 to 5): export "
      "it from Pepakura Designer as OBJ");
  PdoTestFile file = cube_file();
  file.objects[0].faces[2].points[1] = 8;
  CHECK(pdo_refusal(file).find("object 0: face 2 names point 8, but there are 8") != std::string::npos);
  file = cube_file();
  file.objects[0].points[3].y = 1.0 / 0.0;
  const std::string not_finite = pdo_refusal(file);
  CHECK(not_finite.starts_with("4 model.pdo, byte "));
  CHECK(not_finite.ends_with("object 0: a coordinate of point 3 is not finite"));
  file = cube_file();
  file.objects[0].faces[0].material = 5;
  CHECK(parsed(pdo(file), "pdo").remarks.count(RepairKind::material_unknown) == 1);
  // Cut off anywhere before its nets; behind them, the model is there.
  for (const PdoStyle& style : all_styles()) {
    INFO(told(style));
    const std::string whole = pdo(rich_pdo_file(), style);
    const std::size_t needed = whole.size() - 44 - 32 - 1 - 16;
    for (std::size_t size = 14; size < needed; size += 13) {
      INFO(size);
      const std::string refused = refusal(whole.substr(0, size), "pdo");
      REQUIRE(refused.starts_with("3 model.pdo"));
    }
    CHECK(parsed(whole.substr(0, needed), "pdo").remarks.count(RepairKind::missing_end) == 1);
  }
}

TEST_CASE("PDO: a few bytes can't ask for much") {
  const std::string start = "version 3\n" + bytes4(4) + bytes4(0) + bytes4(0) + bytes4(0) + bytes4(0) +
                            bytes4(0) + bytes4(0) + std::string(32, '\0');
  const std::string most = bytes4(0xffffffffU);
  CHECK(refusal(start + most, "pdo").find("it says 4294967295 objects") != std::string::npos);
  CHECK(refusal(start + bytes4(1) + bytes4(0) + "\1" + most + std::string(100, '\0'), "pdo")
            .find("it says 4294967295 points") != std::string::npos);
  CHECK(refusal(start + bytes4(1) + bytes4(0) + "\1" + bytes4(0) + most + std::string(100, '\0'), "pdo")
            .find("it says 4294967295 faces") != std::string::npos);
  CHECK(refusal(start + bytes4(1) + most + std::string(100, '\0'), "pdo").find("4294967295 letters") !=
        std::string::npos);
}
