// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace ridgecraft::mesh {
namespace {

/// Samples along a side, so that one huge face doesn't take all the time.
constexpr double most_steps = 64;

Vec3 centre_of(const Surface& surface, FaceId f) {
  const auto [a, b, c] = surface.vertices(f);
  return (surface.point(a) + surface.point(b) + surface.point(c)) / 3.0;
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

/// What could still be added to the distance, as a share of it, and as one of the samples' spacing.
constexpr double close_enough = 0.01;
constexpr double close_enough_to_nothing = 0.005;
/// Parts that are divided each way.
constexpr std::size_t most_divided = 20000;
/// Between looks whether the work is to stop.
constexpr std::size_t often = 4096;

/// A part of a face, and how far from the other surface its points may be at most.
struct Part {
  std::array<Vec3, 3> corners;
  FaceId nearest;  ///< face of the other surface, to the middle
  double bound = 0.0;
  std::size_t number = 0;  ///< the first of equal bounds goes first, with every standard library
};

bool is_lower(const Part& a, const Part& b) {
  return std::pair(a.bound, b.number) < std::pair(b.bound, a.number);
}

/// One way. `greatest`: what is known already.
class Search {
 public:
  Search(const SurfaceTree& from, const SurfaceTree& to, double& greatest, const Context& context)
      : to_(to), spacing_(from.spacing()), greatest_(greatest), context_(context) {
    const Surface& surface = from.surface();
    FaceId nearest;
    for (const FaceId f : ids<FaceId>(surface.face_count())) {
      const auto [a, b, c] = surface.vertices(f);
      const std::array<Vec3, 3> corners{surface.point(a), surface.point(b), surface.point(c)};
      // Of smaller ones the samples tell enough.
      if (longest_side(corners).length > spacing_) {
        nearest = add(corners, nearest);
      }
    }
  }

  void run() {
    for (std::size_t divided = 0; !parts_.empty() && divided < most_divided; ++divided) {
      std::pop_heap(parts_.begin(), parts_.end(), is_lower);
      const Part part = parts_.back();
      parts_.pop_back();
      if (!matters(part.bound)) {
        return;
      }
      divide(part);
    }
  }

 private:
  struct Side {
    std::size_t number = 0;  ///< from this corner to the next
    double length = 0.0;
  };

  static Side longest_side(const std::array<Vec3, 3>& corners) {
    Side longest;
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = length(corners[(k + 1) % 3] - corners[k]);
      if (side > longest.length) {
        longest = {k, side};
      }
    }
    return longest;
  }

  [[nodiscard]] bool matters(double bound) const {
    return bound > (1.0 + close_enough) * greatest_ + close_enough_to_nothing * spacing_;
  }

  void divide(const Part& part) {
    const std::size_t k = longest_side(part.corners).number;
    const Vec3 a = part.corners[k];
    const Vec3 b = part.corners[(k + 1) % 3];
    const Vec3 c = part.corners[(k + 2) % 3];
    const Vec3 middle = 0.5 * (a + b);
    add({a, middle, c}, part.nearest);
    add({middle, b, c}, part.nearest);
  }

  /// Looks how far its centre is; no point is farther by more than its way to the centre, and none is farther
  /// from the face that is nearest there, which is convex, than the farthest corner is. `nearest`: a guess
  /// which one that is, or none; returns it.
  FaceId add(const std::array<Vec3, 3>& corners, FaceId nearest) {
    if (++places_ % often == 0) {
      context_.check();
    }
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    const double distance = to_.distance(centre, 0.0, nearest);
    if (!nearest.valid()) {
      return nearest;
    }
    greatest_ = std::max(greatest_, distance);
    double radius = 0.0;
    double from_face = 0.0;
    for (const Vec3 corner : corners) {
      radius = std::max(radius, length(corner - centre));
      from_face = std::max(from_face, to_.distance_of(nearest, corner));
    }
    const double bound = std::min(distance + radius, from_face);
    if (matters(bound)) {
      parts_.push_back({corners, nearest, bound, places_});
      std::push_heap(parts_.begin(), parts_.end(), is_lower);
    }
    return nearest;
  }

  const SurfaceTree& to_;
  double spacing_;
  double& greatest_;
  const Context& context_;
  std::size_t places_ = 0;   ///< that were looked at
  std::vector<Part> parts_;  ///< a heap
};

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
      spacing_(spacing),
      tree_(
          surface.face_count(), [&](std::uint32_t f) { return surface.bounds(FaceId(f)); },
          [&](std::uint32_t f) { return centre_of(surface, FaceId(f)); }) {
  samples_.assign(surface.points().begin(), surface.points().end());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    add_samples(surface.point(a), surface.point(b), surface.point(c), spacing, samples_);
    samples_.push_back(centre_of(surface, f));
  }
}

double SurfaceTree::distance(Vec3 p, double enough) const {
  FaceId near;
  return search(p, enough, near, INFINITY);
}

double SurfaceTree::distance(Vec3 p, double enough, FaceId& near) const {
  const double at_last = near.valid() ? squared_distance_of(near, p) : double{INFINITY};
  return at_last <= enough * enough ? std::sqrt(at_last) : search(p, enough, near, at_last);
}

double SurfaceTree::distance_of(FaceId f, Vec3 p) const {
  return std::sqrt(squared_distance_of(f, p));
}

double SurfaceTree::squared_distance_of(FaceId f, Vec3 p) const {
  const auto [a, b, c] = surface_.vertices(f);
  return squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), p);
}

double SurfaceTree::search(Vec3 p, double enough, FaceId& near, double at_near) const {
  const double stop = enough * enough;
  const double best = tree_.nearest_first(
      p, at_near,
      [stop](double found, std::uint32_t, double distance) { return found > stop && distance < found; },
      [&](double& found, std::uint32_t i) {
        const FaceId f(tree_.order()[i]);
        if (const double distance = squared_distance_of(f, p); distance < found) {
          found = distance;
          near = f;
        }
      });
  return std::sqrt(best);
}

NearField::NearField(const SurfaceTree& tree, double distance)
    : tree_(tree), distance_(distance), cell_(0.25 * distance), blocks_(1024) {}

bool NearField::contains(Vec3 p) {
  // Larger numbers don't fit into the key.
  constexpr double range = 1 << 20;
  const Vec3 number{std::floor(p.x / cell_), std::floor(p.y / cell_), std::floor(p.z / cell_)};
  if (std::abs(number.x) >= range || std::abs(number.y) >= range || std::abs(number.z) >= range) {
    return tree_.distance(p, distance_) <= distance_;
  }
  const auto part = [](double x) { return static_cast<std::uint64_t>(x + range); };
  const std::array<std::uint64_t, 3> cell{part(number.x), part(number.y), part(number.z)};
  // A block has four cells each way: two bits of each number say which one, the others which block.
  Block& block = block_of(((cell[0] >> 2U) << 42U) | ((cell[1] >> 2U) << 21U) | (cell[2] >> 2U));
  const std::uint64_t place = ((cell[0] & 3U) << 4U) | ((cell[1] & 3U) << 2U) | (cell[2] & 3U);
  std::uint64_t& word = block.cells[place >> 5U];
  const std::uint64_t shift = 2U * (place & 31U);
  auto state = static_cast<Cell>((word >> shift) & 3U);
  if (state == Cell::unknown) {
    state = look(number);
    word |= static_cast<std::uint64_t>(state) << shift;
  }
  return state == Cell::inside || (state == Cell::either && tree_.distance(p, distance_) <= distance_);
}

NearField::Cell NearField::look(Vec3 number) const {
  // No point of a cell is farther from its middle than this.
  const double half_diagonal = 0.5 * std::numbers::sqrt3 * cell_;
  const Vec3 middle = cell_ * (number + Vec3{0.5, 0.5, 0.5});
  const double found = tree_.distance(middle, distance_ - half_diagonal);
  return found <= distance_ - half_diagonal  ? Cell::inside
         : found > distance_ + half_diagonal ? Cell::outside
                                             : Cell::either;
}

std::size_t NearField::place_of(std::uint64_t key) const {
  // Fibonacci hashing (Knuth, volume 3, section 6.4): the upper bits depend on all of the key.
  constexpr std::uint64_t golden = 0x9E3779B97F4A7C15U;
  const std::size_t mask = blocks_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * golden) >> 32U) & mask;
  while (blocks_[at].key != key && blocks_[at].key != no_key) {
    at = (at + 1) & mask;
  }
  return at;
}

NearField::Block& NearField::block_of(std::uint64_t key) {
  std::size_t at = place_of(key);
  if (blocks_[at].key == no_key) {
    if (2 * (used_ + 1) > blocks_.size()) {
      grow();
      at = place_of(key);
    }
    blocks_[at].key = key;
    ++used_;
  }
  return blocks_[at];
}

void NearField::grow() {
  std::vector<Block> before(2 * blocks_.size());
  before.swap(blocks_);
  for (const Block& block : before) {
    if (block.key != no_key) {
      blocks_[place_of(block.key)] = block;
    }
  }
}

double greatest_distance(const SurfaceTree& a, const SurfaceTree& b, double limit, const Context& context) {
  double greatest = 0.0;
  std::size_t done = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    FaceId near;
    for (const Vec3 p : from->samples()) {
      if (++done % 4096 == 0) {
        context.check();
      }
      greatest = std::max(greatest, to->distance(p, greatest, near));
      if (greatest > limit) {
        return greatest;
      }
    }
  }
  return greatest;
}

double measured_distance(const SurfaceTree& a, const SurfaceTree& b, const Context& context) {
  double greatest = greatest_distance(a, b, INFINITY, context);
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    Search(*from, *to, greatest, context).run();
  }
  return greatest;
}

}  // namespace ridgecraft::mesh
