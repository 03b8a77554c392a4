// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/face_list.hpp"

#include <numeric>
#include <utility>

namespace ridgecraft::verify {

void FaceList::add(std::span<const Index> vertices) {
  const Index number = faces();
  vertex_.insert(vertex_.end(), vertices.begin(), vertices.end());
  face_.insert(face_.end(), vertices.size(), number);
  first_.push_back(static_cast<Index>(vertex_.size()));
}

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), Index{0});
}

Index DisjointSets::find(Index x) {
  while (parent_[x] != x) {
    parent_[x] = parent_[parent_[x]];
    x = parent_[x];
  }
  return x;
}

void DisjointSets::join(Index a, Index b) {
  a = find(a);
  b = find(b);
  if (a > b) {
    std::swap(a, b);
  }
  parent_[b] = a;
}

std::vector<Index> corner_fans(const FaceList& faces, std::span<const Index> twin) {
  DisjointSets fans(faces.sides());
  for (Index side = 0; side < faces.sides(); ++side) {
    if (twin[side] != none) {
      // The twin ends where this side begins.
      fans.join(side, faces.next(twin[side]));
    }
  }
  std::vector<Index> label(faces.sides());
  for (Index side = 0; side < faces.sides(); ++side) {
    label[side] = fans.find(side);
  }
  return label;
}

}  // namespace ridgecraft::verify
