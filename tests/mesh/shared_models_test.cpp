// SPDX-License-Identifier: GPL-3.0-or-later
// The collections of the shared folder, which isn't part of the repository: broken files, makers' models,
// glTF, GLB and 3MF files.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepare.hpp"
#include "reading.hpp"
#include "support/soups.hpp"
#include "support/temporary_folder.hpp"

// Models of makers, and files that are broken in every way known, on their way to paper.

using namespace ridgecraft;
namespace {

/// The folder of models that aren't ours to ship; tests of them say so where it is missing.
const std::filesystem::path shared_models = std::filesystem::path(RIDGECRAFT_SHARED_DIR) / "models";

struct Outcome {
  int code = 0;
  bool changed = false;
  bool simplified = false;
  std::string message;
};

Outcome run(const std::filesystem::path& file) {
  Outcome outcome;
  try {
    const prepare::Prepared p = prepare::prepare(mesh::read(file, {}, {}), {}, {}, {{190.0, 270.0}}, {});
    test::check_invariants(p.model.surface);
    for (const mesh::Repair& repair : p.model.repairs.entries()) {
      // An open border and faces that run through each other are told, but nothing is done about them.
      outcome.changed = outcome.changed || (repair.kind != mesh::RepairKind::open_border &&
                                            repair.kind != mesh::RepairKind::self_intersections);
    }
    outcome.simplified = p.simplified.deviation_mm > 0.0;
    const Vec3 size = p.model.surface.bounds().size();
    CHECK(std::isfinite(length(size)));
    CHECK(std::max({size.x, size.y, size.z}) < 156.1);
  } catch (const Error& error) {
    outcome.message = error.what();
    outcome.code = error.kind() == ErrorKind::unreadable_input ? 3
                   : error.kind() == ErrorKind::unusable_mesh  ? 4
                   : error.kind() == ErrorKind::no_nets        ? 5
                                                               : 1;
  }
  return outcome;
}

}  // namespace

TEST_CASE("broken files are repaired or refused as documented", "[cases]") {
  const std::filesystem::path folder = shared_models / "broken" / "generated";
  std::ifstream table(folder / "CASES.tsv");
  if (!table) {
    WARN("no broken models here: " << folder.string());
    return;
  }
  std::string line;
  std::getline(table, line);
  int cases = 0;
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    std::string file;
    std::string what;
    std::string reaction;
    std::string code;
    std::getline(fields, file, '\t');
    std::getline(fields, what, '\t');
    std::getline(fields, reaction, '\t');
    std::getline(fields, code, '\t');
    INFO(file << ": " << what);
    const Outcome outcome = run(folder / file);
    INFO(outcome.message);
    CHECK(outcome.code == std::stoi(code));
    if (reaction == "repaired+warning" && outcome.code == 0) {
      // Simplification mends what is too fine to be folded.
      CHECK((outcome.changed || outcome.simplified));
    }
    if (reaction == "ok") {
      // docs/design/mesh.md: ignored elements, unused points and bent polygons are told, though nothing is
      // wrong.
      const bool remarked =
          file == "other_elements.obj" || file == "hard_monkey_saddle.obj" || file == "points_unused.obj";
      CHECK((!outcome.changed || remarked));
    }
    if (outcome.code == 3 || outcome.code == 4) {
      CHECK(outcome.message.find(file) != std::string::npos);
    }
    ++cases;
  }
  CHECK(cases > 150);
}

TEST_CASE("models of makers become foldable", "[cases]") {
  if (!std::filesystem::exists(shared_models / "makers")) {
    WARN("no makers' models here");
    return;
  }
  for (const auto& entry : std::filesystem::directory_iterator(shared_models / "makers")) {
    const std::string suffix = entry.path().extension().string();
    if (suffix == ".obj" || suffix == ".stl" || suffix == ".ply" || suffix == ".off") {
      INFO(entry.path().string());
      CHECK(run(entry.path()).code == 0);
    }
  }
}

// The broken files and the makers' models of the shared folder, which isn't part of the repository.

using mesh::RepairKind;
using mesh::Soup;
namespace fs = std::filesystem;

namespace {

struct Case {
  std::string file;
  int exit_code = 0;
  std::string reaction;
};

std::vector<Case> broken_cases() {
  std::ifstream table(shared_models / "broken/generated/CASES.tsv");
  std::string line;
  std::getline(table, line);
  std::vector<Case> cases;
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    Case c;
    std::string wrong;
    std::string code;
    std::getline(cells, c.file, '\t');
    std::getline(cells, wrong, '\t');
    std::getline(cells, c.reaction, '\t');
    std::getline(cells, code, '\t');
    c.exit_code = std::stoi(code);
    cases.push_back(c);
  }
  return cases;
}

/// Refusals with exit code 4 that need the mesh to be looked at, not only read.
bool decided_by_repair(const std::string& file) {
  return file == "all_points_equal.obj" || file == "all_points_on_a_line.obj" ||
         file == "one_point_at_1e200.obj";
}

/// What the reader has to remark on; all other files are read without a word.
const std::map<std::string, RepairKind> expected_remarks{
    {"zero_bytes_at_end.obj", RepairKind::trailing_data_ignored},
    {"stl_inside.obj", RepairKind::content_is_other_format},
    {"obj_inside.stl", RepairKind::content_is_other_format},
    {"off_inside.ply", RepairKind::content_is_other_format},
    {"ply_inside.off", RepairKind::content_is_other_format},
    {"other_elements.obj", RepairKind::element_ignored},
    {"mtl_missing.obj", RepairKind::material_file_missing},
    {"mtl_is_itself.obj", RepairKind::material_file_missing},
    {"mtl_absolute_path.obj", RepairKind::material_file_missing},
    {"mtl_undefined_name.obj", RepairKind::material_unknown},
    {"mtl_bad_colours.obj", RepairKind::material_value_corrected},
    {"texture_missing.obj", RepairKind::texture_missing},
    {"texture_cut_off.obj", RepairKind::texture_missing},
    {"texture_is_text.obj", RepairKind::texture_missing},
    {"texture_empty.obj", RepairKind::texture_missing},
    {"texture_index_too_high.obj", RepairKind::texture_point_dropped},
    {"texture_far_outside.obj", RepairKind::texture_point_dropped},
    {"count_too_low.stl", RepairKind::count_corrected},
    {"count_zero.stl", RepairKind::count_corrected},
    {"ascii_no_endsolid.stl", RepairKind::missing_end},
};

void check_remarks(const std::string& file, const Soup& soup) {
  const auto expected = expected_remarks.find(file);
  CHECK(soup.remarks.entries().size() == (expected == expected_remarks.end() ? 0 : 1));
  if (expected != expected_remarks.end()) {
    CHECK(soup.remarks.count(expected->second) > 0);
  }
}

}  // namespace

TEST_CASE("Broken files are read or refused as the table of cases proposes") {
  if (!fs::exists(shared_models / "broken/generated/CASES.tsv")) {
    WARN("no shared folder: skipped");
    return;
  }
  const std::vector<Case> cases = broken_cases();
  CHECK(cases.size() > 150);
  for (const Case& c : cases) {
    INFO(c.file);
    const fs::path path = shared_models / "broken/generated" / c.file;
    const bool refused = c.exit_code == 3 || (c.exit_code == 4 && !decided_by_repair(c.file));
    try {
      const Soup soup = mesh::read_soup(path, {});
      CHECK(!refused);
      check_remarks(c.file, soup);
    } catch (const Error& error) {
      INFO(error.what());
      CHECK(refused);
      CHECK(error.kind() == (c.exit_code == 3 ? ErrorKind::unreadable_input : ErrorKind::unusable_mesh));
      const std::string_view sentence = error.what();
      CHECK(sentence.starts_with(path.string()));
      CHECK(sentence.size() > path.string().size() + 5);
      CHECK(!sentence.ends_with('.'));
    }
  }
}

TEST_CASE("Files that differ only in form hold the same house") {
  if (!fs::exists(shared_models / "broken/generated")) {
    WARN("no shared folder: skipped");
    return;
  }
  const auto read = [](const std::string& file) {
    return mesh::read_soup(shared_models / "broken/generated" / file, {});
  };
  const Soup house = read("crlf.obj");
  for (const std::string file : {"utf8_bom.obj",
                                 "tabs.obj",
                                 "blank_lines.obj",
                                 "no_final_newline.obj",
                                 "zero_bytes_at_end.obj",
                                 "long_comment_line.obj",
                                 "no_suffix",
                                 "line_continuation.obj",
                                 "faces_before_points.obj",
                                 "relative_indices.obj",
                                 "corner_forms_mixed.obj",
                                 "point_colours.obj",
                                 "fourth_coordinate.obj",
                                 "number_forms.obj",
                                 "texture_options.obj",
                                 "crlf.off",
                                 "comments.off",
                                 "counts_beside_keyword.off",
                                 "point_colours.off",
                                 "point_normals.off",
                                 "face_colours.off",
                                 "big_endian.ply",
                                 "list_types.ply",
                                 "edges_element.ply"}) {
    INFO(file);
    const Soup soup = read(file);
    CHECK(soup.points == house.points);
    CHECK(soup.first_corner == house.first_corner);
    CHECK(soup.corner_point == house.corner_point);
  }
  const Soup facets = read("attribute_bytes.stl");
  for (const std::string file :
       {"ascii_capitals.stl", "ascii_no_endsolid.stl", "count_zero.stl", "normals_wrong.stl",
        "solid_but_binary.stl", "unknown_suffix.mesh3d", "stl_inside.obj"}) {
    INFO(file);
    CHECK(read(file).points == facets.points);
  }
}

TEST_CASE("The makers' models have the faces that their table says") {
  if (!fs::exists(shared_models / "makers/README.md")) {
    WARN("no shared folder: skipped");
    return;
  }
  std::ifstream table(shared_models / "makers/README.md");
  std::string line;
  std::size_t found = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '|');) {
      cells.push_back(cell.substr(std::min<std::size_t>(cell.size(), 1)));
    }
    if (cells.size() < 6 || cells[1].find('.') == std::string::npos || cells[1].starts_with("File")) {
      continue;
    }
    const std::string file = cells[1].substr(0, cells[1].find(' '));
    INFO(file);
    const Soup soup = mesh::read_soup(shared_models / "makers" / file, {});
    ++found;
    CHECK(soup.polygon_count() == std::stoul(cells[4]));
    CHECK(soup.points.size() == std::stoul(cells[5]));
    CHECK(soup.remarks.entries().empty());
    const bool textured = cells[3].starts_with("texture");
    CHECK(!soup.corner_texture.empty() == textured);
    const bool picture = std::any_of(soup.materials.begin(), soup.materials.end(),
                                     [](const mesh::Material& m) { return !m.texture_file.empty(); });
    CHECK(picture == textured);
    CHECK(soup.materials.empty() == cells[3].starts_with("-"));
  }
  CHECK(found == 15);
}

// The collection of glTF, GLB and 3MF files of the shared folder, which isn't part of the repository: all are
// read with the faces that they have, or refused.

using namespace ridgecraft::test;

namespace {

/// Triangles, counted from the JSON of the files by another program; below zero: refused with this exit code.
const std::map<std::string, int> expected{
    {"3MF/box.3mf", 12},
    {"3MF/malformed_property_index_oob.3mf", -3},
    {"3MF/production_components.3mf", 8},
    {"glTF/BoxTextured-glTF-Binary/BoxTextured.glb", -3},
    {"glTF/BoxTextured-glTF-Embedded/BoxTextured.gltf", -3},
    {"glTF/BoxTextured-glTF-MaterialsCommon/BoxTextured.gltf", -3},
    {"glTF/BoxTextured-glTF/BoxTextured.gltf", -3},
    {"glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", -3},
    {"glTF/IncorrectVertexArrays/Cube_v1.gltf", -3},
    {"glTF/TwoBoxes/TwoBoxes.gltf", -3},
    {"glTF2/AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", 12},
    {"glTF2/AnimatedMorphSphere/glTF/AnimatedMorphSphere.gltf", 960},
    {"glTF2/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", 12},
    {"glTF2/BoxTexcoords-glTF/boxTexcoords.gltf", 12},
    {"glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", 12},
    {"glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", 12},
    {"glTF2/BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf", 12},
    {"glTF2/BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", 12},
    {"glTF2/BoxTextured-glTF/BoxTextured.gltf", 12},
    {"glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", -4},
    {"glTF2/ClearCoat-glTF/ClearCoatTest.gltf", 37116},
    {"glTF2/IncorrectVertexArrays/Cube.gltf", -3},
    {"glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf", -3},
    {"glTF2/IndexOutOfRange/IndexOutOfRange.gltf", -3},
    {"glTF2/MissingBin/BoxTextured.gltf", -3},
    {"glTF2/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf", 32},
    {"glTF2/MorphStressTest/glTF/MorphStressTest.gltf", 2412},
    {"glTF2/RecursiveNodes/RecursiveNodes.gltf", -3},
    {"glTF2/SchemaFailures/sceneWrongType.gltf", -3},
    {"glTF2/SimpleMorph/glTF/SimpleMorph.gltf", 1},
    {"glTF2/TestNoRootNode/NoScene.gltf", -3},
    {"glTF2/TestNoRootNode/SceneWithoutNodes.gltf", -4},
    {"glTF2/cameras/Cameras.gltf", 2},
    {"glTF2/draco/2CylinderEngine.gltf", 110336},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_00.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_01.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_02.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_03.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_04.gltf", 2},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf", 2},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_06.gltf", 2},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_07.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_08.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_09.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_10.gltf", -4},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_11.gltf", 2},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_12.gltf", 2},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_13.gltf", 2},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_14.gltf", 2},
    {"glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_15.gltf", 2},
    {"glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", 12},
    {"glTF2/issue_3269/texcoord_crash.gltf", 10},
    {"glTF2/simple_skin/quad_skin.glb", 2},
    {"glTF2/simple_skin/simple_skin.gltf", 8},
    {"glTF2/textureTransform/TextureTransformTest.gltf", 24},
    {"glTF2/wrongTypes/badArray.gltf", -3},
    {"glTF2/wrongTypes/badExtension.gltf", -3},
    {"glTF2/wrongTypes/badNumber.gltf", 12},
    {"glTF2/wrongTypes/badObject.gltf", -3},
    {"glTF2/wrongTypes/badString.gltf", 12},
    {"glTF2/wrongTypes/badUint.gltf", -3}};

/// What a refusal says of some of them.
const std::map<std::string, std::string> words{
    {"glTF/TwoBoxes/TwoBoxes.gltf", "is a glTF 1.0 model, and only version 2 is read"},
    {"glTF/BoxTextured-glTF-Binary/BoxTextured.glb", "is a glTF 1 model"},
    {"glTF2/MissingBin/BoxTextured.gltf", "was not found beside the model"},
    {"glTF2/wrongTypes/badUint.gltf", "\"index\" is no whole number"},
    {"glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "is not finite"},
    {"3MF/malformed_property_index_oob.3mf", "names colour or material 1000000"}};

int code(const Error& error) {
  return error.kind() == ErrorKind::unreadable_input ? -3
         : error.kind() == ErrorKind::unusable_mesh  ? -4
                                                     : -1;
}

}  // namespace

TEST_CASE("the collection of glTF and 3MF files is read or refused as it should be", "[cases]") {
  const fs::path archive = fs::path(RIDGECRAFT_SHARED_DIR) / "models/formats.tar.xz";
  if (!fs::exists(archive)) {
    WARN("no collection of formats here: " << archive.string());
    return;
  }
  const TemporaryFolder folder(memory());
  REQUIRE(std::system(("tar xJf '" + archive.string() + "' -C '" + folder.path().string() + "'").c_str()) ==
          0);
  const fs::path root = folder / "formats";
  std::size_t found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string suffix = entry.path().extension().string();
    if (suffix != ".gltf" && suffix != ".glb" && suffix != ".3mf") {
      continue;
    }
    ++found;
    const std::string name = entry.path().lexically_relative(root).string();
    INFO(name);
    const auto wanted = expected.find(name);
    REQUIRE(wanted != expected.end());
    try {
      const mesh::Soup soup = mesh::read_soup(entry.path(), {});
      CHECK(wanted->second == static_cast<int>(soup.polygon_count()));
      CHECK(soup.frame.mm_per_unit == (suffix == ".3mf" ? 1.0 : 1000.0));
    } catch (const Error& error) {
      const std::string sentence = error.what();
      INFO(sentence);
      CHECK(wanted->second == code(error));
      CHECK(sentence.starts_with(entry.path().string()));
      CHECK(sentence.size() < 400);
      if (const auto word = words.find(name); word != words.end()) {
        CHECK(sentence.find(word->second) != std::string::npos);
      }
    }
  }
  CHECK(found == expected.size());
}
