// SPDX-License-Identifier: GPL-3.0-or-later
// Which facets surely belong to a ridge and which are open to the cut (docs/design/segmentation.md,
// "Regions").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/concavity/measure.hpp"
#include "segment/cutting/ridges.hpp"

namespace ridgecraft::segment {

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
