// SPDX-License-Identifier: GPL-3.0-or-later
// What was done to bodies before they were united.
#pragma once

#include <cstddef>

namespace ridgecraft::prepare {

/// Components that were left out.
struct Details {
  std::size_t small = 0;  ///< too small or too narrow to be folded and held
  std::size_t flat = 0;   ///< flat, and lying on another one

  [[nodiscard]] std::size_t count() const { return small + flat; }
  Details& operator+=(const Details& other) {
    small += other.small;
    flat += other.flat;
    return *this;
  }
};

struct ReadyReport {
  Details left_out;
  /// Faces of the model before; 0 where bodies weren't simplified.
  std::size_t faces_before = 0;
  /// How far simplification moved the surface, in units of the surface that was given.
  double deviation = 0.0;
};

}  // namespace ridgecraft::prepare
