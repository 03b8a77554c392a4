// SPDX-License-Identifier: GPL-3.0-or-later
// Materials and pictures of glTF.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/vector.hpp"
#include "mesh/reading/gltf/document.hpp"
#include "mesh/reading/material_table.hpp"

namespace ridgecraft::mesh {

/// glTF counts colours by their light, files and screens by what eyes see (sRGB, IEC 61966-2-1).
[[nodiscard]] ColourBytes screen_colour(const Colour& light);

/// How a picture lies on faces.
struct GltfPicture {
  std::string texture_file;                    ///< as in Material
  std::shared_ptr<const std::string> picture;  ///< as in Material
  std::uint64_t coordinates = 0;               ///< which set of coordinates of a point (TEXCOORD_n)
  Vec2 row_u{1.0, 0.0};                        ///< KHR_texture_transform, as the file has it: v runs down
  Vec2 row_v{0.0, 1.0};
  Vec2 shift;

  /// Coordinates of the file become those of Soup: v runs up.
  [[nodiscard]] Vec2 place(Vec2 uv) const {
    return {dot(row_u, uv) + shift.x, 1.0 - (dot(row_v, uv) + shift.y)};
  }
};

struct GltfMaterial {
  std::string name;                ///< printable
  std::optional<Colour> light;     ///< base colour by its light; nothing for white
  std::optional<GltfPicture> map;  ///< a picture that can be used
};

/// Reads materials, each once. Pictures that can't be used are remarked on.
class GltfPaint {
 public:
  GltfPaint(GltfDocument& document, RepairReport& remarks) : document_(document), remarks_(remarks) {}

  /// `user` names the material.
  [[nodiscard]] const GltfMaterial& material(std::uint64_t i, const GltfObject& user);

 private:
  [[nodiscard]] GltfMaterial read(const GltfObject& material);
  [[nodiscard]] std::optional<GltfPicture> read_map(const GltfObject& map);
  void load(std::uint64_t image, const GltfObject& texture, GltfPicture& into);

  struct Loaded {
    std::string file;
    std::shared_ptr<const std::string> bytes;
  };

  GltfDocument& document_;
  RepairReport& remarks_;
  std::map<std::uint64_t, GltfMaterial> read_;
  std::map<std::uint64_t, Loaded> loaded_;
  std::uint64_t looked_at_ = 0;  ///< bytes of pictures
};

}  // namespace ridgecraft::mesh
