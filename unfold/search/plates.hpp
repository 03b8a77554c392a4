// SPDX-License-Identifier: GPL-3.0-or-later
// A patch as panels that stay whole and the edges between them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/geometry.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/search/circle_tree.hpp"

namespace ridgecraft::unfold {

/// A panel: faces that never part.
struct Plate {
  std::vector<std::uint32_t> faces;
  std::vector<Rigid> place;         ///< of each face in the frame of the first one
  std::vector<EdgedTriangle> flat;  ///< there
  std::vector<Circle> circle;
};

/// An edge between two panels.
struct Arc {
  std::uint32_t side = no_index;
  std::uint32_t a = 0, b = 0;  ///< panels
  Rigid across;                ///< b's frame seen from a's
  bool open = true;            ///< neither cut nor folded yet
  bool fold = false;
};

/// What the frozen sides of a patch hold together, in the order of their first faces. O(n).
[[nodiscard]] std::vector<Plate> plates_of(const Patch& patch);

/// The edges between different ones, by their sides. O(n).
[[nodiscard]] std::vector<Arc> arcs_between(const Patch& patch, const std::vector<Plate>& plates);

/// Folds that hold each panel together: a tree, whatever loops its frozen sides make.
[[nodiscard]] Folds folds_of_plates(const Patch& patch, const std::vector<Plate>& plates);

}  // namespace ridgecraft::unfold
