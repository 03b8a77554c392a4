// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a tree in circles that move with their branch: which faces overlap, eight at a time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/geometry.hpp"
#include "base/vector.hpp"
#include "unfold/patch/patch.hpp"

namespace ridgecraft::unfold {

// Lanes for compilers without vector types: plain arrays, number by number.

/// `count` numbers; operators work on each for itself, a single number stands for `count` equal ones.
template <typename Number, std::size_t count>
struct PortableLanes {
  Number number[count];  // NOLINT(modernize-avoid-c-arrays): braces as for a vector type

  constexpr Number& operator[](std::size_t lane) { return number[lane]; }
  constexpr Number operator[](std::size_t lane) const { return number[lane]; }

  friend constexpr PortableLanes operator+(const PortableLanes& a, const PortableLanes& b) {
    return each(a, b, [](Number x, Number y) { return x + y; });
  }
  friend constexpr PortableLanes operator-(const PortableLanes& a, const PortableLanes& b) {
    return each(a, b, [](Number x, Number y) { return x - y; });
  }
  friend constexpr PortableLanes operator*(const PortableLanes& a, const PortableLanes& b) {
    return each(a, b, [](Number x, Number y) { return x * y; });
  }
  friend constexpr PortableLanes operator+(const PortableLanes& a, Number b) { return a + all(b); }
  friend constexpr PortableLanes operator-(const PortableLanes& a, Number b) { return a - all(b); }
  friend constexpr PortableLanes operator*(const PortableLanes& a, Number b) { return a * all(b); }
  friend constexpr PortableLanes operator*(Number a, const PortableLanes& b) { return all(a) * b; }

  /// -1 in the lanes where a is less than b, 0 in the others.
  friend constexpr PortableLanes<std::int32_t, count> operator<(const PortableLanes& a,
                                                                const PortableLanes& b) {
    PortableLanes<std::int32_t, count> holds{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      holds[lane] = a[lane] < b[lane] ? -1 : 0;
    }
    return holds;
  }

 private:
  static constexpr PortableLanes all(Number value) {
    PortableLanes lanes{};
    for (Number& number : lanes.number) {
      number = value;
    }
    return lanes;
  }
  template <typename Operation>
  static constexpr PortableLanes each(const PortableLanes& a, const PortableLanes& b, Operation operation) {
    PortableLanes lanes{};
    for (std::size_t lane = 0; lane < count; ++lane) {
      lanes[lane] = operation(a[lane], b[lane]);
    }
    return lanes;
  }
};

using PortableFloatLanes = PortableLanes<float, 4>;
using PortableIntLanes = PortableLanes<std::int32_t, 4>;
using PortableDoubleLanes = PortableLanes<double, 2>;

/// Bit k: lane k of a comparison's result holds.
[[nodiscard]] constexpr std::uint32_t bits_of(const PortableIntLanes& holds) {
  std::uint32_t bits = 0;
  for (unsigned lane = 0; lane < 4; ++lane) {
    bits |= holds[lane] != 0 ? 1U << lane : 0U;
  }
  return bits;
}

template <typename Number, std::size_t count>
[[nodiscard]] constexpr PortableLanes<Number, count> smaller(PortableLanes<Number, count> a,
                                                             const PortableLanes<Number, count>& b) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    a[lane] = a[lane] < b[lane] ? a[lane] : b[lane];
  }
  return a;
}
template <typename Number, std::size_t count>
[[nodiscard]] constexpr PortableLanes<Number, count> larger(PortableLanes<Number, count> a,
                                                            const PortableLanes<Number, count>& b) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    a[lane] = a[lane] > b[lane] ? a[lane] : b[lane];
  }
  return a;
}

}  // namespace ridgecraft::unfold

// Four numbers worked at a time: in the vector form that GCC and Clang share, or the portable way where a
// compiler has none or the build asks for it. Both give the same bits as one number after the other.

#if defined(__GNUC__) && !defined(RIDGECRAFT_PORTABLE)

namespace ridgecraft::unfold {

using FloatLanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));
using DoubleLanes = double __attribute__((vector_size(16)));  ///< two

/// Bit k: lane k of a comparison's result holds.
[[nodiscard]] inline std::uint32_t bits_of(IntLanes holds) {
  const IntLanes bits = holds & IntLanes{1, 2, 4, 8};
  return static_cast<std::uint32_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
}

[[nodiscard]] inline FloatLanes smaller(FloatLanes a, FloatLanes b) {
  return a < b ? a : b;
}
[[nodiscard]] inline FloatLanes larger(FloatLanes a, FloatLanes b) {
  return a > b ? a : b;
}
[[nodiscard]] inline DoubleLanes smaller(DoubleLanes a, DoubleLanes b) {
  return a < b ? a : b;
}
[[nodiscard]] inline DoubleLanes larger(DoubleLanes a, DoubleLanes b) {
  return a > b ? a : b;
}

}  // namespace ridgecraft::unfold

#else

namespace ridgecraft::unfold {

using FloatLanes = PortableFloatLanes;
using IntLanes = PortableIntLanes;
using DoubleLanes = PortableDoubleLanes;  ///< two

}  // namespace ridgecraft::unfold

#endif

namespace ridgecraft::unfold {

// A triangle with its edges as half-planes worked out once: the overlap test of the inner loops.

/// Edge k's outward unit normal is (x[k], y[k]); no corner of the triangle is farther along it than reach[k].
/// Lane 3 repeats lane 0, so that four lanes can be worked at a time without a remainder. An edge without
/// length has reach infinity: it never separates.
struct EdgedTriangle {
  Triangle corner{};
  std::array<DoubleLanes, 2> x{}, y{}, reach{};
};

[[nodiscard]] inline EdgedTriangle edged(const Triangle& t) {
  EdgedTriangle e;
  e.corner = t;
  for (unsigned lane = 0; lane < 4; ++lane) {
    const unsigned k = lane % 3;
    const Vec2 along = t[(k + 1) % 3] - t[k];
    const double size = length(along);
    const Vec2 out = size > 0.0 ? Vec2{along.y / size, -along.x / size} : Vec2{};
    e.x[lane / 2][lane % 2] = out.x;
    e.y[lane / 2][lane % 2] = out.y;
    e.reach[lane / 2][lane % 2] = size > 0.0
                                      ? std::max(dot(out, t[0]), std::max(dot(out, t[1]), dot(out, t[2])))
                                      : std::numeric_limits<double>::infinity();
  }
  return e;
}

[[nodiscard]] inline EdgedTriangle moved(const EdgedTriangle& e, const Rigid& motion) {
  EdgedTriangle m;
  m.corner = {motion(e.corner[0]), motion(e.corner[1]), motion(e.corner[2])};
  for (unsigned half = 0; half < 2; ++half) {
    m.x[half] = motion.cosine * e.x[half] - motion.sine * e.y[half];
    m.y[half] = motion.sine * e.x[half] + motion.cosine * e.y[half];
    m.reach[half] = e.reach[half] + m.x[half] * motion.shift.x + m.y[half] * motion.shift.y;
  }
  return m;
}

/// Whether an edge of a separates b from a but for a depth of at most the tolerance.
[[nodiscard]] inline bool separates(const EdgedTriangle& a, const EdgedTriangle& b, double tolerance) {
  std::array<DoubleLanes, 2> gap;
  for (unsigned half = 0; half < 2; ++half) {
    const DoubleLanes d0 = a.x[half] * b.corner[0].x + a.y[half] * b.corner[0].y;
    const DoubleLanes d1 = a.x[half] * b.corner[1].x + a.y[half] * b.corner[1].y;
    const DoubleLanes d2 = a.x[half] * b.corner[2].x + a.y[half] * b.corner[2].y;
    gap[half] = smaller(smaller(d0, d1), d2) - a.reach[half];
  }
  const DoubleLanes widest = larger(gap[0], gap[1]);
  return (widest[0] > widest[1] ? widest[0] : widest[1]) >= -tolerance;
}

/// As overlap() of unfold/patch/patch.hpp, but for rounding.
[[nodiscard]] inline bool overlap(const EdgedTriangle& a, const EdgedTriangle& b, double tolerance) {
  return !separates(a, b, tolerance) && !separates(b, a, tolerance);
}

// A bounding hierarchy of circles over a sequence of faces: the n-th leaf encloses the n-th face of the
// order.

struct Circle {
  Vec2 centre;
  double radius = -1.0;  ///< negative: encloses nothing
};

/// The smallest circle around two others.
[[nodiscard]] inline Circle around(const Circle& a, const Circle& b) {
  if (a.radius < 0.0) {
    return b;
  }
  if (b.radius < 0.0) {
    return a;
  }
  const Vec2 way = b.centre - a.centre;
  const double squared = dot(way, way);
  const double spread = b.radius - a.radius;
  if (squared <= spread * spread) {
    return spread > 0.0 ? b : a;
  }
  const double distance = std::sqrt(squared);
  const double radius = 0.5 * (distance + a.radius + b.radius);
  return {a.centre + ((radius - a.radius) / distance) * way, radius};
}

[[nodiscard]] inline bool apart(const Circle& a, const Circle& b) {
  const Vec2 way = b.centre - a.centre;
  const double reach = a.radius + b.radius;
  return dot(way, way) >= reach * reach;
}

/// Circles of a sequence of faces in blocks of eight, and a complete binary tree over the blocks: node 1 is
/// the root, node i has the children 2 i and 2 i + 1, block b is node first_leaf() + b. A circle can be moved
/// by moving its centre, so the tree of a set of faces that moves needs no rebuilding to be asked about.
///
/// Within a block the circles lie as single-precision numbers side by side, for one comparison of eight at a
/// time; their radii are enlarged by more than the rounding, so none that meets is missed.
class CircleTree {
 public:
  static constexpr std::uint32_t block_size = 8;

  void reset(std::uint32_t count) {
    size_ = count;
    const std::uint32_t blocks = (count + block_size - 1) / block_size;
    leaves_ = std::bit_ceil(std::max(blocks, 2U));
    nodes_.assign(2 * std::size_t{leaves_}, Circle{});
    blocks_.assign(blocks, Block{});
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }
  [[nodiscard]] std::uint32_t first_leaf() const { return leaves_; }
  [[nodiscard]] const Circle& operator[](std::uint32_t node) const { return nodes_[node]; }

  void set(std::uint32_t position, const Circle& circle) {
    Block& block = blocks_[position / block_size];
    const std::uint32_t k = position % block_size;
    block.x[k / 4][k % 4] = static_cast<float>(circle.centre.x);
    block.y[k / 4][k % 4] = static_cast<float>(circle.centre.y);
    block.radius[k / 4][k % 4] = enlarged(circle);
  }
  /// The circle at a position, a little enlarged.
  [[nodiscard]] Circle circle(std::uint32_t position) const {
    return blocks_[position / block_size].circle(position % block_size);
  }

  /// Bits of the circles of a block that meet this one (and perhaps of some that nearly do).
  [[nodiscard]] std::uint32_t meeting(std::uint32_t block_number, const Circle& circle) const {
    const Block& block = blocks_[block_number];
    const auto x = static_cast<float>(circle.centre.x);
    const auto y = static_cast<float>(circle.centre.y);
    const float radius = enlarged(circle);
    std::uint32_t bits = 0;
    for (std::uint32_t half = 0; half < 2; ++half) {
      const FloatLanes dx = block.x[half] - x;
      const FloatLanes dy = block.y[half] - y;
      const FloatLanes reach = block.radius[half] + radius;
      bits |= bits_of(dx * dx + dy * dy < reach * reach) << (4 * half);
    }
    return bits;
  }

  /// Bits of a block's positions that lie in first .. last-1.
  [[nodiscard]] static std::uint32_t bits_within(std::uint32_t block, std::uint32_t first,
                                                 std::uint32_t last) {
    const std::uint32_t begin = block * block_size;
    const std::uint32_t low = std::clamp(first, begin, begin + block_size) - begin;
    const std::uint32_t high = std::clamp(last, begin, begin + block_size) - begin;
    return (1U << high) - (1U << low);
  }

  /// Renews the blocks that hold the positions first .. last-1 and all nodes above. O(last - first + log n).
  void renew(std::uint32_t first, std::uint32_t last);

  /// Calls use(node) for the O(log n) nodes that together cover exactly the blocks first .. last-1.
  template <class Use>
  void cover(std::uint32_t first, std::uint32_t last, Use use) const {
    for (std::uint32_t l = leaves_ + first, r = leaves_ + last; l < r; l /= 2, r /= 2) {
      if ((l & 1U) != 0) {
        use(l++);
      }
      if ((r & 1U) != 0) {
        use(--r);
      }
    }
  }

 private:
  /// Far from everything: what no circle meets. Its square is still a single-precision number.
  static constexpr float nowhere = 1e18F;

  struct Block {
    std::array<FloatLanes, 2> x, y, radius;
    Block() {
      x.fill(FloatLanes{} + nowhere);
      y.fill(FloatLanes{} + nowhere);
      radius.fill(FloatLanes{});
    }
    [[nodiscard]] Circle circle(std::uint32_t k) const {
      return {{static_cast<double>(x[k / 4][k % 4]), static_cast<double>(y[k / 4][k % 4])},
              static_cast<double>(radius[k / 4][k % 4])};
    }
  };

  /// Single precision rounds a coordinate by up to 6e-8 of it.
  static float enlarged(const Circle& circle) {
    return static_cast<float>(circle.radius * (1.0 + 1e-6) +
                              1e-6 * (std::abs(circle.centre.x) + std::abs(circle.centre.y)));
  }

  std::uint32_t size_ = 0;
  std::uint32_t leaves_ = 2;
  std::vector<Circle> nodes_;
  std::vector<Block> blocks_;
};

/// The smallest circle around a triangle's corners.
[[nodiscard]] Circle smallest_circle(Vec2 a, Vec2 b, Vec2 c);

}  // namespace ridgecraft::unfold
