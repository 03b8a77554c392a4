// SPDX-License-Identifier: GPL-3.0-or-later
// What a model is: reading and repair. Read this header first.
//
//   file --read--> Model (repaired, in the file's unit)
//   points + polygons --repair--> Model (repaired, in the points' unit)
//
// Errors are ridgecraft::Error of kinds unreadable_input, unusable_mesh, interrupted.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// A model file in memory, wherever its bytes came from.
struct ModelFile {
  std::string bytes;
  std::string name;   ///< what messages call it; its suffix helps where the content could be several formats
  std::string title;  ///< what results are named after: Model::name
  /// Where its material files and pictures are looked for; empty for nowhere: then materials are names only.
  std::filesystem::path folder;
};

/// Reads each format of format_names() (content decides, the suffix only helps) and repairs it: points
/// joined, polygons triangulated, duplicates dropped, faces oriented, edges and vertices made manifold. Every
/// change is counted in Model::repairs. Cost O(n log n). Throws unreadable_input or unusable_mesh with a
/// sentence that names the file.
[[nodiscard]] Model read(const std::filesystem::path& file, const ReadOptions& options,
                         const Context& context);
/// The same for bytes in memory.
[[nodiscard]] Model read(const ModelFile& file, const ReadOptions& options, const Context& context);

/// The same for points and polygons in memory, whoever made them: they needn't fit together. A polygon names
/// points by their indices from 0, counterclockwise seen from outside, and may have any number of corners;
/// Model::polygon names the one that each face is part of. Model::name is empty, Model::digest that of the
/// numbers. Cost O(n log n). Throws unusable_mesh where a coordinate isn't finite, an index is out of range,
/// or nothing with an area is left.
[[nodiscard]] Model repair(std::span<const Vec3> points, std::span<const std::vector<std::uint32_t>> polygons,
                           const ReadOptions& options, const Context& context);
[[nodiscard]] Model repair(std::span<const Vec3> points,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const ReadOptions& options, const Context& context);

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
