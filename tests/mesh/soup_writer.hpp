// SPDX-License-Identifier: GPL-3.0-or-later
// Writes soups in all formats that are read, independently of mesh/write.hpp: polygons of any size, in the
// forms that other programs use.
#pragma once

#include <string>

#include "mesh/model/soup.hpp"

namespace ridgecraft::test {

enum class SoupFormat { obj, off, ply_ascii, ply_little_endian, ply_big_endian, stl_ascii, stl_binary };

/// Points and polygons only. STL takes triangles and rounds to float in its binary form.
[[nodiscard]] std::string written(const mesh::Soup& soup, SoupFormat format);

}  // namespace ridgecraft::test
