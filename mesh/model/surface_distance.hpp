// SPDX-License-Identifier: GPL-3.0-or-later
// How far one surface is from another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/boxes.hpp"
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
  /// The same, for points that follow each other: where the face that was near the last one is near enough,
  /// nothing is searched, and else nothing that is farther. `near`: none at first.
  [[nodiscard]] double distance(Vec3 p, double enough, FaceId& near) const;
  /// Distance of a point from one face.
  [[nodiscard]] double distance_of(FaceId f, Vec3 p) const;
  [[nodiscard]] const std::vector<Vec3>& samples() const { return samples_; }
  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] double spacing() const { return spacing_; }

 private:
  [[nodiscard]] double squared_distance_of(FaceId f, Vec3 p) const;
  /// `at_near`: squared distance of `near`, infinite where that is none.
  double search(Vec3 p, double enough, FaceId& near, double at_near) const;

  const Surface& surface_;
  double spacing_;
  BoxTree<Box3> tree_;  ///< of its faces
  std::vector<Vec3> samples_;
};

/// Answers very often whether points are within one distance of a surface: remembers of small cells whether
/// all their points are, or none, which decides most questions. Answers are those of the tree.
class NearField {
 public:
  /// The tree must outlive it.
  NearField(const SurfaceTree& tree, double distance);
  [[nodiscard]] bool contains(Vec3 p);

 private:
  /// What is known of a cell.
  enum class Cell : unsigned { unknown = 0, inside = 1, outside = 2, either = 3 };
  /// 4 x 4 x 4 cells are adjacent in memory, as questions do in space: two bits each.
  struct Block {
    std::uint64_t key = no_key;
    std::array<std::uint64_t, 2> cells{};
  };
  static constexpr std::uint64_t no_key = ~std::uint64_t{0};

  [[nodiscard]] Cell look(Vec3 number) const;
  /// The block of this key, which is made where there is none.
  Block& block_of(std::uint64_t key);
  [[nodiscard]] std::size_t place_of(std::uint64_t key) const;
  void grow();

  const SurfaceTree& tree_;
  double distance_;
  double cell_;
  std::vector<Block> blocks_;  ///< by their keys' hashes, or behind; a power of two, at most half full
  std::size_t used_ = 0;
};

/// Greatest distance between samples of each surface and the other surface, both ways; some distance above
/// `limit` as soon as one is found.
[[nodiscard]] double greatest_distance(const SurfaceTree& a, const SurfaceTree& b, double limit,
                                       const Context& context);

/// Greatest distance between points of each surface and the other surface, both ways: at the samples of the
/// trees first, then wherever a face that is larger than the samples' spacing leaves room for more than was
/// found. Faces are divided where they may be farthest off (branch and bound: M. Guthe, P. Borodin, R. Klein,
/// "Fast and accurate Hausdorff distance calculation between meshes", 2005) until no more than a
/// hundredth of what was found and half a hundredth of the spacing could be added, or 20,000 parts have been
/// divided each way. The same with every standard library. Throws Error(interrupted), Error(out_of_time). O(n
/// log n).
[[nodiscard]] double measured_distance(const SurfaceTree& a, const SurfaceTree& b, const Context& context);

}  // namespace ridgecraft::mesh
