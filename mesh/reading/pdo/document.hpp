// SPDX-License-Identifier: GPL-3.0-or-later
// A file of Pepakura Designer ("version 3", of Designer 2 to 5) as it stands: objects, where its nets lay
// each corner, materials. After the description of the format in github.com/dpethes/pdo-tools
// (doc/pdo_spec_draft.txt).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vector.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

struct PdoCorner {
  std::uint32_t point = 0;  ///< of its object, in range
  Vec2 flat;                ///< where its net lays it; may be anything
  Vec2 texture;             ///< from the picture's upper left corner, v down; may be anything
};

struct PdoFace {
  std::uint32_t material = Soup::none;  ///< may be out of range
  std::int32_t piece = -1;              ///< of the nets; below zero for none
  std::uint32_t first_corner = 0;
  std::uint32_t corner_count = 0;
};

struct PdoObject {
  std::string name;  ///< printable
  bool visible = true;
  std::vector<Vec3> points;  ///< finite
  std::vector<PdoFace> faces;
  std::vector<PdoCorner> corners;

  [[nodiscard]] std::span<const PdoCorner> corners_of(const PdoFace& face) const {
    return std::span(corners).subspan(face.first_corner, face.corner_count);
  }
};

/// Bytes of red, green and blue, row after row from the top, packed by zlib.
struct PdoPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string_view packed;
};

struct PdoMaterial {
  std::string name;  ///< printable
  Colour colour{};   ///< on paper; may be anything
  std::optional<PdoPicture> picture;
};

struct PdoDocument {
  std::vector<PdoObject> objects;
  std::vector<PdoMaterial> materials;
  bool has_nets = false;
  double mm_per_unit = 0.0;  ///< of its nets; may be anything, and 0 without them
  bool ends_well = false;    ///< with the mark that every file ends with
};

/// True for bytes that begin as these files do.
[[nodiscard]] bool is_pdo(std::string_view bytes);

/// Reads it. Views are into the source's bytes. Throws unreadable_input where a count, an index or the end
/// doesn't fit, for other versions, and for files that their author has locked with a password; unusable_mesh
/// for a coordinate that isn't finite. Linear.
[[nodiscard]] PdoDocument read_pdo_document(const Source& source);

/// The objects that the file shows; all where it shows none.
[[nodiscard]] std::vector<const PdoObject*> shown_objects(const PdoDocument& document);

}  // namespace ridgecraft::mesh
