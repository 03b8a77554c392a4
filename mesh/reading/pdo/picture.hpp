// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of PDO files are bare pixels; everything else here takes PNG.
#pragma once

#include <string>

#include "mesh/reading/pdo/document.hpp"

namespace ridgecraft::mesh {

/// The bytes of more pixels than this (three each) are refused: 4,700 by 4,700.
inline constexpr std::uint64_t largest_pdo_picture = std::uint64_t{64} << 20U;

/// Either a PNG file or what is wrong, as "is damaged".
struct PdoPng {
  std::string bytes;
  std::string fault;
};
[[nodiscard]] PdoPng png_of(const PdoPicture& picture);

}  // namespace ridgecraft::mesh
