// SPDX-License-Identifier: GPL-3.0-or-later
// How work is asked to stop. What std::stop_token does, without the half second that its header takes to
// compile in each file that includes this one.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace ridgecraft {

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

}  // namespace ridgecraft
