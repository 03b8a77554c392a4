// SPDX-License-Identifier: GPL-3.0-or-later
// Which files are read at all, and as what.
#include <filesystem>
#include <fstream>
#include <set>

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "base/encodings.hpp"
#include "base/text.hpp"
#include "reading.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
using namespace std::string_literals;
using mesh::RepairKind;
namespace fs = std::filesystem;

namespace {

std::string refusal_of_file(const fs::path& path) {
  try {
    (void)mesh::read_soup(path, {});
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("The suffix decides only where the content could be several") {
  const std::string obj = "# c\n\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string suffix : {"obj", "OBJ", "stl", "ply", "off", "txt", ""}) {
    INFO(suffix);
    const bool other = suffix == "stl" || suffix == "ply";
    CHECK(parsed(obj, suffix).remarks.count(RepairKind::content_is_other_format) ==
          (other || suffix == "off" ? 1 : 0));
    CHECK(parsed(off, suffix).format == mesh::FileFormat::off);
  }
  CHECK(refusal("# nothing\n", "obj").starts_with("4 "));
  CHECK(refusal("# nothing\n", "txt").starts_with("3 "));
  CHECK(refusal("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "").empty());
}

TEST_CASE("Files that are something else are named for it") {
  const auto says = [](std::string_view bytes, const std::string& word) {
    const std::string sentence = refusal(bytes, "stl");
    INFO(sentence);
    CHECK(sentence.starts_with("3 model.stl is "));
    CHECK(sentence.find(word) != std::string::npos);
  };
  says("\x1f\x8b\x08\0\0"s, "gzip");
  says("PK\x03\x04\0\0\0\0"s, "ZIP");
  says("\x89PNG\r\n\x1a\n\0\0"s, "PNG");
  says("\xff\xd8\xff\xe0JFIF"s, "JPEG");
  says("{\"a\": 1}", "JSON");
  says("Kaydara FBX Binary  \0"s, "FBX");
  says("; FBX 7.3.0 project file\n", "FBX");
  says("BLENDER-v279", "Blender");
  says("ISO-10303-21;\nHEADER;", "STEP");
  says("%PDF-1.7", "PDF");
  says("\xff\xfev\0 \0"s, "UTF-16");
  says("<!DOCTYPE html><html>404", "HTML");
  says("<?xml version=\"1.0\"?>\n<COLLADA xmlns", "COLLADA");
  says("<?xml version=\"1.0\"?>\n<thing>", "XML");
  says("#VRML V2.0 utf8", "VRML");
  says("# vtk DataFile Version 3.0", "VTK");
  says(std::string(1000, '\0'), "zero bytes");
  says("version https://git-lfs.github.com/spec/v1\noid", "Git LFS");
}

TEST_CASE("Models of other formats are refused with a way out") {
  const auto says = [](const std::string& name, std::string_view bytes, const std::string& start,
                       const std::string& way) {
    try {
      (void)mesh::parse_soup(bytes, name, {}, {});
      FAIL_CHECK("read");
    } catch (const Error& error) {
      const std::string sentence = error.what();
      INFO(sentence);
      CHECK(error.kind() == ErrorKind::unreadable_input);
      CHECK(sentence.starts_with(name + " is " + start + ", "));
      CHECK(sentence.find(way) != std::string::npos);
    }
  };
  says("a.txt", "ISO-10303-21;\nHEADER;", "a STEP model", "FreeCAD");
  says("a.stp", "some text", "a STEP model", "FreeCAD");
  says("a.skp", "\xff\xfe\xff\x0eS\0k\0e\0t\0c\0h\0U\0p\0 \0M\0"s, "a SketchUp model",
       "from SketchUp as glTF");
  says("a.SKP", "PK\x03\x04\0\0\0\0"s, "a SketchUp model", "from SketchUp as glTF");
  says("a", "Kaydara FBX Binary  \0"s, "an FBX model", "Blender");
  says("a.usdz", "PK\x03\x04\0\0\0\0"s, "a USD model", "Blender");
  says("a.sldprt", "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"s, "a SolidWorks model", "OBJ, STL or 3MF");
  says("a.dae", "<?xml version=\"1.0\"?>\n<COLLADA xmlns", "a COLLADA model", "Blender");
  says("a.igs", "                                        S      1", "an IGES model", "FreeCAD");
  says("a", "Metasequoia Document\nFormat Text", "a Metasequoia model", "glTF (.glb), OBJ or STL");
  says("a", "PMX \0\0\0@"s, "a model of MikuMikuDance (PMX)", "MMD Tools");
  says("a", "Pmd\0\0\x80?"s, "a model of MikuMikuDance (PMD)", "MMD Tools");
  says("a", "VOX \x96\0\0\0MAIN"s, "a MagicaVoxel model", "MagicaVoxel as OBJ or PLY");
  says("a", R"({"meta":{"format_version":"4.5","model_format":"free"}})", "a Blockbench model",
       "Blockbench as glTF");
  says("a.bbmodel", R"({"elements":[]})", "a Blockbench model", "Blockbench as glTF");
  says("a.json", R"({"type":"CityJSON","version":"1.1"})", "a CityJSON city model",
       "'cjio FILE export obj FILE.obj'");
  says("a.gml", "<?xml version=\"1.0\"?>\n<core:CityModel xmlns", "a CityGML city model", "citygml-tools");
  says("a.mpd", "0 FILE main.ldr\n0 name\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat\n", "an LDraw model",
       "LeoCAD");
  says("a.ldr", "0 Untitled\n1 16 0 0 0 1 0 0 0 1 0 0 0 1 3001.dat\n", "an LDraw model", "LeoCAD");
  says("a.pdo", "version 2\n\x04\0"s, "a Pepakura file of another version", "Pepakura Designer");
  // Blender's own files say who saved them; from 3.0 on they are packed.
  CHECK(refusal("BLENDER-v304", "blend") ==
        "3 model.blend was saved by Blender 3.4, and files up to 2.79 are read: open it in Blender and "
        "export it as "
        "glTF (.glb) or OBJ");
  CHECK(refusal("BLENDER_v280", "blend").find("by Blender 2.80, and files up to 2.79") != std::string::npos);
  CHECK(refusal("BLENDER17-01v0500", "blend").find("by Blender 5.0, and") != std::string::npos);
  CHECK(refusal("\x28\xb5\x2f\xfd\0\0"s, "blend").find("by Blender 3.0 or later, and") != std::string::npos);
  CHECK(refusal("BLENDER-v279", "blend").find("is a Blender file") != std::string::npos);
  // What the content says counts for more than the suffix.
  CHECK(refusal("\x89PNG\r\n\x1a\n\0\0"s, "fbx") == "3 model.fbx is no mesh but a PNG picture");
  CHECK(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "fbx").empty());
}

TEST_CASE("Only regular files are read, and a refusal names the file") {
  const fs::path folder = fs::temp_directory_path() / ("ridgecraft_read_" + std::to_string(::getpid()));
  fs::create_directories(folder / "folder.obj");
  REQUIRE(::mkfifo((folder / "pipe.obj").c_str(), 0600) == 0);
  std::ofstream(folder / "closed.obj") << "v 0 0 0\n";
  fs::permissions(folder / "closed.obj", fs::perms::none);
  std::ofstream(folder / "empty.obj").flush();
  fs::create_symlink("loop.obj", folder / "loop.obj");
  const std::string at = folder.string();
  CHECK(refusal_of_file(folder / "none.obj") == at + "/none.obj doesn't exist");
  CHECK(refusal_of_file(folder / "empty.obj" / "x.obj") == at + "/empty.obj/x.obj doesn't exist");
  CHECK(refusal_of_file(folder / "folder.obj") == at + "/folder.obj is a folder, not a file");
  CHECK(refusal_of_file(folder / "pipe.obj").find("is a pipe or device") != std::string::npos);
  CHECK(refusal_of_file("/dev/zero").find("is a pipe or device") != std::string::npos);
  CHECK(refusal_of_file(folder / "empty.obj") == at + "/empty.obj is empty");
  CHECK(refusal_of_file(folder / "loop.obj").find("can't be read") != std::string::npos);
  CHECK(refusal_of_file("").find("doesn't exist") != std::string::npos);
  if (::geteuid() != 0) {  // root may read everything
    CHECK(refusal_of_file(folder / "closed.obj").find("no permission") != std::string::npos);
  }
  // A file of holes takes no room, but would take all memory.
  std::ofstream(folder / "huge.obj").flush();
  std::error_code too_large;
  fs::resize_file(folder / "huge.obj", (std::uintmax_t{1} << 32U) + 1, too_large);
  if (!too_large) {
    CHECK(refusal_of_file(folder / "huge.obj").find("is too large") != std::string::npos);
  }
  fs::remove_all(folder);
}

TEST_CASE("Messages are one line of valid UTF-8") {
  CHECK(printable("a\n\x1b[0m") == "a\xef\xbf\xbd\xef\xbf\xbd[0m");
  CHECK(printable("F\xc3\xbc"s + "chsin \xe7\x8b\x90 \xf0\x9f\xa6\x8a") ==
        "F\xc3\xbc"s + "chsin \xe7\x8b\x90 \xf0\x9f\xa6\x8a");
  CHECK(printable("\xc3") == "\xef\xbf\xbd");
  CHECK(printable("\xed\xa0\x80") == "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");  // a surrogate
  CHECK(printable("\xc0\x80").size() == 6);                                    // an overlong zero
  CHECK(printable("\xc2\x85") == "\xef\xbf\xbd");                              // next line
  CHECK(printable("a\xef\xb7\x90") == "a\xef\xbf\xbd");                        // a noncharacter
  CHECK(printable("a\xe2\x80\xae"
                  "b") ==
        "a\xef\xbf\xbd"
        "b");  // would turn what follows around
  CHECK(in_quotes(std::string(39, 'a') + "\xc3\xbc" + "b") == '"' + std::string(39, 'a') + "...\"");
}

TEST_CASE("Digests are fixed and tell bytes apart") {
  // These values are written into files that people keep: they must not change.
  CHECK(digest("") == digest(""));
  CHECK(digest("").size() == 16);
  std::set<std::string> seen;
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    CHECK(seen.insert(digest(bytes)).second);
    bytes += '\0';
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string other = bytes;
      other[i] = static_cast<char>(1U << bit);
      CHECK(seen.insert(digest(other)).second);
    }
  }
}

TEST_CASE("Every kind of repair has a word and sentences for one and for many") {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(RepairKind::narrow_faces); ++i) {
    const auto kind = static_cast<RepairKind>(i);
    CHECK(names.insert(mesh::name(kind)).second);
    CHECK(mesh::name(kind).find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string_view::npos);
    const auto sentence = [&](std::size_t count) { return english(mesh::message({kind, count, ""})); };
    CHECK(sentence(1) != sentence(2));
    CHECK(sentence(24).find("24") != std::string::npos);
  }
  CHECK(english(mesh::message({RepairKind::points_joined, 24, "x"})) ==
        "24 points at equal places were joined (x)");
  mesh::RepairReport report;
  report.add(RepairKind::cut_open, 0, "none");
  report.add(RepairKind::faces_turned, 2);
  report.add(RepairKind::cut_open, 1, "first");
  report.add(RepairKind::faces_turned, 3, "second");
  report.add(report);
  REQUIRE(report.entries().size() == 2);
  CHECK(report.count(RepairKind::faces_turned) == 10);
  CHECK(report.entries()[0].detail == "second");
  CHECK(report.entries()[1].detail == "first");
}
