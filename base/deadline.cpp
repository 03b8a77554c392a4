// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/deadline.hpp"

#include <algorithm>
#include <chrono>

namespace ridgecraft {
namespace {

/// A hundred years: as good as never, and far from the end of 64 bits.
constexpr double longest_s = 100.0 * 365.0 * 86400.0;

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

Deadline Deadline::in(double seconds) {
  return Deadline(now() + static_cast<std::int64_t>(1e9 * std::clamp(seconds, -longest_s, longest_s)));
}

bool Deadline::has_passed() const {
  return now() >= nanoseconds_;
}

double Deadline::seconds_left() const {
  return 1e-9 * static_cast<double>(nanoseconds_ - now());
}

}  // namespace ridgecraft
