// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgecraft::mesh {
namespace {

/// A box with more faces is divided further.
constexpr std::size_t leaf_size = 4;
/// Samples along a side, so that one huge face doesn't take all the time.
constexpr double most_steps = 64;

double square(double x) {
  return x * x;
}

double squared_distance(const Box3& box, Vec3 p) {
  const auto outside = [](double low, double x, double high) {
    return x < low ? low - x : x > high ? x - high : 0.0;
  };
  return square(outside(box.low.x, p.x, box.high.x)) + square(outside(box.low.y, p.y, box.high.y)) +
         square(outside(box.low.z, p.z, box.high.z));
}

/// Rows across the longest side, from it to the corner opposite.
void add_samples(Vec3 a, Vec3 b, Vec3 c, double spacing, std::vector<Vec3>& samples) {
  while (length(b - a) < length(c - b) || length(b - a) < length(a - c)) {
    const Vec3 first = a;
    a = b;
    b = c;
    c = first;
  }
  const double longest = length(b - a);
  const double height = longest > 0.0 ? length(cross(b - a, c - a)) / longest : 0.0;
  const double rows = std::clamp(std::ceil(height / spacing), 1.0, most_steps);
  for (double row = 0.0; row < rows; row += 1.0) {
    const Vec3 from = a + row / rows * (c - a);
    const Vec3 to = b + row / rows * (c - b);
    const double steps = std::clamp(std::ceil(length(to - from) / spacing), 1.0, most_steps);
    for (double step = 1.0; step < steps; step += 1.0) {
      samples.push_back(from + step / steps * (to - from));
    }
  }
}

}  // namespace

// Ericson: Real-time collision detection, 2005, section 5.1.5.
double squared_distance(Vec3 a, Vec3 b, Vec3 c, Vec3 p) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const auto squared = [&](Vec3 q) { return dot(p - q, p - q); };
  const double d1 = dot(ab, p - a);
  const double d2 = dot(ac, p - a);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return squared(a);
  }
  const double d3 = dot(ab, p - b);
  const double d4 = dot(ac, p - b);
  if (d3 >= 0.0 && d4 <= d3) {
    return squared(b);
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return squared(a + d1 / (d1 - d3) * ab);
  }
  const double d5 = dot(ab, p - c);
  const double d6 = dot(ac, p - c);
  if (d6 >= 0.0 && d5 <= d6) {
    return squared(c);
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return squared(a + d2 / (d2 - d6) * ac);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return squared(b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b));
  }
  const double sum = va + vb + vc;
  return sum > 0.0 ? squared(a + vb / sum * ab + vc / sum * ac) : squared(a);
}

SurfaceTree::SurfaceTree(const Surface& surface, double spacing) : surface_(surface) {
  samples_.assign(surface.points().begin(), surface.points().end());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [va, vb, vc] = surface.vertices(f);
    const Vec3 a = surface.point(va);
    const Vec3 b = surface.point(vb);
    const Vec3 c = surface.point(vc);
    centres_.push_back((a + b + c) / 3.0);
    order_.push_back(f.value());
    add_samples(a, b, c, spacing, samples_);
    samples_.push_back(centres_.back());
  }
  if (!order_.empty()) {
    nodes_.reserve(2 * order_.size() / leaf_size + 2);
    build(0, order_.size());
  }
}

std::uint32_t SurfaceTree::build(std::size_t first, std::size_t last) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  Box3 centres;
  for (std::size_t i = first; i < last; ++i) {
    for (const VertexId v : surface_.vertices(FaceId(order_[i]))) {
      node.box.add(surface_.point(v));
    }
    centres.add(centres_[order_[i]]);
  }
  nodes_.push_back(node);
  if (last - first <= leaf_size) {
    nodes_[number].first = static_cast<std::uint32_t>(first);
    nodes_[number].count = static_cast<std::uint32_t>(last - first);
    return number;
  }
  const Vec3 size = centres.size();
  const auto key = [&](std::uint32_t f) {
    const Vec3 p = centres_[f];
    return size.x >= size.y && size.x >= size.z ? p.x : size.y >= size.z ? p.y : p.z;
  };
  const std::size_t middle = (first + last) / 2;
  std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(first),
                   order_.begin() + static_cast<std::ptrdiff_t>(middle),
                   order_.begin() + static_cast<std::ptrdiff_t>(last), [&](std::uint32_t f, std::uint32_t g) {
                     return key(f) != key(g) ? key(f) < key(g) : f < g;
                   });
  build(first, middle);
  const std::uint32_t second = build(middle, last);
  nodes_[number].first = second;
  return number;
}

double SurfaceTree::distance(Vec3 p, double enough) const {
  double best = INFINITY;
  const double stop = enough * enough;
  // Depth of the tree is below 40: faces are halved.
  std::array<std::uint32_t, 64> stack{};
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0 && best > stop) {
    const std::uint32_t number = stack[--size];
    const Node& node = nodes_[number];
    if (squared_distance(node.box, p) >= best) {
      continue;
    }
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const auto [a, b, c] = surface_.vertices(FaceId(order_[i]));
        best = std::min(best, squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), p));
      }
      continue;
    }
    const std::uint32_t one = number + 1;
    const std::uint32_t two = node.first;
    const bool one_first = squared_distance(nodes_[one].box, p) <= squared_distance(nodes_[two].box, p);
    stack[size++] = one_first ? two : one;
    stack[size++] = one_first ? one : two;
  }
  return std::sqrt(best);
}

NearField::NearField(const SurfaceTree& tree, double distance)
    : tree_(tree), distance_(distance), cell_(0.25 * distance) {}

bool NearField::contains(Vec3 p) {
  // No point of a cell is farther from its middle than this.
  const double half_diagonal = 0.5 * std::numbers::sqrt3 * cell_;
  // Larger numbers don't fit into the key.
  constexpr double range = 1 << 20;
  const Vec3 number{std::floor(p.x / cell_), std::floor(p.y / cell_), std::floor(p.z / cell_)};
  if (std::abs(number.x) >= range || std::abs(number.y) >= range || std::abs(number.z) >= range) {
    return tree_.distance(p, distance_) <= distance_;
  }
  const auto part = [](double x) { return static_cast<std::uint64_t>(x + range); };
  const std::uint64_t key = (part(number.x) << 42U) | (part(number.y) << 21U) | part(number.z);
  const auto [entry, is_new] = middles_.try_emplace(key, 0.0);
  if (is_new) {
    const Vec3 middle = cell_ * (number + Vec3{0.5, 0.5, 0.5});
    entry->second = tree_.distance(middle, distance_ - half_diagonal);
  }
  if (entry->second <= distance_ - half_diagonal) {
    return true;
  }
  if (entry->second > distance_ + half_diagonal) {
    return false;
  }
  return tree_.distance(p, distance_) <= distance_;
}

double greatest_distance(const SurfaceTree& a, const SurfaceTree& b, double limit, const Context& context) {
  double greatest = 0.0;
  std::size_t done = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Vec3 p : from->samples()) {
      if (++done % 4096 == 0) {
        context.check();
      }
      greatest = std::max(greatest, to->distance(p, greatest));
      if (greatest > limit) {
        return greatest;
      }
    }
  }
  return greatest;
}

}  // namespace ridgecraft::mesh
