// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgecraft::mesh {
namespace {

/// Samples along a side, so that one huge face doesn't take all the time.
constexpr double most_steps = 64;

Vec3 centre_of(const Surface& surface, FaceId f) {
  const auto [a, b, c] = surface.vertices(f);
  return (surface.point(a) + surface.point(b) + surface.point(c)) / 3.0;
}

Box3 box_of(const Surface& surface, FaceId f) {
  Box3 box;
  for (const VertexId v : surface.vertices(f)) {
    box.add(surface.point(v));
  }
  return box;
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

SurfaceTree::SurfaceTree(const Surface& surface, double spacing)
    : surface_(surface),
      tree_(
          surface.face_count(), [&](std::uint32_t f) { return box_of(surface, FaceId(f)); },
          [&](std::uint32_t f) { return centre_of(surface, FaceId(f)); }) {
  samples_.assign(surface.points().begin(), surface.points().end());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    add_samples(surface.point(a), surface.point(b), surface.point(c), spacing, samples_);
    samples_.push_back(centre_of(surface, f));
  }
}

double SurfaceTree::distance(Vec3 p, double enough) const {
  const double stop = enough * enough;
  const double best = tree_.nearest_first(
      p, double{INFINITY},
      [stop](double found, std::uint32_t, double distance) { return found > stop && distance < found; },
      [&](double& found, std::uint32_t i) {
        const auto [a, b, c] = surface_.vertices(FaceId(tree_.order()[i]));
        found = std::min(found, squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), p));
      });
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
