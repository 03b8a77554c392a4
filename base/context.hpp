// SPDX-License-Identifier: GPL-3.0-or-later
// What long work is given besides its input: a way to tell how far it is, a way to be stopped, threads, a
// seed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "base/deadline.hpp"
#include "base/stop.hpp"

namespace ridgecraft {

/// The only thing that is passed through all stages. Results never depend on progress or threads; they depend
/// on the deadline only where a stage says so.
struct Context {
  /// Called now and then, from one thread at a time, with the stage's name and the share done, 0 to 1. May be
  /// empty.
  std::function<void(std::string_view stage, double share)> progress;
  /// Asked for often; when it is set the stage throws Error(interrupted) within a fraction of a second.
  StopToken stop;
  /// Emergency brake: searches end with the best they have when it has passed.
  std::optional<Deadline> deadline;
  /// What makes a result complete (tabs, numbers on pages) may take so many seconds longer.
  double grace_s = 0.0;
  /// Set for work that has nothing before its end (until_deadline): when it has passed, check() throws
  /// Error(out_of_time).
  std::optional<Deadline> give_up;
  unsigned threads = 1;  ///< at least 1; never changes a result
  /// Of random choices in searches; docs/design/architecture.md lists them.
  std::uint64_t seed = 1;

  /// Throws Error(interrupted) when the user asked to stop, Error(out_of_time) when the work is to be given
  /// up.
  void check() const;
  [[nodiscard]] bool out_of_time() const { return deadline && deadline->has_passed(); }
  [[nodiscard]] bool out_of_grace() const { return deadline && deadline->seconds_left() <= -grace_s; }
  void report(std::string_view stage, double share) const {
    if (progress) {
      progress(stage, share);
    }
  }
};

/// The same context for work that is given up, by Error(out_of_time), when this share of the time until the
/// deadline has passed. Without a deadline it never is.
[[nodiscard]] Context until_deadline(const Context& context, double share = 1.0);

}  // namespace ridgecraft
