// SPDX-License-Identifier: GPL-3.0-or-later
// What was done to bodies before they were united.
#pragma once

#include <cstddef>

#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::prepare {

/// Components that were left out.
struct Details {
  std::size_t small = 0;  ///< too small or too narrow to be folded and held
  std::size_t flat = 0;   ///< flat, and lying on another one
  std::size_t low = 0;    ///< bodies that hardly stand out of another one

  [[nodiscard]] std::size_t count() const { return small + flat + low; }
  Details& operator+=(const Details& other) {
    small += other.small;
    flat += other.flat;
    low += other.low;
    return *this;
  }
};

/// Busy bodies in whose places there are plain blocks.
struct PlainBodies {
  std::size_t count = 0;
  /// How far a block is from what it stands for, both ways; on paper as far as the size is known.
  double moved_mm = 0.0;
};

/// Thin walls that became sheets.
struct SheetsReport {
  std::size_t walls = 0;      ///< components
  double thickness_mm = 0.0;  ///< of the thickest one, on paper as far as its size is known
};

/// What was done to bodies before they had their size.
struct ReadyReport {
  SheetsReport sheets;
  Details left_out;
  PlainBodies plain;
  /// Of bodies that were simplified one by one, lengths in units of the surface that was given; else without
  /// any faces.
  SimplifyReport simplified;
};

}  // namespace ridgecraft::prepare
