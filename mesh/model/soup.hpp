// SPDX-License-Identifier: GPL-3.0-or-later
// What a model file says, as it says it: points and polygons that need not fit together.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/vector.hpp"
#include "mesh/model/file_format.hpp"
#include "mesh/model/file_frame.hpp"
#include "mesh/model/repair_report.hpp"

namespace ridgecraft::mesh {

/// Diffuse colour, each channel in [0, 1].
using Colour = std::array<double, 3>;

/// A material as the file has it. What is missing or can't be read is white and without picture.
struct Material {
  std::string name;
  std::optional<Colour> colour;
  /// Path of a picture that lies beside the model, relative to its folder; empty for none.
  std::string texture_file;
  /// Bytes of the picture (PNG or JPEG), whether it lies beside the model or within its file; null for none.
  std::shared_ptr<const std::string> picture = nullptr;
  /// The colour darkens the picture, as in glTF; elsewhere the picture takes the colour's place.
  bool tints_picture = false;

  [[nodiscard]] bool has_picture() const { return picture != nullptr; }
};

/// Polygons over indexed points, in the order of the file, nothing joined or dropped yet.
struct Soup {
  static constexpr std::uint32_t none = 0xffffffffU;

  std::vector<Vec3> points;          ///< finite
  std::vector<Vec2> texture_points;  ///< finite
  std::vector<Material> materials;

  /// Polygon i has the corners first_corner[i] .. first_corner[i + 1] - 1; the last entry is the number of
  /// corners. Polygons may have any number of corners (0, 1 and 2, too) and name a point more than once.
  std::vector<std::uint32_t> first_corner{0};
  std::vector<std::uint32_t> corner_point;  ///< index into points, in range
  std::vector<std::uint32_t>
      corner_texture;  ///< index into texture_points or none; empty when no corner has one
  /// Colour of each corner as 0xRRGGBB, or none; empty when no corner has one. It counts more than the
  /// material's, but not more than a picture.
  std::vector<std::uint32_t> corner_colour;
  std::vector<std::uint32_t>
      polygon_material;  ///< index into materials or none; empty when no polygon has one

  /// Names that a file has for its objects (those of groups where it names no objects): from this polygon on;
  /// printable.
  std::vector<std::pair<std::uint32_t, std::string>> objects;

  /// Edges that the lines of an OBJ file (l) or the edges of a PLY file name: indices into points, in range.
  /// Editors mark seams by them.
  std::vector<std::array<std::uint32_t, 2>> lines;

  FileFormat format = FileFormat::obj;
  FileFrame frame;
  /// Hashes of the other files that the shape comes from (buffers of glTF), one after the other.
  std::string beside_digest;
  /// What the reader ignored, corrected or wants to be known.
  RepairReport remarks;

  [[nodiscard]] std::size_t polygon_count() const { return first_corner.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> polygon(std::size_t i) const {
    return {corner_point.data() + first_corner[i], first_corner[i + 1] - first_corner[i]};
  }
};

}  // namespace ridgecraft::mesh
