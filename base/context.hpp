// SPDX-License-Identifier: GPL-3.0-or-later
// What long work takes in addition to its input: a way to report progress, a way to be stopped, a deadline,
// threads, a seed.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace ridgecraft {

// How work is asked to stop. What std::stop_token does, without the half second that its header takes to
// compile in each file that includes this one.

/// Asks whether somebody wants the work to stop. Nobody does where it comes from no source.
class StopToken {
 public:
  StopToken() = default;
  [[nodiscard]] bool stop_requested() const {
    return requested_ != nullptr && requested_->load(std::memory_order_relaxed);
  }

 private:
  friend class StopSource;
  explicit StopToken(std::shared_ptr<const std::atomic<bool>> requested) : requested_(std::move(requested)) {}

  std::shared_ptr<const std::atomic<bool>> requested_;
};

/// Asks its tokens' owners to stop, from any thread or signal handler. Copies share one request.
class StopSource {
 public:
  StopSource() : requested_(std::make_shared<std::atomic<bool>>(false)) {}
  void request_stop() noexcept { requested_->store(true, std::memory_order_relaxed); }
  [[nodiscard]] StopToken get_token() const { return StopToken(requested_); }

 private:
  std::shared_ptr<std::atomic<bool>> requested_;
};

// A moment of the steady clock, without the header of clocks, which takes half a second to compile in each
// file.

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
