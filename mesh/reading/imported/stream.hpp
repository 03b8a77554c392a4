// SPDX-License-Identifier: GPL-3.0-or-later
// How ridgecraft-import (import/) says what a file holds: numbers as the machine has them, one after the
// other. Written and read by processes of one machine, never kept.
//
//   stream     start, kind 0, frame, moves, materials, points, texture points, objects, polygons, end
//              or start, kind 1, text (why the file can't be read), end
//   frame      number (millimetres in a unit; 0: unknown), u32 (axis that points up: 0, 1, 2; 3: unknown)
//   moves      u32 (what is animated or bends at joints)
//   materials  u32 count, each: text (name), u32 (has a colour?), 3 numbers, u32 (0 no picture, 1 its bytes,
//   2 the
//              name of its file), text
//   points     u32 count, 3 numbers each
//   texture points   u32 count, 2 numbers each
//   objects    u32 count, each: u32 (from this polygon on), text (name)
//   polygons   u32 count, u32 each (corners); u32 (all corners), u32 each (point); u32 each (texture point or
//   none);
//              u32 each (colour of the corner, 0xRRGGBB, or none); u32 for each polygon (material or none)
//   text       u32 (bytes), the bytes
#pragma once

#include <cstdint>
#include <string_view>

namespace ridgecraft::mesh::imported {

inline constexpr std::string_view start = "ridgecraft soup 2\n";
inline constexpr std::string_view end = "end of soup\n";

inline constexpr std::uint32_t kind_soup = 0;
inline constexpr std::uint32_t kind_refusal = 1;

inline constexpr std::uint32_t picture_none = 0;
inline constexpr std::uint32_t picture_bytes = 1;
inline constexpr std::uint32_t picture_file = 2;

inline constexpr std::uint32_t axis_untold = 3;
inline constexpr std::uint32_t no_index = 0xffffffffU;

}  // namespace ridgecraft::mesh::imported
