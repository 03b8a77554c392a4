// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/look/look.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/random.hpp"
#include "mesh/mesh.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/text_scanner.hpp"
#include "mesh/seeds.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::Look;
using mesh::Rgb;

namespace {

mesh::Model model_of(const std::string& bytes, const std::string& name) {
  return mesh::read(mesh::ModelFile{.bytes = bytes, .name = name, .title = "model", .folder = {}}, {}, {});
}

std::optional<Look> look(const mesh::Model& model) {
  std::vector<std::string> faults;
  std::optional<mesh::LookParts> parts = mesh::look_of(model, {}, faults);
  CHECK(faults.empty());
  return parts ? std::optional<Look>(std::in_place, std::move(*parts)) : std::nullopt;
}

Rgb colour(const Look& look, Vec3 p, Vec3 normal) {
  return look.colour_at(look.nearest(p, normal), 0.0);
}

std::vector<std::uint8_t> random_pixels(Random& random, std::size_t width, std::size_t height) {
  std::vector<std::uint8_t> pixels(3 * width * height);
  for (std::uint8_t& byte : pixels) {
    byte = static_cast<std::uint8_t>(random.below(256));
  }
  return pixels;
}

/// A soft picture of so many pixels: red runs right, green down.
std::vector<std::uint8_t> soft_pixels(std::uint32_t width, std::uint32_t height) {
  std::vector<std::uint8_t> pixels;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      pixels.push_back(static_cast<std::uint8_t>(255 * x / width));
      pixels.push_back(static_cast<std::uint8_t>(255 * y / height));
      pixels.push_back(100);
    }
  }
  return pixels;
}

const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("Look: colours of points run over faces, in PLY, OBJ and OFF") {
  const std::string numbers = "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n" +
      numbers + "3 0 1 2\n";
  const std::string obj = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
  const std::string off = "COFF\n3 1 0\n" + numbers + "3 0 1 2\n";
  const std::string shares =
      "CNOFF\n3 1 0\n0 0 0 0 0 1 1.0 0.0 0.0 1\n1 0 0 0 0 1 0.0 1.0 0.0 1\n"
      "0 1 0 0 0 1 0.0 0.0 1.0 1\n3 0 1 2\n";
  for (const auto& [bytes, name] :
       {std::pair(ply, "a.ply"), {obj, "a.obj"}, {off, "a.off"}, {shares, "a.off"}}) {
    INFO(bytes);
    const auto seen = look(model_of(bytes, name));
    REQUIRE(seen);
    CHECK(colour(*seen, {0, 0, 0}, {0, 0, 1}) == Rgb{255, 0, 0});
    CHECK(colour(*seen, {1, 0, 0.1}, {0, 0, 1}) == Rgb{0, 255, 0});
    CHECK(colour(*seen, {0.5, 0, 0}, {0, 0, 1}) == Rgb{128, 128, 0});
    CHECK_FALSE(seen->flat_colour(0));
  }
}

TEST_CASE("Look: white and one grey are no colours") {
  const TemporaryFolder folder;
  const auto seen = [&](const std::string& mtl, const std::string& faces) {
    write_bytes(folder / "a.mtl", mtl);
    write_bytes(folder / "a.obj", "mtllib a.mtl\n" + quad + faces);
    return look(mesh::read(folder / "a.obj", {}, {}));
  };
  const std::string two = "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n";
  CHECK_FALSE(seen("newmtl a\nKd 0.8 0.8 0.8\n", "usemtl a\nf 1 2 3 4\n"));
  CHECK_FALSE(seen("newmtl a\nKd 1 1 1\nnewmtl b\n", two));
  CHECK_FALSE(seen("", "f 1 2 3 4\n"));
  CHECK(seen("newmtl a\nKd 0.8 0.2 0.2\n", "usemtl a\nf 1 2 3 4\n"));
  const auto different = seen("newmtl a\nKd 0.2 0.2 0.2\nnewmtl b\nKd 1 1 1\n", two);
  REQUIRE(different);
  CHECK(colour(*different, {0.9, 0.1, 0}, {0, 0, 1}) == Rgb{51, 51, 51});
  CHECK(colour(*different, {0.1, 0.9, 0}, {0, 0, 1}) == Rgb{255, 255, 255});
}

TEST_CASE("Look: pictures of a model's folder are laid on its faces, others aren't read") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "in");
  const std::string jpeg = mesh::pack_jpeg(64, 32, soft_pixels(64, 32));
  write_bytes(folder / "in/ok.jpg", jpeg);
  write_bytes(folder / "outside.jpg", jpeg);
  const auto read = [&](const std::string& picture) {
    write_bytes(folder / "in/a.mtl", "newmtl a\nKd 0 0 1\nmap_Kd " + picture + "\n");
    write_bytes(folder / "in/a.obj",
                "mtllib a.mtl\n" + quad + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3 4/4\n");
    return mesh::read(folder / "in/a.obj", {}, {});
  };
  const auto seen = look(read("ok.jpg"));
  REQUIRE(seen);
  const Rgb low_right = colour(*seen, {0.9, 0.1, 0}, {0, 0, 1});
  CHECK(std::abs(low_right[0] - 228) < 8);
  CHECK(std::abs(low_right[1] - 228) < 8);
  CHECK(std::abs(low_right[2] - 100) < 8);
  for (const std::string& outside : {std::string("../outside.jpg"), (folder / "outside.jpg").string()}) {
    const mesh::Model model = read(outside);
    CHECK(model.repairs.count(mesh::RepairKind::texture_missing) == 1);
    const auto blue = look(model);
    REQUIRE(blue);
    CHECK(colour(*blue, {0.5, 0.5, 0}, {0, 0, 1}) == Rgb{0, 0, 255});
  }
  // A copy beside the model stands in for the artist's own.
  write_bytes(folder / "in/outside.jpg", jpeg);
  CHECK(read("../outside.jpg").materials[0].texture_file == "outside.jpg");
}

namespace {

/// A picture of three times two pixels, as other programs pack it.
struct PackedPicture {
  std::string_view format;
  std::string_view base64;
};
constexpr std::array packed_pictures{
    PackedPicture{"TGA",
                  "AAACAAAAAAAAAAAAAwACABgAAP//MCAQ////AAD/AP8A/wAAAAAAAAAAAABUUlVFVklTSU9OLVhGSUxFLgA="},
    PackedPicture{"TGA",
                  "AAAKAAAAAAAAAAAAAwACABgAAgD//zAgEP///wIAAP8A/wD/AAAAAAAAAAAAAFRSVUVWSVNJT04tWEZJTEUuAA=="},
    PackedPicture{
        "BMP",
        "Qk1OAAAAAAAAADYAAAAoAAAAAwAAAAIAAAABABgAAAAAABgAAADEDgAAxA4AAAAAAAAAAAAAAP//MCAQ////AAAAAAD/AP8A/wAA"
        "AAAA"},
    PackedPicture{"GIF", "R0lGODdhAwACAIIAAP//////AAD/ABAgMP8AAAAA/wAAAAAAACwAAAAAAwACAAAICQAJCCgQYACAgAA7"},
    PackedPicture{
        "WebP",
        "UklGRjwAAABXRUJQVlA4TDAAAAAvAkAAAC8gECBI8R9pQyCQpLA/7AIBgiT/ceY/8IkhbBUoZBsBTu0egzO7iP7HeAE="},
    PackedPicture{
        "TIFF",
        "SUkqABgAAACAP8AQOBQR/wIICAYQd/wECgAAAQMAAQAAAAMAAAABAQMAAQAAAAIAAAACAQMAAwAAAJYAAAADAQMAAQAAAAUA"
        "AAAGAQMAAQAAAAIAAAARAQQAAQAAAAgAAAAVAQMAAQAAAAMAAAAWAQMAAQAAAAIAAAAXAQQAAQAAABAAAAAcAQMAAQAAAAEA"
        "AAAAAAAACAAIAAgA"}};

std::string bytes_of(const PackedPicture& picture) {
  return mesh::from_base64(picture.base64).value();
}

}  // namespace

TEST_CASE("Look: TGA, BMP, GIF, WebP and TIFF have the pixels that other programs put into them") {
  constexpr std::array<std::uint8_t, 18> pixels{255, 0,   0, 0,  255, 0,  0,   0,   255,
                                                255, 255, 0, 16, 32,  48, 255, 255, 255};
  for (const PackedPicture& packed : packed_pictures) {
    INFO(packed.format);
    const std::string bytes = bytes_of(packed);
    REQUIRE(mesh::picture_format(bytes));
    CHECK(mesh::picture_format(bytes)->name == packed.format);
    CHECK(mesh::picture_fault(bytes).empty());
    const auto picture = mesh::unpack_picture(bytes);
    REQUIRE(picture);
    CHECK(picture->width() == 3);
    CHECK(std::equal(pixels.begin(), pixels.end(), picture->pixels().begin(), picture->pixels().end()));
    Random random(2);
    for (int i = 0; i < 300; ++i) {
      std::string damaged =
          bytes.substr(0, i % 3 == 0 ? random.below(static_cast<std::uint32_t>(bytes.size())) : bytes.npos);
      if (!damaged.empty()) {
        damaged[random.below(static_cast<std::uint32_t>(damaged.size()))] =
            static_cast<char>(random.below(256));
      }
      (void)mesh::unpack_picture(damaged);
    }
  }
  // What is transparent is white, unless nothing is opaque: then the program knew no transparency.
  const auto leaf = mesh::unpack_picture(
      bytes_of({"WebP",
                "UklGRjgAAABXRUJQVlA4TCwAAAAvAkAAEC8gECBI8R9pQyBAkOA/lkAgSWl/uOc/BlbAPRUQCF"
                "CmCgdF9D/SDw=="}));
  REQUIRE(leaf);
  CHECK(leaf->pixels()[3] == 255);
  CHECK(leaf->pixels()[4] == 255);
}

TEST_CASE("Look: pictures in formats that aren't read are named with a way out") {
  for (const auto& [start, name] : {std::pair{"\xabKTX 20\xbb\r\n\x1a\n", "KTX2"}, std::pair{"DDS |", "DDS"},
                                    std::pair{"8BPS", "Photoshop"}, std::pair{"v/1\x01", "OpenEXR"}}) {
    CHECK(mesh::picture_fault(std::string(start) + std::string(40, 'x')) ==
          fmt::format("is a {} picture, which isn't read: save it as PNG", name));
  }
  CHECK(mesh::picture_fault("nothing of the kind") == "is no picture");
}

TEST_CASE("Look: pictures are found in the folders that people keep them in") {
  const TemporaryFolder folder;
  const std::string red = bytes_of(packed_pictures[0]);
  for (const char* const name : {"a/Textures", "a/maps", "pack/source", "pack/textures", "pack/other"}) {
    std::filesystem::create_directories(folder / name);
  }
  write_bytes(folder / "a/Textures/deep.tga", red);
  write_bytes(folder / "a/maps/saved.PNG", tiny_png());
  write_bytes(folder / "a/maps/own.dds", "DDS |123456789012345678901234567890");
  write_bytes(folder / "a/own.png", tiny_png());
  write_bytes(folder / "pack/textures/skin.tga", red);
  write_bytes(folder / "pack/other/hidden.tga", red);
  const auto found = [&](const std::string& in, const std::string& name) {
    write_bytes(folder / (in + "/m.mtl"), "newmtl m\nmap_Kd " + name + "\n");
    write_bytes(folder / (in + "/m.obj"), "mtllib m.mtl\n" + quad + "usemtl m\nf 1 2 3 4\n");
    const mesh::Model model = mesh::read(folder / (in + "/m.obj"), {}, {});
    CHECK(model.repairs.count(mesh::RepairKind::texture_missing) == (model.materials[0].picture ? 0 : 1));
    return model.materials[0].texture_file;
  };
  CHECK(found("a", R"(C:\Users\artist\deep.tga)") == "Textures/deep.tga");
  CHECK(found("a", "saved.jpg") == "maps/saved.PNG");  // converted, and the MTL file not changed
  CHECK(found("a", "own.dds") == "own.png");           // one that is read counts more
  CHECK(found("a", "nowhere.png").empty());
  CHECK(found("pack/source", "skin.tga") == "../textures/skin.tga");
  CHECK(found("pack/source", "hidden.tga").empty());
  CHECK(found("pack/source", "../other/hidden.tga").empty());
  // A link doesn't make a folder's own what lies elsewhere.
  std::filesystem::create_symlink(folder / "pack/other/hidden.tga", folder / "pack/textures/link.tga");
  CHECK(found("pack/source", "link.tga").empty());
}

TEST_CASE("Look: many large pictures are kept within one budget") {
  mesh::Picture picture(64, 32, soft_pixels(64, 32));
  const Rgb before = picture.at({0.9, 0.1}, 1);
  CHECK(picture.coarsen());
  CHECK(picture.width() == 32);
  CHECK(picture.at({0.9, 0.1}, 0) == before);
  while (picture.coarsen()) {
  }
  CHECK(picture.height() >= 4);
}

TEST_CASE("Look: pictures that are cut off are refused or read, but end nothing") {
  const std::string jpeg = mesh::pack_jpeg(40, 30, soft_pixels(40, 30));
  const auto whole = mesh::unpack_picture(jpeg);
  REQUIRE(whole);
  CHECK(whole->width() == 40);
  CHECK(whole->height() == 30);
  for (std::size_t size = 0; size < jpeg.size(); size += 7) {
    (void)mesh::unpack_picture(std::string_view(jpeg).substr(0, size));
  }
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = jpeg;
    damaged[random.below(static_cast<std::uint32_t>(damaged.size()))] = static_cast<char>(random.below(256));
    (void)mesh::unpack_picture(damaged);
  }
  CHECK_FALSE(mesh::unpack_picture("\x89PNG\r\n\x1a\nnothing"));
  CHECK_FALSE(mesh::unpack_picture(""));
}

TEST_CASE("Look: coarse copies of a picture have its colours, and places repeat") {
  const mesh::Picture picture(64, 32, soft_pixels(64, 32));
  CHECK(picture.level_for(0.5) == 0);
  CHECK(picture.level_for(1.9) == 0);
  CHECK(picture.level_for(2.0) == 1);
  CHECK(picture.level_for(1e9) == 3);
  for (unsigned level = 0; level < 4; ++level) {
    for (const Vec2 at : {Vec2{0.3, 0.4}, {0.7, 0.6}, {0.5, 0.5}}) {
      const Rgb fine = picture.at(at, 0);
      const Rgb coarse = picture.at(at, level);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(fine[k] - coarse[k]) <= 6);
      }
      CHECK(picture.at({at.x + 3.0, at.y - 2.0}, level) == coarse);
    }
  }
}

TEST_CASE("Look: between its pixels a picture has their mean by how near each is") {
  Random random(5);
  const std::vector<std::uint8_t> pixels = random_pixels(random, 9, 7);
  const mesh::Picture picture(9, 7, pixels);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 at{3.0 * random.unit() - 1.0, 3.0 * random.unit() - 1.0};
    const double x = at.x * 9.0 - 0.5;
    const double y = (1.0 - at.y) * 7.0 - 0.5;
    const Rgb found = picture.at(at, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      double mean = 0.0;
      for (const double column : {std::floor(x), std::floor(x) + 1.0}) {
        for (const double row : {std::floor(y), std::floor(y) + 1.0}) {
          const auto wrapped = [](double index, int size) {
            return static_cast<std::size_t>((static_cast<int>(index) % size + size) % size);
          };
          mean += (1.0 - std::abs(x - column)) * (1.0 - std::abs(y - row)) *
                  pixels[3 * (wrapped(row, 7) * 9 + wrapped(column, 9)) + k];
        }
      }
      CHECK(std::abs(found[k] - mean) < 2.6);  // shares are counted in 256ths
    }
  }
}

TEST_CASE("Look: along a line a picture has the colours that it has at each place") {
  Random random(6);
  const std::vector<std::uint8_t> pixels = random_pixels(random, 40, 30);
  const mesh::Picture picture(40, 30, pixels);
  for (int i = 0; i < 600; ++i) {
    // A third of the lines lie within; others end on the border or beyond it, where pictures repeat.
    const auto place = [&]() {
      const double reach = i % 3 == 0 ? 2.0 : 1.0;
      const double whole = static_cast<double>(random.below(3)) / 2.0;
      return i % 3 == 1 ? whole : 0.5 + 0.9 * reach * (random.unit() - 0.5);
    };
    const Vec2 from{place(), place()};
    const Vec2 to{place(), place()};
    const auto level = static_cast<unsigned>(random.below(3));
    std::vector<Rgb> found(random.below(200));
    picture.along(from, to, level, found);
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double share =
          found.size() > 1 ? static_cast<double>(k) / static_cast<double>(found.size() - 1) : 0.0;
      const Rgb there = picture.at(from + share * (to - from), level);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        // A place that is off by a thousandth of a pixel may fall into the next 256th, in both directions.
        CHECK(std::abs(found[k][channel] - there[channel]) <= 3);
      }
    }
  }
}

TEST_CASE("Look: a triangle on one face has that face's colours, and others are told from it") {
  Random random(13);
  const auto number = [&] { return 2.0 * random.unit() - 1.0; };
  const auto vector = [&] { return Vec3{number(), number(), number()}; };
  const auto weights = [&] {
    const double a = random.unit();
    const double b = random.unit() * (1.0 - a);
    return std::array{a, b, 1.0 - a - b};
  };
  mesh::Paint painted;
  painted.picture = std::make_shared<const mesh::Picture>(64, 32, soft_pixels(64, 32));
  std::vector<mesh::LookFace> faces(60);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    mesh::LookFace& face = faces[i];
    const Vec3 at = 5.0 * vector();
    face.corners = {at, at + vector(), at + vector()};
    face.normal = normalized(cross(face.corners[1] - at, face.corners[2] - at));
    face.paint = i % 3 == 0 ? 0 : 1;
    if (face.paint == 0) {
      face.places = {Vec2{random.unit(), random.unit()}, {random.unit(), random.unit()}, {0.0, 1.0}};
    } else if (i % 3 == 1) {
      face.colours = {{{200, 10, 0}, {0, 100, 90}, {90, 9, 255}}};
    }
  }
  const Look look({faces, {painted, mesh::Paint{}}});
  const auto place_on = [](const mesh::LookFace& face, const std::array<double, 3>& w) {
    return w[0] * face.corners[0] + w[1] * face.corners[1] + w[2] * face.corners[2];
  };
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const mesh::LookFace& face = faces[f];
    const std::array<std::array<double, 3>, 3> corners{weights(), weights(), weights()};
    std::array<Vec3, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = place_on(face, corners[k]);
    }
    REQUIRE(look.face_under(triangle, face.normal) == f);
    const mesh::TriangleColours colours = look.colours_of(f, triangle, 0.02);
    for (int i = 0; i < 20; ++i) {
      const std::array<double, 3> at = weights();
      std::array<double, 3> on_face{};
      for (std::size_t k = 0; k < 3; ++k) {
        on_face[k] = at[0] * corners[0][k] + at[1] * corners[1][k] + at[2] * corners[2][k];
      }
      const Rgb expected = look.colour_at({f, on_face}, 0.02);
      const Rgb found = colours.at(at);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(found[k] - expected[k]) <= 1);
      }
    }
    triangle[1] = triangle[1] + 0.01 * face.normal;
    CHECK_FALSE(look.face_under(triangle, face.normal));
    triangle[1] = place_on(face, {1.2, -0.1, -0.1});
    CHECK_FALSE(look.face_under(triangle, face.normal));
    CHECK_FALSE(
        look.face_under(face.corners, normalized(face.normal + 0.1 * (face.corners[1] - face.corners[0]))));
  }
}

TEST_CASE("Look: the nearest place is that of all faces one by one, and looks to the same side") {
  Random random(7);
  const auto number = [&] { return 2.0 * random.unit() - 1.0; };
  const auto vector = [&] { return Vec3{number(), number(), number()}; };
  std::vector<mesh::LookFace> faces(200);
  for (mesh::LookFace& face : faces) {
    const Vec3 at = vector();
    face.corners = {at, at + 0.2 * vector(), at + 0.2 * vector()};
    face.normal = normalized(cross(face.corners[1] - at, face.corners[2] - at));
  }
  const Look look({faces, {mesh::Paint{}}});
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = 1.5 * vector();
    const Vec3 normal = normalized(vector());
    const mesh::LookPlace found = look.nearest(p, normal, random.below(200));
    CHECK(dot(faces[found.face].normal, normal) > 0.0);
    double nearest = INFINITY;
    for (const mesh::LookFace& face : faces) {
      if (dot(face.normal, normal) > 0.0) {
        for (int a = 0; a <= 20; ++a) {
          for (int b = 0; a + b <= 20; ++b) {
            const Vec3 q = face.corners[0] + a / 20.0 * (face.corners[1] - face.corners[0]) +
                           b / 20.0 * (face.corners[2] - face.corners[0]);
            nearest = std::min(nearest, length(p - q));
          }
        }
      }
    }
    const auto& c = faces[found.face].corners;
    const Vec3 place = found.weights[0] * c[0] + found.weights[1] * c[1] + found.weights[2] * c[2];
    CHECK(length(p - place) <= nearest + 1e-3);
  }
}

TEST_CASE("Look: among the faces near a ball is the nearest one of each point in it") {
  Random random(11);
  const auto number = [&] { return 2.0 * random.unit() - 1.0; };
  const auto vector = [&] { return Vec3{number(), number(), number()}; };
  std::vector<mesh::LookFace> faces(400);
  for (mesh::LookFace& face : faces) {
    const Vec3 at = vector();
    face.corners = {at, at + 0.3 * vector(), at + 0.3 * vector()};
    face.normal = normalized(cross(face.corners[1] - at, face.corners[2] - at));
  }
  for (std::size_t i = 0; i < faces.size(); i += 5) {
    faces[i] = faces[i + 1];
  }
  const Look look({faces, {mesh::Paint{}}});
  std::size_t listed = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 middle = 1.5 * vector();
    const Vec3 normal = normalized(vector());
    const double radius = 0.3 * random.unit();
    const std::vector<std::uint32_t> near = look.faces_near(middle, normal, radius, faces.size());
    REQUIRE(!near.empty());
    listed += near.size();
    CHECK(look.faces_near(middle, normal, radius, near.size() - 1).empty());
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = middle + radius * random.unit() * normalized(vector());
      // Every fifth face lies on another one: the hint decides.
      const std::uint32_t hint = near[random.below(static_cast<std::uint32_t>(near.size()))];
      CHECK(look.nearest_among(near, p, normal, hint).face == look.nearest(p, normal, hint).face);
      const auto& [a, b, c] = faces[hint].corners;
      const Vec3 inside = (a + b + c) / 3.0;
      if (length(inside - middle) <= radius) {
        CHECK(look.nearest_among(near, inside, normal, hint).face == look.nearest(inside, normal, hint).face);
      }
    }
  }
  CHECK(listed < 100 * faces.size() / 4);
  for (mesh::LookFace& face : faces) {
    face.normal = {0.0, 0.0, 1.0};
  }
  CHECK(Look({faces, {mesh::Paint{}}}).faces_near({}, {0.0, 0.0, -1.0}, 1.0, faces.size()).empty());
}
