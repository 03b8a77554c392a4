// SPDX-License-Identifier: GPL-3.0-or-later
// What a model is: reading, repair, size, panels, simplification. Read this header first.
//
//   file --read--> Model (repaired, in the file's unit) --prepare--> Prepared (in mm, foldable, with its
//   panels)
//
// Errors are ridgecraft::Error of kinds unreadable_input, unusable_mesh, interrupted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesh/foundation/context.hpp"
#include "mesh/model.hpp"
#include "mesh/panels.hpp"

namespace ridgecraft::mesh {

/// What repair does where the jobs differ.
struct ReadOptions {
  /// Collapse faces without area. Paper can't hold them; segmentation keeps them, since dropping them opens
  /// closed surfaces.
  bool collapse_flat_faces = true;
  bool keep_points = false;  ///< fill Model::file_points
};

/// Reads OBJ, STL, PLY or OFF (content decides, the suffix only helps) and repairs it: points joined,
/// polygons triangulated, duplicates dropped, faces oriented, edges and vertices made manifold. Every change
/// is counted in Model::repairs. Cost O(n log n). Throws unreadable_input or unusable_mesh with a sentence
/// that names the file.
[[nodiscard]] Model read(const std::filesystem::path& file, const ReadOptions& options,
                         const Context& context);

/// How large the model becomes.
struct SizeOptions {
  /// Largest extent in mm. Used when neither scale nor an axis is given.
  double largest_extent_mm = 150.0;
  /// Millimetres for one unit of the file; wins over largest_extent_mm.
  std::optional<double> mm_per_unit;
};

/// How many faces it keeps.
enum class Simplification { automatic, keep, count };

struct SimplifyOptions {
  Simplification mode = Simplification::automatic;
  std::size_t faces = 0;  ///< for Simplification::count
  /// automatic: a fold edge shorter than this is hard to fold ...
  double short_edge_mm = 6.0;
  /// ... and the model is simplified when more than this share of its fold edges are.
  double short_edge_share = 0.1;
  /// automatic: the surface may move by this share of the model's largest extent.
  double largest_deviation = 0.02;
};

/// What simplification did, for the summary. Lengths in mm.
struct SimplifyReport {
  std::size_t faces_before = 0;
  std::size_t faces_after = 0;
  std::size_t specks_dropped = 0;  ///< automatic: components too small to be held, left out
  double deviation_mm = 0.0;  ///< greatest measured distance between the old and the new surface, both ways
  double short_edges_before = 0.0;  ///< share of the fold edges below short_edge_mm
  double short_edges_after = 0.0;
  bool still_too_fine = false;  ///< automatic couldn't reach its aim within the deviation allowed
};

/// What a flat region should fit: the printable area, mm, and the height of tabs on either side of it.
struct Page {
  double width_mm = 0.0;
  double height_mm = 0.0;
  double tab_mm = 0.0;
};

/// A model ready for paper.
struct Prepared {
  Model model;    ///< in mm, centred on the origin; not turned, not mirrored
  Panels panels;  ///< flat regions of model.surface; those that no page holds in cells that pages hold
  double mm_per_unit = 1.0;
  SimplifyReport simplified;
  std::size_t divided_panels = 0;  ///< flat regions that are in cells
};

/// Scales, simplifies and remeshes flat regions: a panel has no vertices inside and none on its straight
/// sides that only two panels share, but for where a panel that fits no page in any rotation is cut: by
/// straight lines, as few as possible, into cells that fit with tabs, each a panel of its own. Cost O(n log
/// n). Throws no_nets where every face is narrower than 0.005 mm (below 0.05 mm they are noted as
/// narrow_faces), or where the model would be larger than 100 m or than a million faces of this paper.
[[nodiscard]] Prepared prepare(Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                               const Page& page, const Context& context);

}  // namespace ridgecraft::mesh
