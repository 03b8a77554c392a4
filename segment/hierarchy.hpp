// SPDX-License-Identifier: GPL-3.0-or-later
// All tolerances at once: which parts join at which concavity (docs/design/segmentation.md, "Any number of
// parts, all tolerances at once").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::segment {

/// Two nodes become one.
struct Joining {
  std::uint32_t first = 0;  ///< smaller node number
  std::uint32_t second = 0;
  /// The least tolerance at which they are one part: the largest concavity measured from scratch of the union
  /// and of everything in it, in the scale of Options::concavity.
  double concavity = 0.0;
};

/// A binary forest, one tree per component. Nodes 0, 1, ... are the finest parts in order of their smallest
/// face; joining i makes node `leaves + i`.
struct Hierarchy {
  std::size_t leaves = 0;
  std::vector<Joining> joinings;  ///< concavity ascending
  std::vector<Part> nodes;        ///< leaves, then what each joining made
  std::size_t faces = 0;          ///< of the surface

  /// Parts that are left when all that can be joined is joined: the surface's components.
  [[nodiscard]] std::size_t fewest() const { return leaves - joinings.size(); }
  /// The parts after the joinings that leave this many. From fewest() to `leaves`.
  [[nodiscard]] Segmentation parts(std::size_t count) const;
};

/// Cuts a surface within a tolerance of 0.03, less where that gives fewer than `at_least` parts (down to
/// 0.005), and joins the two neighbours whose union is least concave again and again; equal ones along the
/// more convex border. Holes are borders. About 3 to 10 times as long as segment(). Throws as segment().
[[nodiscard]] Hierarchy find_hierarchy(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                       std::size_t at_least, const Context& context);

}  // namespace ridgecraft::segment
