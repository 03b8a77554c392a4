// SPDX-License-Identifier: GPL-3.0-or-later
// How far one surface is from another.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/box_tree.hpp"
#include "base/context.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::mesh {

/// Squared distance of p from the triangle a b c, which may be without area.
[[nodiscard]] double squared_distance(Vec3 a, Vec3 b, Vec3 c, Vec3 p);

/// Points of a surface, and the way from any point to it. Built once for several comparisons: O(n log n).
class SurfaceTree {
 public:
  /// Samples are the vertices and points inside faces and edges about `spacing` apart. The surface must
  /// outlive the tree.
  SurfaceTree(const Surface& surface, double spacing);

  /// Distance of a point from the surface, or anything up to `enough` where it isn't farther than that.
  [[nodiscard]] double distance(Vec3 p, double enough) const;
  [[nodiscard]] const std::vector<Vec3>& samples() const { return samples_; }

 private:
  const Surface& surface_;
  BoxTree<Box3> tree_;  ///< of its faces
  std::vector<Vec3> samples_;
};

/// Answers very often whether points are within one distance of a surface: remembers how far the middles of
/// small cells are, which decides most questions. Answers are those of the tree.
class NearField {
 public:
  /// The tree must outlive it.
  NearField(const SurfaceTree& tree, double distance);
  [[nodiscard]] bool contains(Vec3 p);

 private:
  const SurfaceTree& tree_;
  double distance_;
  double cell_;
  std::unordered_map<std::uint64_t, double> middles_;  ///< asked by key only
};

/// Greatest distance between samples of each surface and the other surface, both ways; some distance above
/// `limit` as soon as one is found.
[[nodiscard]] double greatest_distance(const SurfaceTree& a, const SurfaceTree& b, double limit,
                                       const Context& context);

}  // namespace ridgecraft::mesh
