// SPDX-License-Identifier: GPL-3.0-or-later
// Material files and pictures beside a model, in a folder of the test's own.
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "mesh/reading/check_picture.hpp"
#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::Colour;
using mesh::RepairKind;
using mesh::Soup;
namespace fs = std::filesystem;

namespace {

/// A folder that goes away with the test.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("ridgecraft_materials_" + std::to_string(::getpid()))) {
    fs::create_directories(path_ / "sub");
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  /// An OBJ file with one face for each material.
  [[nodiscard]] Soup read(const std::string& libraries, const std::vector<std::string>& materials) const {
    std::string text = libraries + "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const std::string& material : materials) {
      text += "usemtl " + material + "\nf 1 2 3\n";
    }
    write("model.obj", text);
    return mesh::read_soup(path_ / "model.obj", {});
  }

 private:
  fs::path path_;
};

const std::string png = std::string("\x89PNG\r\n\x1a\n", 8) + std::string("\0\0\0\1IDATxcrcc", 13) +
                        std::string("\0\0\0\0IENDcrcc", 12);
// Start, a segment with a thumbnail's end mark in it, start of scan, data, end.
const std::string jpeg = std::string("\xff\xd8\xff\xe0\0\4\xff\xd9", 8) + std::string("\xff\xda\0\2", 4) +
                         std::string("data\xff\xd9", 6);

}  // namespace

TEST_CASE("MTL: colours are clamped, what is missing is white") {
  const Folder folder;
  folder.write(
      "a.mtl",
      "newmtl red\r\nKd 1 0 0.5\r\nnewmtl grey\nKd 0.25\nnewmtl wild\nKd 5 -1 nan\nnewmtl none\nd 1\n"
      "newmtl word\nKd red\nnewmtl red\nKd 0 0 0\n  newmtl two words \n\tKd 0 0 1\n");
  const Soup soup = folder.read("mtllib a.mtl\n", {"red", "grey", "wild", "none", "word", "two words"});
  CHECK(soup.materials[0].colour == Colour{1, 0, 0.5});
  CHECK(soup.materials[1].colour == Colour{0.25, 0.25, 0.25});
  CHECK(soup.materials[2].colour == Colour{1, 0, 1});
  CHECK(!soup.materials[3].colour);
  CHECK(!soup.materials[4].colour);
  CHECK(soup.materials[5].colour == Colour{0, 0, 1});
  CHECK(soup.remarks.count(RepairKind::material_value_corrected) == 2);
  CHECK(soup.remarks.entries().size() == 1);
}

TEST_CASE("MTL: files are found although their names were written elsewhere") {
  const Folder folder;
  const std::string red = "newmtl red\nKd 1 0 0\n";
  for (const std::string name : {"a.mtl", "with blank.mtl", "sub/c.mtl"}) {
    folder.write(name, red);
  }
  for (const std::string line : {"a.mtl", "missing.mtl a.mtl", "with blank.mtl", "sub/c.mtl", "sub\\c.mtl",
                                 "A.MTL", "C:\\work\\a.mtl", "/nowhere/A.mtl", "SUB/../a.mtl"}) {
    INFO(line);
    CHECK(folder.read("mtllib " + line + "\n", {"red"}).materials[0].colour == Colour{1, 0, 0});
  }
  const Soup missing = folder.read("mtllib b.mtl\nmtllib b.mtl\n", {"red"});
  CHECK(missing.remarks.count(RepairKind::material_file_missing) == 1);
  CHECK(missing.remarks.count(RepairKind::material_unknown) == 0);
  CHECK(folder.read("mtllib sub\n", {"red"}).remarks.count(RepairKind::material_file_missing) == 1);
  CHECK(folder.read("mtllib a.mtl\n", {"red", "blue"}).remarks.count(RepairKind::material_unknown) == 1);
  CHECK(folder.read("", {"red"}).remarks.count(RepairKind::material_unknown) == 1);
  CHECK(folder.read("mtllib model.obj\n", {"red"}).remarks.entries().size() == 1);
  CHECK(folder.read("mtllib /dev/zero\n", {"red"}).remarks.entries().size() == 1);
}

TEST_CASE("MTL: pictures are looked at before they are named") {
  const Folder folder;
  folder.write("ok.png", png);
  folder.write("ok too.jpg", jpeg);
  folder.write("-o.png", png);
  folder.write("sub/in.png", png);
  folder.write("cut.png", png.substr(0, png.size() - 1));
  folder.write("empty.png", "");
  folder.write("text.png", "hello");
  folder.write("sub/b.mtl", "newmtl m\nmap_Kd in.png\n");
  const auto texture = [&](const std::string& line) {
    folder.write("a.mtl", "newmtl m\nmap_Kd " + line + "\n");
    const Soup soup = folder.read("mtllib a.mtl\n", {"m"});
    CHECK(soup.remarks.count(RepairKind::texture_missing) ==
          (soup.materials[0].texture_file.empty() ? 1 : 0));
    return soup.materials[0].texture_file;
  };
  CHECK(texture("ok.png") == "ok.png");
  CHECK(texture("ok too.jpg ") == "ok too.jpg");
  CHECK(texture("-s 1 1 1 -o 0 0 -blendu on -mm 0 1 -clamp off ok too.jpg") == "ok too.jpg");
  CHECK(texture("-o 0.5 ok.png") == "ok.png");
  CHECK(texture("-o.png") == "-o.png");
  CHECK(texture("C:\\textures\\OK.PNG") == "ok.png");
  CHECK(texture("sub\\in.png") == "sub/in.png");
  for (const std::string bad : {"cut.png", "empty.png", "text.png", "none.png", "sub", "/dev/zero"}) {
    INFO(bad);
    CHECK(texture(bad).empty());
  }
  CHECK(folder.read("mtllib sub/b.mtl\n", {"m"}).materials[0].texture_file == "sub/in.png");
}

TEST_CASE("Pictures are whole only with their last byte") {
  for (const std::string& picture : {png, jpeg}) {
    CHECK(mesh::picture_fault(picture).empty());
    CHECK(mesh::picture_fault(picture + "more").empty());
    for (std::size_t size = 0; size < picture.size(); ++size) {
      INFO(size);
      CHECK(!mesh::picture_fault(std::string_view(picture).substr(0, size)).empty());
    }
  }
}
