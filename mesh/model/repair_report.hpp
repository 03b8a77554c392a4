// SPDX-License-Identifier: GPL-3.0-or-later
// What was changed or noticed on the way from a file to a surface, counted kind by kind.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft::mesh {

/// Closed list; name() gives the word that JSON prints, sentence() what a person reads.
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
  element_ignored,           ///< lines, curves and the like beside the faces
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
/// For example "24 points at equal places were joined".
[[nodiscard]] std::string sentence(RepairKind kind, std::size_t count);

/// How often one kind of repair was made.
struct Repair {
  RepairKind kind;
  std::size_t count;
  std::string detail;  ///< what is concerned, such as "first: line 12"; may be empty
};

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

}  // namespace ridgecraft::mesh
