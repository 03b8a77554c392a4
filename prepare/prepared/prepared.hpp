// SPDX-License-Identifier: GPL-3.0-or-later
// A model ready for paper, and what was done to it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "base/vector.hpp"
#include "mesh/look/look.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/twin_bodies.hpp"

namespace ridgecraft::prepare {

/// What simplification did, for the summary. Lengths in mm.
struct SimplifyReport {
  std::size_t faces_before = 0;
  std::size_t faces_after = 0;
  std::size_t features_removed = 0;  ///< automatic: small holes closed and small knobs cut off flat walls
  /// automatic: lines between narrow faces side by side that went, of arches, columns and rounded corners
  std::size_t rulings_removed = 0;
  std::size_t edges_turned = 0;  ///< automatic: behind faces too narrow to be folded
  double deviation_mm = 0.0;  ///< greatest measured distance between the old and the new surface, both ways
  /// Its sides were mirror images only nearly, off by so much, and are so exactly now; 0 where they were, or
  /// where the model isn't symmetric.
  double evened_mm = 0.0;
  double short_edges_before = 0.0;  ///< share of the fold edges below short_edge_mm, but not across a plate
  double short_edges_after = 0.0;
  double tiny_edges_after = 0.0;  ///< share of those that can't be folded by hand: below tiny_edge_mm
  /// Share of the length of all edges between panels that edges below short_edge_mm have: there a tab holds
  /// badly and a number finds no room, whatever made them short.
  double cramped_share = 0.0;
  bool at_its_size = false;     ///< some faces went at the model's size, not just before bodies were united
  bool still_too_fine = false;  ///< nobody could fold it: tiny_edges_after is above short_edge_share
};

/// Why a model isn't of the size that it has by default.
enum class SizeReason {
  none,   ///< it is
  folds,  ///< its folds would be too short, or its faces too narrow
  shape,  ///< simplification would move its surface so far that it is seen
  room,   ///< tabs and numbers would have too little room
  pages,  ///< it would take too many pages
};

/// The way of a point from the model to its place at the size that it has on paper.
struct ToSize {
  double factor = 1.0;
  Vec3 shift;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return factor * p + shift; }
};

/// A model ready for paper.
struct Prepared {
  mesh::Model model;  ///< in mm, centred on the origin; not turned, not mirrored
  Panels panels;      ///< flat regions of model.surface; those that no page holds in cells that pages hold
  TwinBodies twins;   ///< components that are equal; they are exact copies of each other
  double mm_per_unit = 1.0;
  ToSize from_model;  ///< points that nothing else moved
  /// What the model looked like before anything was done to its faces, in the place of `model`; null where it
  /// has no colours, or nobody wants them.
  std::shared_ptr<const mesh::Look> look;
  SizeReason size_reason = SizeReason::none;
  /// Where nobody could fold it at this size: the smallest largest extent, mm, at which somebody can; none if
  /// there is none that makes sense.
  std::optional<double> smallest_size_mm;
  double sliver_share = 0.0;  ///< of the faces, narrower than sliver_mm
  SimplifyReport simplified;
  /// Components that were a part of others and stand on flat faces of these, open at their feet.
  std::size_t standing = 0;
  std::size_t divided_panels = 0;  ///< flat regions that are in cells
};

}  // namespace ridgecraft::prepare
