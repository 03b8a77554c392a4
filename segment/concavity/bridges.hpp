// SPDX-License-Identifier: GPL-3.0-or-later
// Bridges of a part and what is known of their concavity (docs/design/segmentation.md, "Bridges").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "base/vector.hpp"
#include "segment/hull/hull.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// The ends are joined by an arc or a jump: the bridge is its own valley, of concavity 0.
struct Joined {};

/// The valley was searched.
struct Searched {
  double concavity = 0.0;  ///< infinite where there is no valley
  /// Of a high one: lengths of the sub-valleys from a and from b to the separator on their side; 0 where
  /// nothing but the concavity was asked for.
  std::array<double, 2> reach{};
};

/// The concavity was bounded by that of a neighbour.
struct Derived {
  double least = 0.0;
  double most = 0.0;
  std::uint32_t from = none;  ///< searched bridge at the beginning of the chain of neighbours
  bool crossed = false;       ///< a is nearer to that one's b
};

/// Bridge number i is edge number i of the hull.
struct Bridge {
  std::uint32_t a = none;  ///< smaller end
  std::uint32_t b = none;
  double length = 0.0;  ///< of its valley, estimated when derived; straight as long as nothing is known
  bool high = false;    ///< more concave than the tolerance
  std::variant<std::monostate, Joined, Searched, Derived> known;

  [[nodiscard]] bool is_open() const { return std::holds_alternative<std::monostate>(known); }
};

struct ConcavityBounds {
  double least = 0.0;
  double most = 0.0;  ///< the same where the bridge was searched
};

/// Of a bridge that was searched or derived; none for others.
[[nodiscard]] std::optional<ConcavityBounds> concavity_bounds(const Bridge& bridge);
/// Greatest concavity that it may have: 0 for one that is joined or open.
[[nodiscard]] double greatest_concavity(const Bridge& bridge);
/// Lengths of the sub-valleys of a high bridge from a and from b; a derived one takes those of the bridge
/// that it comes from.
[[nodiscard]] std::array<double, 2> sub_valleys(const Bridge& bridge, std::span<const Bridge> bridges);

/// Bounds the concavity of bridge `index` by that of a bridge that shares an end and a triangle of the hull
/// with it, and decides whether it is high; false, and nothing is changed, where no neighbour is near enough
/// (docs/design/segmentation.md, "Derived bridges"). O(1).
bool derive_bridge(std::uint32_t index, const Hull& hull, std::span<const Vec3> points, double tolerance,
                   std::span<Bridge> bridges);

}  // namespace ridgecraft::segment
