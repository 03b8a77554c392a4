// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/context.hpp"

#include <algorithm>
#include <chrono>

#include "base/error.hpp"

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

void Context::check() const {
  if (stop.stop_requested()) {
    throw Error(ErrorKind::interrupted, "stopped before the work was done; nothing was written");
  }
  if (give_up && give_up->has_passed()) {
    throw Error(ErrorKind::out_of_time,
                "the time given passed before the work was done; nothing was written");
  }
}

Context until_deadline(const Context& context, double share) {
  Context strict = context;
  if (context.deadline) {
    strict.give_up = Deadline::in(share * context.deadline->seconds_left());
  }
  return strict;
}

}  // namespace ridgecraft
