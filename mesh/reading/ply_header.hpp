// SPDX-License-Identifier: GPL-3.0-or-later
// The header of a PLY file (Greg Turk, "The PLY Polygon File Format", 1994): which elements follow, of what.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary file.
[[nodiscard]] constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
[[nodiscard]] constexpr bool is_integer(PlyType type) {
  return type < PlyType::float32;
}

struct PlyProperty {
  std::string_view name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType length_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string_view name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string_view> pictures;  ///< of "comment TextureFile NAME" lines, as MeshLab writes them
  std::string_view body;                   ///< the bytes after the header
};

/// Throws Error(unreadable_input). The counts are what the header says; nothing is known of whether they are
/// true.
[[nodiscard]] PlyHeader read_ply_header(const Source& source);

}  // namespace ridgecraft::mesh
