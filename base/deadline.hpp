// SPDX-License-Identifier: GPL-3.0-or-later
// A moment of the steady clock, without the header of clocks, which takes half a second to compile in each
// file.
#pragma once

#include <cstdint>

namespace ridgecraft {

/// A moment until which work may go on; `in` makes one.
class Deadline {
 public:
  /// So many seconds from now; 0 or less: has passed.
  [[nodiscard]] static Deadline in(double seconds);
  [[nodiscard]] bool has_passed() const;
  /// Seconds until then; negative when it has passed.
  [[nodiscard]] double seconds_left() const;

 private:
  explicit Deadline(std::int64_t nanoseconds) : nanoseconds_(nanoseconds) {}

  std::int64_t nanoseconds_;  ///< since the clock's epoch
};

}  // namespace ridgecraft
