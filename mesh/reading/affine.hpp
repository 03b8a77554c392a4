// SPDX-License-Identifier: GPL-3.0-or-later
// Where a file puts an object: turned, scaled, sheared, mirrored and moved.
#pragma once

#include <array>

#include "base/vector.hpp"

namespace ridgecraft::mesh {

/// p goes to (rows[0] . p, rows[1] . p, rows[2] . p) + shift.
struct Affine {
  std::array<Vec3, 3> rows{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
  Vec3 shift;

  [[nodiscard]] constexpr Vec3 turn(Vec3 p) const {
    return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)};
  }
  [[nodiscard]] constexpr Vec3 operator()(Vec3 p) const { return turn(p) + shift; }
  /// True where it turns the outside of a surface inside.
  [[nodiscard]] constexpr bool mirrors() const { return dot(rows[0], cross(rows[1], rows[2])) < 0.0; }

  friend constexpr bool operator==(const Affine&, const Affine&) = default;
};

/// First b, then a.
[[nodiscard]] constexpr Affine operator*(const Affine& a, const Affine& b) {
  Affine both;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 row = a.rows[i];
    both.rows[i] = row.x * b.rows[0] + row.y * b.rows[1] + row.z * b.rows[2];
  }
  both.shift = a(b.shift);
  return both;
}

}  // namespace ridgecraft::mesh
