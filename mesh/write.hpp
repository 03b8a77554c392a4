// SPDX-License-Identifier: GPL-3.0-or-later
// From a surface to the bytes of a mesh file, with a colour for each face.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// Red, green, blue.
using ByteColour = std::array<std::uint8_t, 3>;
/// A colour for each face of a surface, or empty for none.
using FaceColours = IdVector<FaceId, ByteColour>;

enum class PlyKind { ascii, binary };

// Points keep their numbers and every bit of their coordinates; faces keep theirs and start at the same
// corner. Linear.

/// PLY; binary is little-endian. Coordinates are of type double, colours are properties red, green, blue of
/// faces.
[[nodiscard]] std::string write_ply(const Surface& surface, const FaceColours& colours, PlyKind kind);

/// OFF; colours stand after the corners of a face as numbers 0 to 255.
[[nodiscard]] std::string write_off(const Surface& surface, const FaceColours& colours);

/// OBJ, without colours: they would take a second file.
[[nodiscard]] std::string write_obj(const Surface& surface);

}  // namespace ridgecraft::mesh
