// SPDX-License-Identifier: GPL-3.0-or-later
#include <clocale>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "mesh/reading/files.hpp"
#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using mesh::RepairKind;
using mesh::Soup;

namespace {

constexpr std::string_view three_points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::vector<std::uint32_t> corner_points(const Soup& soup, std::size_t polygon) {
  const auto found = soup.polygon(polygon);
  return {found.begin(), found.end()};
}

}  // namespace

TEST_CASE("OBJ: points and polygons keep numbers and order") {
  const Soup soup = parsed("v 0.1 -2e-3 +4.\nv .5 1 1\nv 1 1 0\nv 3 3 3\nf 1 2 3 4\nf 4 3 1\n", "obj");
  REQUIRE(soup.points.size() == 4);
  CHECK(soup.points[0] == Vec3{0.1, -2e-3, 4.0});
  CHECK(corner_points(soup, 0) == std::vector<std::uint32_t>{0, 1, 2, 3});
  CHECK(corner_points(soup, 1) == std::vector<std::uint32_t>{3, 2, 0});
  CHECK(soup.corner_texture.empty());
  CHECK(soup.polygon_material.empty());
  CHECK(soup.remarks.entries().empty());
}

TEST_CASE("OBJ: line ends, tabs, comments and continued lines are white space") {
  const std::string points(three_points);
  for (const std::string face : {"f 1 2 3", "f\t1\t2\t3\t", "  f 1 2 3  # end", "f 1 \\\n2 3\n",
                                 "f 1 \\\r\n 2 3\r\n", "f 1 2 3\\\n", "f 1 2\\\n 3"}) {
    INFO(face);
    CHECK(corner_points(parsed(points + face, "obj"), 0) == std::vector<std::uint32_t>{0, 1, 2});
  }
  // A backslash at the end of a comment joins nothing.
  CHECK(parsed("# C:\\models\\\n" + points + "f 1 2 3", "obj").points.size() == 3);
  CHECK(
      parsed("v 0 0 0 # C:\\\nv 1 0 0\nv 0 1 0\nf 1 2 3 # \\\nf 1 3 2#\\\nf 2 3 1", "obj").polygon_count() ==
      3);
  CHECK(parsed("g a#b \\\n c\n" + points + "f 1 2 3", "obj").remarks.entries().empty());
  CHECK(parsed("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "obj").points.size() == 3);
  CHECK(parsed("\xef\xbb\xbf" + points + "f 1 2 3", "obj").points.size() == 3);
}

TEST_CASE("OBJ: relative numbers count back from their line, others over the whole file") {
  const Soup soup = parsed("f 1 2 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -1 -2 -3", "obj");
  CHECK(corner_points(soup, 0) == std::vector<std::uint32_t>{0, 1, 3});
  CHECK(corner_points(soup, 1) == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(corner_points(soup, 2) == std::vector<std::uint32_t>{3, 2, 1});
}

TEST_CASE("OBJ: polygons with few corners are kept for repair to judge") {
  const Soup soup = parsed(std::string(three_points) + "f\nf 1\nf 1 2\nf 1 2 3\n", "obj");
  REQUIRE(soup.polygon_count() == 4);
  CHECK(soup.polygon(0).empty());
  CHECK(soup.polygon(2).size() == 2);
}

TEST_CASE("OBJ: refusals name the line and the reason") {
  const std::string points(three_points);
  const auto refused = [&](const std::string& more) { return refusal(points + more, "obj"); };
  CHECK(refused("f 1 2 0") == "3 model.obj, line 4: a face names point 0, but points are numbered from 1");
  CHECK(refused("f 1 2 3\n\nf 1 2 4\n") ==
        "3 model.obj, line 6: a face names point 4, but the file has only 3 points");
  CHECK(refused("f 1 2 -4\n").find("line 4: a face names point \"-4\"") != std::string::npos);
  CHECK(refused("f 1 2 18446744073709551617\n").find("more than any file has") != std::string::npos);
  CHECK(refused("f 1 2 4294967297\n").starts_with("3 model.obj, line 4: "));
  CHECK(refused("f 1 2 3.5\n") == "3 model.obj, line 4: \"3.5\" is no corner of a face");
  CHECK(refused("f 1/a 2 3\n") == "3 model.obj, line 4: \"1/a\" is no corner of a face");
  CHECK(refused("v 0,5 1,5 2,5\n").find("decimal point") != std::string::npos);
  CHECK(refused("v 1 2\nv 3 0 0\n") == "3 model.obj, line 4: point 4 has fewer than three coordinates");
  CHECK(refused("v 1 2 #3\n").find("fewer than three") != std::string::npos);
  CHECK(refused("v 0x10 2 3\n") == "3 model.obj, line 4: \"0x10\" is no number");
  CHECK(refused("v +-1 2 3\n") == "3 model.obj, line 4: \"+-1\" is no number");
  CHECK(refused("v 1 \xff\n\n2\n").find("\"\xef\xbf\xbd\" is no number") != std::string::npos);
  CHECK(refused("v " + std::string(100000, 'x') + " 2 3\n").size() < 120);
}

TEST_CASE("OBJ: coordinates out of range are not finite, small ones are zero") {
  const std::string rest = " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const std::string number : {"1e400", "-1e309", "nan", "-inf", "Infinity", "1e99999999999999999999",
                                   "1000000e399", "0.0001e320"}) {
    INFO(number);
    CHECK(refusal("v " + number + rest, "obj") ==
          "4 model.obj, line 1: a coordinate of point 1 is not finite");
  }
  for (const std::string number :
       {"1e-400", "0e999", "-1e-99999999999999999999", "0.0000001e-320", "0.0e400"}) {
    INFO(number);
    CHECK(parsed("v " + number + rest, "obj").points[0].x == 0.0);
  }
  CHECK(refusal("v " + std::string(1000, '9') + rest, "obj").starts_with("4 "));
  CHECK(parsed("v 0." + std::string(1000, '0') + "1" + rest, "obj").points[0].x == 0.0);
  CHECK(parsed("v 5e-324" + rest, "obj").points[0].x == 5e-324);
}

TEST_CASE("OBJ: texture coordinates are kept where a face has them at all corners") {
  const std::string start = std::string(three_points) + "vt 0 0\nvt 1 0 0\nvt 0.5\nvt nan 0\nvt 1e9 0\n";
  const Soup soup = parsed(start + "f 1/1 2/2 3/3\nf 1 2 3\nf 1/1 2//1 3/3\nf 1/1/1 2/2/1 3/-3/1\n", "obj");
  const std::uint32_t none = Soup::none;
  CHECK(soup.corner_texture ==
        std::vector<std::uint32_t>{0, 1, 2, none, none, none, none, none, none, 0, 1, 2});
  CHECK(soup.texture_points[2] == Vec2{0.5, 0.0});
  CHECK(soup.remarks.entries().empty());
  for (const std::string bad :
       {"4", "5", "6", "0", "-6", "99999999999999999999", "4294967295", "4294967296"}) {
    INFO(bad);
    const Soup spoilt = parsed(start + "f 1/1 2/2 3/" + bad + "\n", "obj");
    CHECK(spoilt.corner_texture.empty());
    CHECK(spoilt.remarks.count(RepairKind::texture_point_dropped) == 1);
  }
}

TEST_CASE("OBJ: materials are those that faces use, in the order of their use") {
  const Soup soup =
      parsed(std::string(three_points) +
                 "f 1 2 3\nusemtl unused\nusemtl dark red \nf 1 2 3\nusemtl b\nf 1 2 3\nf 3 2 1\n"
                 "usemtl dark red\nf 1 2 3\nusemtl\nf 1 2 3\n",
             "obj");
  REQUIRE(soup.materials.size() == 2);
  CHECK(soup.materials[0].name == "dark red");
  CHECK(soup.materials[1].name == "b");
  CHECK(soup.polygon_material == std::vector<std::uint32_t>{Soup::none, 0, 1, 1, 0, Soup::none});
}

TEST_CASE("OBJ: lines mark edges, those without two points of the file are left out") {
  const Soup soup =
      parsed(std::string(three_points) + "l 3 1/7 -2\nf 1 2 3\nl 1 9\nl 0 1 2\nl 2\nl 1 x\n", "obj");
  CHECK(soup.lines == std::vector<std::array<std::uint32_t, 2>>{{2, 0}, {0, 1}, {0, 1}});
  CHECK(soup.remarks.count(RepairKind::element_ignored) == 3);
}

TEST_CASE("OBJ: what is no face is counted, what is no OBJ refused") {
  const Soup soup =
      parsed(std::string(three_points) + "o a\ng b\ns 1\nres 1\np 1\ncurv 0 1 1 2\nf 1 2 3\n", "obj");
  CHECK(soup.remarks.count(RepairKind::element_ignored) == 3);
  CHECK(soup.remarks.entries()[0].detail == "first: line 7");
  CHECK(refusal("to whom it may concern\n", "obj").starts_with("3 model.obj, line 1: "));
  CHECK(refusal("# nothing\n", "obj") == "4 model.obj has no faces");
  CHECK(refusal(three_points, "obj").starts_with("4 "));
}

TEST_CASE("OBJ: zero bytes after the text are remarked on") {
  const std::string text = std::string(three_points) + "f 1 2 3\n";
  CHECK(parsed(text + std::string(512, '\0'), "obj").remarks.count(RepairKind::trailing_data_ignored) == 512);
  CHECK(parsed(text + '\x1a', "obj").remarks.entries().empty());
  // In the middle they are damage.
  CHECK(refusal(text + std::string(3, '\0') + "f 1 2 3\n", "obj").starts_with("3 "));
}

TEST_CASE("OBJ: numbers don't depend on the locale") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) {
      CHECK(parsed("v 0.5 1.5 2.5\nv 1 0 0\nv 0 1 0\nf 1 2 3", "obj").points[0] == Vec3{0.5, 1.5, 2.5});
    }
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("Reading stops when it is asked to") {
  StopSource stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  std::string text(three_points);
  for (int i = 0; i < 100000; ++i) {
    text += "f 1 2 3\n";
  }
  try {
    (void)mesh::parse_soup(text, "model.obj", {}, context);
    FAIL("wasn't stopped");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::interrupted);
  }
}

TEST_CASE("OBJ: names of objects are fit to be printed") {
  const Soup soup = parsed("o a\xff\x1b[31m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "obj");
  REQUIRE(soup.objects.size() == 1);
  CHECK(soup.objects[0].second == "a\xef\xbf\xbd\xef\xbf\xbd[31m");
}

TEST_CASE("OBJ: a text that ends early is refused, wherever within its lines") {
  // Ten triangles in a row: each has a point more.
  std::string text;
  for (int i = 0; i < 12; ++i) {
    text += "v " + std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\nvt 0 0\n";
  }
  const std::size_t faces = text.size();
  for (int i = 1; i <= 10; ++i) {
    const auto corner = [](int p) { return " " + std::to_string(p) + "/" + std::to_string(p); };
    text += "f" + corner(i) + corner(i + 1) + corner(i + 2) + "\n";
  }
  const std::size_t last_face = text.rfind('f');
  for (std::size_t end = faces + 1; end < text.size(); ++end) {
    const std::string start = text.substr(0, end);
    const bool within_line = start.back() != '\n';
    const std::string told = refusal(start, "obj");
    // Three points are lacking where three faces are, and faces that lack a corner are known by themselves.
    if (within_line && start.find("f 8/8 ") == std::string::npos) {
      CAPTURE(start.substr(faces));
      CHECK(told.starts_with("3 model.obj"));
    }
  }
  CHECK(refusal(text.substr(0, last_face + 5), "obj") ==
        "3 model.obj, line 34: the file ends within a face, so it is cut off");
  CHECK(refusal(text.substr(0, faces + 13), "obj") ==
        "3 model.obj ends within a line, and 9 of its 12 points are used by no face: it is cut off");
  // Nobody minds a line's end that is missing at the end of a whole text, or a point that is left over.
  CHECK(refusal(text.substr(0, text.size() - 1), "obj").empty());
  CHECK(refusal("v 7 7 7\nv 8 8 8\n" + std::string(three_points) + "f -3 -2 -1", "obj").empty());
  // Points that only marked edges use are used.
  const std::string six_points = std::string(three_points) + "v 0 0 1\nv 0 1 1\nv 1 1 1\n";
  CHECK(refusal(six_points + "f 1 2 3\nl 4 5 6", "obj").empty());
  // So are those of elements that are ignored, and who ends with a remark has written all.
  CHECK(refusal(six_points + "p 4 5 6\nf 1 2 3", "obj").empty());
  CHECK(refusal(six_points + "f 1 2 3\n# 1 face", "obj").empty());
  CHECK_FALSE(refusal(six_points + "# 1 face\nf 1 2 3", "obj").empty());
}

// Material files and pictures beside a model, in a folder of the test's own.

using mesh::Colour;
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
  [[nodiscard]] Soup read_written(const std::string& name) const { return mesh::read_soup(path_ / name, {}); }

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

TEST_CASE("MTL: -s and -o place a picture, -clamp ends it, and what can't be shown is counted") {
  const Folder folder;
  folder.write("a.png", png);
  folder.write(
      "a.mtl",
      "newmtl moved\nmap_Kd -s 2 3 1 -o 0.25 -clamp off a.png\nnewmtl plain\nmap_Kd a.png\n"
      "newmtl clamped\nmap_Kd -clamp on -s 2 2 -mm 0.1 0.5 a.png\nd 0.5\nnewmtl leaf\nmap_d a.png\n");
  folder.write(
      "model.obj",
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.5\nvt 1 0\nvt 0 1\nusemtl moved\nf 1/1 2/2 3/3\n"
      "usemtl plain\nf 1/1 2/2 3/3\nusemtl clamped\nf 1/1 2/2 3/3\nusemtl leaf\nf 1/1 2/2 3/3\n");
  const Soup soup = folder.read_written("model.obj");
  const auto places = [&](std::size_t polygon) {
    std::vector<Vec2> found;
    for (std::uint32_t c = soup.first_corner[polygon]; c < soup.first_corner[polygon + 1]; ++c) {
      found.push_back(soup.texture_points[soup.corner_texture[c]]);
    }
    return found;
  };
  CHECK(places(0) == std::vector<Vec2>{{1.25, 1.5}, {2.25, 0.0}, {0.25, 3.0}});
  CHECK(places(1) == std::vector<Vec2>{{0.5, 0.5}, {1.0, 0.0}, {0.0, 1.0}});
  CHECK(places(2) == std::vector<Vec2>{{1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}});
  REQUIRE(soup.remarks.count(RepairKind::feature_ignored) == 2);
  CHECK(soup.remarks.entries().front().detail == "transparency of 2 materials and -mm of 1 picture");
}

TEST_CASE("OBJ: ZBrush's colours of points are those of the corners") {
  const Soup soup =
      parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB ffff0000ff00ff00ff0000ff\n#more\nf 1 2 3\n", "obj");
  CHECK(soup.corner_colour == std::vector<std::uint32_t>{0xff0000, 0x00ff00, 0x0000ff});
  // Colours behind the coordinates count more; a code that is none ends the list.
  CHECK(parsed("v 0 0 0 1 1 0\nv 1 0 0\nv 0 1 0\n#MRGB ffff0000\nf 1 2 3\n", "obj").corner_colour[0] ==
        0xffff00);
  CHECK(parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB zzzzzzzz\nf 1 2 3\n", "obj").corner_colour.empty());
  CHECK(parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB \nf 1 2 3\n", "obj").corner_colour.empty());
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
