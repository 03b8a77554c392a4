// SPDX-License-Identifier: GPL-3.0-or-later
// Writes PDO files of every version after the format's description, independently of the reader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::test {

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

}  // namespace ridgecraft::test
