// SPDX-License-Identifier: GPL-3.0-or-later
// How good a segmentation is: the volume of the hulls of its parts, and agreement with another one or with
// people, by the measures of the Princeton Segmentation Benchmark.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::segment {

/// Volume that the surface encloses, in its unit cubed: the sum of signed tetrahedra.
[[nodiscard]] double enclosed_volume(const mesh::Surface& surface);

/// Volume of the union of the convex hulls of the parts, divided by the volume that the surface encloses:
/// rays through the centres of a grid of `rays` by `rays` cells over the enclosing ball. `label`: part of
/// each face, any numbers. 0 when the surface encloses nothing. At 128 rays a side within 0.001; up to 1.5 %
/// off where many faces are parallel to the rays. A flat part has no volume; the hulls of parts that are open
/// shells needn't fill a thick body, so ratios below 1 are possible.
[[nodiscard]] double hull_volume_ratio(const mesh::Surface& surface, std::span<const std::uint32_t> label,
                                       unsigned rays, const Context& context);

// How far two segmentations of one model agree, by the measures of the Princeton Segmentation Benchmark.

/// Disagreement of two segmentations; 0 throughout when they have the same parts. Source of the measures:
/// Chen, Golovinskiy, Funkhouser, "A Benchmark for 3D Mesh Segmentation", ACM Transactions on Graphics 28(3),
/// 2009, section 5.
struct Disagreement {
  /// 1 - Rand index: share of the pairs of polygons on which the two disagree about "same part". Polygons
  /// count equally, whatever their area.
  double rand_error = 0.0;
  /// Hamming distance: area share left over when every part of one is given to the part of the other that
  /// covers most of it; mean of both ways round.
  double hamming = 0.0;
  /// Global and local consistency error: area share of a polygon's part that lies outside its part in the
  /// other segmentation, mean over the polygons; the same way round for all (the better one), or the better
  /// way for each. Refining a segmentation costs nothing.
  double global_consistency = 0.0;
  double local_consistency = 0.0;
  /// Cut discrepancy: mean distance along edges from a vertex on a cut of one to the nearest cut of the
  /// other, over the vertices on cuts of both, divided by the mean distance of the surface from its centroid.
  /// (The paper adds the means of the two ways round; the figures published of people against people are of
  /// this one mean.) None when just one of the two has cuts, or a cut lies on a component without any of the
  /// other's.
  std::optional<double> cut_discrepancy;
};

/// Share of the pairs of items on which the labelings disagree about "same part"; any numbers. 0
/// for fewer than two items. O(n log n).
[[nodiscard]] double rand_error(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);

/// Compares two labelings of the polygons that a surface was made of. `polygon`: of each face; `a`, `b`: part
/// of each polygon, any numbers, of one length that exceeds every entry of `polygon`. O(n log n).
[[nodiscard]] Disagreement compare(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                   std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);

}  // namespace ridgecraft::segment
