// SPDX-License-Identifier: GPL-3.0-or-later
// What slicers (PrusaSlicer, SuperSlicer, Bambu Studio, OrcaSlicer) say of a 3MF file's parts in files of
// their own beside the model: what a part is for, its filament, its plate.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/reading/threemf/model_part.hpp"

namespace ridgecraft::mesh {

/// What a part of an object is for. Only the first is part of the model.
enum class SlicerRole { model, negative, modifier, support };

/// In the plural where there is more than one: "2 modifiers".
[[nodiscard]] std::string counted_role(SlicerRole role, std::size_t count);

struct SlicerPart {
  std::string name;  ///< printable
  SlicerRole role = SlicerRole::model;
  std::uint32_t filament = 0;  ///< from 1; 0 for that of the object
};

/// Triangles of an object's mesh, both ends among them.
struct SlicerVolume {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  SlicerPart part;
};

struct SlicerObject {
  std::string name;  ///< printable
  std::uint32_t filament = 1;
  std::vector<SlicerVolume> volumes;          ///< of the object's own mesh, ascending
  std::map<std::uint32_t, SlicerPart> parts;  ///< by the number of the object that is a component
};

struct SlicerProject {
  std::vector<ColourBytes> filaments;             ///< from the first on; empty where none is known
  std::map<std::uint32_t, SlicerObject> objects;  ///< by their numbers in the build
  /// By the object's number and which of its items it is: the number of a plate. Empty for one plate alone.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> plates;
};

/// Nothing where the package has no such files, or they can't be read: then the model alone counts.
[[nodiscard]] SlicerProject read_slicer_project(ThreemfPackage& package);

// Colours that are painted onto triangles with a brush.

/// A piece of a painted triangle and its filament from 1; 0 for that of the part.
struct PaintedPiece {
  std::array<std::uint32_t, 3> corners;  ///< points of the soup
  std::uint32_t filament = 0;
};

/// Divides triangles as a slicer's brush did (PrusaSlicer's TriangleSelector): each may be split at the
/// middle of one, two or three sides, again and again. Triangles that share a side share its middle.
class PaintDivider {
 public:
  explicit PaintDivider(std::vector<Vec3>& points) : points_(points) {}

  /// Pieces of a triangle whose paint is `code`, hexadecimal digits with the first step last. A code that
  /// can't be read, or that asks for more than most_pieces in all, leaves the triangle whole. O(digits log
  /// n).
  [[nodiscard]] std::vector<PaintedPiece> divide(std::array<std::uint32_t, 3> corners, std::string_view code);
  /// The corners of a triangle and all middles on its sides, once every triangle is divided.
  [[nodiscard]] std::vector<std::uint32_t> outline(const std::array<std::uint32_t, 3>& corners) const;

  /// Few packed bytes can ask for many.
  static constexpr std::size_t most_pieces = 2'000'000;

 private:
  [[nodiscard]] std::uint32_t middle(std::uint32_t a, std::uint32_t b);
  bool divide(std::array<std::uint32_t, 3> corners, int depth, std::vector<PaintedPiece>& pieces);
  void add_side(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& line) const;

  std::vector<Vec3>& points_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
  std::string_view code_;   ///< what is left of it
  std::size_t pieces_ = 0;  ///< made so far
};

}  // namespace ridgecraft::mesh
