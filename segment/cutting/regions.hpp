// SPDX-License-Identifier: GPL-3.0-or-later
// Convex ridges of a part, and which facets surely belong to one or are open to the cut
// (docs/design/segmentation.md, "Ridges" and "Regions").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/measure.hpp"

namespace ridgecraft::segment {

// Convex ridges: sets of hull vertices whose bridges among themselves are low (docs/design/segmentation.md,
// "Ridges").

/// A ridge with a high bridge.
struct Ridge {
  std::vector<std::uint32_t> vertices;  ///< hull vertices, ascending
  /// Ends of high bridges among them, ascending, with the longest sub-valley from there to a separator.
  struct End {
    std::uint32_t vertex;
    double reach;
  };
  std::vector<End> ends;
  double diagonal = 0.0;  ///< of the axis-parallel box of its vertices
};

/// The active ridges of a measured part, ordered by their smallest hull vertex. At least two when a bridge is
/// high.
[[nodiscard]] std::vector<Ridge> find_ridges(const Measurement& measurement, std::span<const Vec3> points);

/// Owner of a facet that lies in no potential region or in several.
inline constexpr std::uint32_t fuzzy = 0xffffffffU;

/// Must-link regions of one part at a time.
class Regions {
 public:
  explicit Regions(const ScaledSurface& surface);

  /// Finds the owners of the facets of the part that the measurer shows. Facets of one polygon have one
  /// owner. Cost: one flood per ridge over its potential region.
  void assign(Measurer& measurer, std::span<const Ridge> ridges);

  /// Index of the ridge whose must-link the facet is in, or fuzzy. Only for facets of that part.
  [[nodiscard]] std::uint32_t owner(std::uint32_t facet) const { return owner_[facet]; }
  /// Facets in the ridge's must-link, in no order.
  [[nodiscard]] std::span<const std::uint32_t> must_link(std::size_t ridge) const {
    return must_link_[ridge];
  }

 private:
  void find_potential_region(Measurer& measurer, const Ridge& ridge);
  void keep_whole_polygons();
  void fill_empty(const PartGraph& part, std::span<const Ridge> ridges);

  const ScaledSurface* surface_;
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint32_t> mark_;  ///< per facet: the flood that counted its corners last
  std::vector<std::uint8_t> corners_;
  std::vector<std::uint32_t> group_mark_;
  std::vector<std::uint32_t> group_count_;
  std::uint32_t flood_ = 0;
  std::vector<std::vector<std::uint32_t>> must_link_;
  std::vector<std::uint32_t> region_;
  std::vector<std::uint32_t> reached_;
  std::vector<Start> starts_;
};

}  // namespace ridgecraft::segment
