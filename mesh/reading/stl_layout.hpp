// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of a binary STL file: 80 bytes of anything, a count, then facets of a normal, three corners and two
// bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ridgecraft::mesh {

inline constexpr std::size_t stl_count_at = 80;
inline constexpr std::size_t stl_header_size = 84;
inline constexpr std::size_t stl_facet_size = 50;

/// The count in the header of at least stl_header_size bytes.
[[nodiscard]] constexpr std::uint32_t stl_facet_count(std::string_view bytes) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    count |= std::uint32_t{static_cast<unsigned char>(bytes[stl_count_at + i])} << (8 * i);
  }
  return count;
}

[[nodiscard]] constexpr std::uint64_t stl_file_size(std::uint64_t facets) {
  return stl_header_size + stl_facet_size * facets;
}

}  // namespace ridgecraft::mesh
