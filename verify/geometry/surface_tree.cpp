// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/geometry/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ridgecraft::verify {
namespace {

constexpr std::uint32_t triangles_in_leaf = 4;

double square(Vec3 a) {
  return dot(a, a);
}

Vec3 nearest_on_segment(Vec3 a, Vec3 b, Vec3 p) {
  const double size = square(b - a);
  const double share = size > 0.0 ? std::clamp(dot(p - a, b - a) / size, 0.0, 1.0) : 0.0;
  return a + share * (b - a);
}

Vec3 centre_of(const Triangle3& t) {
  return (t[0] + t[1] + t[2]) / 3.0;
}

double square_of_distance(const Box3& box, Vec3 p) {
  const Vec3 outside{std::max({box.low.x - p.x, 0.0, p.x - box.high.x}),
                     std::max({box.low.y - p.y, 0.0, p.y - box.high.y}),
                     std::max({box.low.z - p.z, 0.0, p.z - box.high.z})};
  return square(outside);
}

}  // namespace

Vec3 nearest_on(const Triangle3& t, Vec3 p) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  bool inside = square(normal) > 0.0;
  for (std::size_t k = 0; k < 3 && inside; ++k) {
    inside = dot(cross(normal, t[(k + 1) % 3] - t[k]), p - t[k]) >= 0.0;
  }
  if (inside) {
    return p - (dot(p - t[0], normal) / square(normal)) * normal;
  }
  Vec3 best = nearest_on_segment(t[0], t[1], p);
  for (std::size_t k = 1; k < 3; ++k) {
    const Vec3 other = nearest_on_segment(t[k], t[(k + 1) % 3], p);
    best = square(p - other) < square(p - best) ? other : best;
  }
  return best;
}

SurfaceTree::SurfaceTree(std::vector<Triangle3> triangles) : triangles_(std::move(triangles)) {
  build(0, static_cast<std::uint32_t>(triangles_.size()));
}

std::uint32_t SurfaceTree::build(std::uint32_t begin, std::uint32_t end) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.begin = begin;
  node.end = end;
  Box3 centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    std::for_each(triangles_[i].begin(), triangles_[i].end(), [&](Vec3 p) { node.box.add(p); });
    centres.add(centre_of(triangles_[i]));
  }
  nodes_.push_back(node);
  if (end - begin <= triangles_in_leaf) {
    return number;
  }
  const Vec3 size = centres.size();
  const auto along = [&](const Triangle3& t) {
    const Vec3 c = centre_of(t);
    return size.x >= size.y && size.x >= size.z ? c.x : size.y >= size.z ? c.y : c.z;
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
                   [&](const Triangle3& a, const Triangle3& b) { return along(a) < along(b); });
  build(begin, middle);
  const std::uint32_t right = build(middle, end);
  nodes_[number].right = right;
  return number;
}

/// The best so far.
struct SurfaceTree::Search {
  Vec3 p;
  double enough_square;
  Place best;
  double square;
};

SurfaceTree::Place SurfaceTree::nearest(Vec3 p, double enough, const Place& guess) const {
  Search search{p, enough * enough, {nearest_on(triangles_[guess.triangle], p), guess.triangle}, 0.0};
  search.square = square(p - search.best.point);
  descend(0, search);
  return search.best;
}

void SurfaceTree::descend(std::uint32_t at, Search& search) const {
  const Node& node = nodes_[at];
  if (search.square <= search.enough_square || square_of_distance(node.box, search.p) >= search.square) {
    return;
  }
  if (node.right == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Vec3 candidate = nearest_on(triangles_[i], search.p);
      if (const double distance = square(search.p - candidate); distance < search.square) {
        search.best = {candidate, i};
        search.square = distance;
      }
    }
    return;
  }
  const bool left_first = square_of_distance(nodes_[at + 1].box, search.p) <=
                          square_of_distance(nodes_[node.right].box, search.p);
  descend(left_first ? at + 1 : node.right, search);
  descend(left_first ? node.right : at + 1, search);
}

}  // namespace ridgecraft::verify
