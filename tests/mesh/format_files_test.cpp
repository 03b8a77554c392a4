// SPDX-License-Identifier: GPL-3.0-or-later
// The collection of glTF, GLB and 3MF files of the shared folder, which isn't part of the repository: all are
// read with the faces that they have, or refused.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "reading.hpp"
#include "support/temporary_folder.hpp"

using namespace ridgecraft;
using namespace ridgecraft::test;
namespace fs = std::filesystem;

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
    {"glTF2/draco/2CylinderEngine.gltf", -3},
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
    {"glTF2/draco/2CylinderEngine.gltf", "KHR_draco_mesh_compression"},
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
