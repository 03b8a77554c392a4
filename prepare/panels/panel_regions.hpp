// SPDX-License-Identifier: GPL-3.0-or-later
// The flat regions that are remeshed as one: panels, divided where the material changes. Private to prepare/.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {

/// Faces, edges and vertices are those of the surface, by plain numbers. Refers to the surface.
class PanelRegions {
 public:
  /// `loose` are the surface's faces taken apart, for their materials. O(n).
  PanelRegions(const mesh::Surface& surface, const Panels& panels, const mesh::LooseFaces& loose);

  [[nodiscard]] std::size_t count() const { return faces_.size(); }
  [[nodiscard]] std::uint32_t region(std::uint32_t face) const { return region_[face]; }
  [[nodiscard]] const std::vector<std::uint32_t>& faces(std::uint32_t region) const { return faces_[region]; }
  /// The edges between two regions, or of one and the surface's border, that end at a vertex.
  [[nodiscard]] const std::vector<std::uint32_t>& border_edges(std::uint32_t vertex) const {
    return border_edges_[vertex];
  }
  [[nodiscard]] bool on_border(EdgeId edge) const;

 private:
  void find_regions(const Panels& panels, const mesh::LooseFaces& loose);
  void find_borders();

  const mesh::Surface& surface_;
  std::vector<std::uint32_t> region_;                     ///< of each face
  std::vector<std::vector<std::uint32_t>> faces_;         ///< of each region
  std::vector<std::vector<std::uint32_t>> border_edges_;  ///< of each vertex
};

}  // namespace ridgecraft::prepare
