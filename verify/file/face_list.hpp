// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons over a common list of vertices, and how their sides meet: as plain as a file has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace ridgecraft::verify {

using Index = std::uint32_t;
constexpr Index none = std::numeric_limits<Index>::max();

/// Faces as one list of corners. Side s runs from corner s to the next corner of the same face, so sides and
/// corners have the same numbers.
class FaceList {
 public:
  void add(std::span<const Index> vertices);

  [[nodiscard]] Index faces() const { return static_cast<Index>(first_.size() - 1); }
  [[nodiscard]] Index sides() const { return static_cast<Index>(vertex_.size()); }
  [[nodiscard]] Index first(Index face) const { return first_[face]; }
  [[nodiscard]] Index size(Index face) const { return first_[face + 1] - first_[face]; }
  [[nodiscard]] Index face(Index side) const { return face_[side]; }
  [[nodiscard]] Index next(Index side) const {
    return side + 1 < first_[face_[side] + 1] ? side + 1 : first_[face_[side]];
  }
  /// Where the side begins, and where it ends.
  [[nodiscard]] Index tail(Index side) const { return vertex_[side]; }
  [[nodiscard]] Index head(Index side) const { return vertex_[next(side)]; }
  [[nodiscard]] std::span<const Index> vertices(Index face) const {
    return std::span<const Index>(vertex_).subspan(first_[face], size(face));
  }

 private:
  std::vector<Index> first_{0};
  std::vector<Index> vertex_;
  std::vector<Index> face_;
};

/// The two ends of an edge as one number, the same for both directions.
[[nodiscard]] constexpr std::uint64_t edge_key(Index a, Index b) {
  return a < b ? (std::uint64_t{a} << 32U) | b : (std::uint64_t{b} << 32U) | a;
}

/// Sorts the corners at each vertex into fans: corners that are connected around their vertex through sides
/// with a twin get the same label. twin[s] is the side that runs along s from head to tail, or none. O(n
/// α(n)).
[[nodiscard]] std::vector<Index> corner_fans(const FaceList& faces, std::span<const Index> twin);

/// Sets that are joined two by two (Tarjan 1975): path halving, the smaller number is the name of a set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);
  [[nodiscard]] Index find(Index x);
  void join(Index a, Index b);

 private:
  std::vector<Index> parent_;
};

}  // namespace ridgecraft::verify
