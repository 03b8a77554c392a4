// SPDX-License-Identifier: GPL-3.0-or-later
// What a model file says, as it says it: its format, the space that its numbers are in, points and polygons
// that need not fit together, and a count of what reading and repair changed or noticed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/message.hpp"
#include "base/vector.hpp"

namespace ridgecraft::mesh {

// The formats of model files, in one table.

enum class FileFormat {
  obj,
  stl_ascii,
  stl_binary,
  ply_ascii,
  ply_binary,
  off,
  gltf,
  glb,
  threemf,
  pdo,
  // by another program (import/, mesh/reading/imported)
  dae,
  fbx,
  max3ds,
  blend
};

/// "OBJ", "STL", "PLY", "OFF", "glTF" and so on.
[[nodiscard]] std::string_view format_name(FileFormat format);

/// "OBJ", "STL" and so on: each name once. They are the suffixes of their files, too, in letters of either
/// case.
[[nodiscard]] std::vector<std::string> format_names();

/// The number that the format itself gives to the first point of a file: OBJ counts from 1, others from 0.
[[nodiscard]] std::uint32_t first_point_number(FileFormat format);

/// True where the format itself gives one point several times, so that joining equal points is part of
/// reading: facets of STL have corners of their own, glTF divides points where normals or pictures meet.
[[nodiscard]] bool repeats_points(FileFormat format);

// What a file says of the space that its numbers are in.

enum class Axis { x, y, z };

/// Formats without a word for one of these say nothing of it.
struct FileFrame {
  std::optional<double> mm_per_unit;  ///< millimetres in one unit of the file
  std::optional<Axis> up;             ///< the axis that points up

  friend bool operator==(const FileFrame&, const FileFrame&) = default;
};

/// "x", "y" or "z".
[[nodiscard]] const char* axis_name(Axis axis);

/// "metres", "millimetres", "inches" and so on; "units of 0.5 mm" for one without a name.
[[nodiscard]] std::string unit_names(double mm_per_unit);

// What was changed or noticed on the way from a file to a surface, counted kind by kind.

/// Closed list; name() gives the word that JSON prints.
enum class RepairKind {
  // while reading
  content_is_other_format,   ///< the suffix says one format, the content another; content wins
  trailing_data_ignored,     ///< bytes after the complete mesh
  count_corrected,           ///< a header's count didn't fit the content
  missing_end,               ///< an end mark is missing, the mesh is complete
  material_file_missing,     ///< MTL file not found or not readable
  material_unknown,          ///< faces name a material that no file defines
  material_value_corrected,  ///< colour out of range or not a number
  texture_missing,           ///< picture missing, empty or unreadable
  texture_point_dropped,     ///< texture coordinate missing, not finite or out of reach
  element_ignored,           ///< lines, curves and the like among the faces
  object_left_out,           ///< parts that the file marks as no part of the model: supports, modifiers
  feature_ignored,           ///< what the file has and isn't read, each kind once
  motion_ignored,            ///< animations, joints, shape keys: the model is taken at rest
  // while repairing
  points_joined,         ///< points at equal places that several faces had each for itself
  border_points_joined,  ///< nearly equal points along borders
  unused_points_dropped,
  polygon_corner_dropped,    ///< a corner that repeats its neighbour
  polygons_dropped,          ///< fewer than three different corners
  crossed_polygons_rebuilt,  ///< a polygon that crosses itself was triangulated some other way, or left out
  bent_polygons_split,       ///< a polygon whose corners aren't in one plane
  duplicate_faces_dropped,
  inner_walls_dropped,   ///< walls between two solids, there once from each side
  flat_faces_collapsed,  ///< faces without area (paper-craft job only)
  faces_turned,          ///< faces turned around to agree with their neighbours
  components_turned,     ///< closed components that were inside out
  edges_paired,          ///< edges with more than two faces that were divided among pairs of them
  edges_split,           ///< edges with more than two faces where some had to be cut off
  vertices_split,        ///< vertices where several fans touch
  cut_open,              ///< one-sided surfaces (Moebius) cut open
  t_junctions_joined,    ///< vertices set into the edge they lie on
  // notes: nothing was changed
  open_border,         ///< border edges
  self_intersections,  ///< faces that run through each other
  narrow_faces,        ///< faces too narrow to be cut at this size
};

[[nodiscard]] std::string_view name(RepairKind kind);

/// How often one kind of repair was made.
struct Repair {
  RepairKind kind;
  std::size_t count;
  std::string detail;  ///< what is concerned, such as "first: line 12"; may be empty
};
/// For example "24 points at equal places were joined".
[[nodiscard]] Message message(const Repair& repair);

/// At most one entry a kind, in the order of first mention.
class RepairReport {
 public:
  /// Adds to the count of a kind; the first detail stays. A count of 0 is no entry.
  void add(RepairKind kind, std::size_t count = 1, std::string detail = {});
  void add(const RepairReport& other);
  [[nodiscard]] std::size_t count(RepairKind kind) const;
  [[nodiscard]] const std::vector<Repair>& entries() const { return entries_; }

 private:
  std::vector<Repair> entries_;
};

/// Diffuse colour, each channel in [0, 1].
using Colour = std::array<double, 3>;

/// A material as the file has it. What is missing or can't be read is white and without picture.
struct Material {
  std::string name;
  std::optional<Colour> colour;
  /// Path of a picture next to the model, relative to its folder; empty for none.
  std::string texture_file;
  /// Bytes of the picture (PNG or JPEG), from next to the model or from within its file; null for none.
  std::shared_ptr<const std::string> picture = nullptr;
  /// The colour darkens the picture, as in glTF; elsewhere the picture takes the colour's place.
  bool tints_picture = false;

  [[nodiscard]] bool has_picture() const { return picture != nullptr; }
};

/// Polygons over indexed points, in the order of the file, nothing joined or dropped yet.
struct Soup {
  static constexpr std::uint32_t none = 0xffffffffU;

  std::vector<Vec3> points;          ///< finite
  std::vector<Vec2> texture_points;  ///< finite
  std::vector<Material> materials;

  /// Polygon i has the corners first_corner[i] .. first_corner[i + 1] - 1; the last entry is the number of
  /// corners. Polygons may have any number of corners (0, 1 and 2, too) and name a point more than once.
  std::vector<std::uint32_t> first_corner{0};
  std::vector<std::uint32_t> corner_point;  ///< index into points, in range
  std::vector<std::uint32_t>
      corner_texture;  ///< index into texture_points or none; empty when no corner has one
  /// Colour of each corner as 0xRRGGBB, or none; empty when no corner has one. It counts more than the
  /// material's, but not more than a picture.
  std::vector<std::uint32_t> corner_colour;
  std::vector<std::uint32_t>
      polygon_material;  ///< index into materials or none; empty when no polygon has one

  /// Names that a file has for its objects (those of groups where it names no objects): from this polygon on;
  /// printable.
  std::vector<std::pair<std::uint32_t, std::string>> objects;

  /// Edges that the lines of an OBJ file (l) or the edges of a PLY file name: indices into points, in range.
  /// Editors mark seams by them.
  std::vector<std::array<std::uint32_t, 2>> lines;

  FileFormat format = FileFormat::obj;
  FileFrame frame;
  /// Hashes of the other files that the shape comes from (buffers of glTF), one after the other.
  std::string beside_digest;
  /// The other files that it was read from, as they were opened: materials, pictures, buffers. None twice.
  std::vector<std::string> files_beside;
  /// What the reader ignored, corrected or wants to be known.
  RepairReport remarks;

  [[nodiscard]] std::size_t polygon_count() const { return first_corner.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> polygon(std::size_t i) const {
    return {corner_point.data() + first_corner[i], first_corner[i + 1] - first_corner[i]};
  }
};

}  // namespace ridgecraft::mesh
