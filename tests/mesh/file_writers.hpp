// SPDX-License-Identifier: GPL-3.0-or-later
// Writers of model files, independent of the readers and of mesh/mesh.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vector.hpp"
#include "mesh/model/soup.hpp"

namespace ridgecraft::test {

// Writes the containers of new formats, independently of the readers: GLB files, ZIP archives, base64.

/// The four bytes of a number, little-endian; likewise two, and those of a float.
[[nodiscard]] std::string bytes4(std::uint32_t value);
[[nodiscard]] std::string bytes2(std::uint32_t value);
[[nodiscard]] std::string float_bytes(const std::vector<float>& values);

[[nodiscard]] std::string glb(std::string json, std::string binary);
[[nodiscard]] std::string base64(std::string_view bytes);

enum class Packing { stored, deflated };
using ZipFiles = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] std::string zip(const ZipFiles& files, Packing packing = Packing::stored);

/// A 3MF file with this XML as its root part, and more parts.
[[nodiscard]] std::string threemf(const std::string& model, const ZipFiles& more = {},
                                  Packing packing = Packing::stored);

// Writes PDO files of every version after the format's description, independently of the reader.

/// How a file is written: its version and its kinds of strings.
struct PdoStyle {
  std::uint32_t version = 6;
  bool wide = false;
  bool length_in_bytes = false;  ///< of wide strings; else in characters
  std::uint32_t shift = 0;       ///< from version 5 on
  bool locked = false;           ///< from version 5 on
};

struct PdoTestFace {
  std::vector<std::uint32_t> points;
  std::vector<Vec2> flat;     ///< one a corner, or none: all at the origin
  std::vector<Vec2> texture;  ///< likewise
  std::int32_t piece = 0;
  std::int32_t material = -1;
};
struct PdoTestObject {
  std::string name;
  std::vector<Vec3> points;
  std::vector<PdoTestFace> faces;
  bool visible = true;
};
struct PdoTestMaterial {
  std::string name;
  std::vector<float> colour{1, 1, 1};
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::optional<std::string> pixels;  ///< to be packed
};
struct PdoTestFile {
  std::vector<PdoTestObject> objects;
  std::vector<PdoTestMaterial> materials;
  std::optional<double> scale = 1.0;  ///< of its nets; none for a file without
};

[[nodiscard]] std::string pdo(const PdoTestFile& file, const PdoStyle& style = {});

/// A cube with edges of 2, from the origin: five sides in one piece around the one with y = 0, the bottom in
/// another.
[[nodiscard]] PdoTestObject pdo_cube();

/// The cube and a hidden triangle, in colour and with a picture.
[[nodiscard]] PdoTestFile rich_pdo_file();

// Writes soups in all formats that are read, independently of mesh/mesh.hpp: polygons of any size, in the
// forms that other programs use.

enum class SoupFormat { obj, off, ply_ascii, ply_little_endian, ply_big_endian, stl_ascii, stl_binary };

/// Points and polygons only. STL takes triangles and rounds to float in its binary form.
[[nodiscard]] std::string written(const mesh::Soup& soup, SoupFormat format);

}  // namespace ridgecraft::test
