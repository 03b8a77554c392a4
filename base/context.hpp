// SPDX-License-Identifier: GPL-3.0-or-later
// What long work is given besides its input: a way to tell how far it is, a way to be stopped, threads, a
// seed.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>

namespace ridgecraft {

/// The only thing that is passed through all stages. Results never depend on progress or threads; they depend
/// on the deadline only where a stage says so.
struct Context {
  /// Called now and then, from one thread at a time, with the stage's name and the share done, 0 to 1. May be
  /// empty.
  std::function<void(std::string_view stage, double share)> progress;
  /// Asked for often; when it is set the stage throws Error(interrupted) within a fraction of a second.
  std::stop_token stop;
  /// Emergency brake: searches end with the best they have when it has passed.
  std::optional<std::chrono::steady_clock::time_point> deadline;
  unsigned threads = 1;    ///< at least 1; never changes a result
  std::uint64_t seed = 1;  ///< of everything random

  /// Throws Error(interrupted) when the user asked to stop.
  void check() const;
  [[nodiscard]] bool out_of_time() const { return deadline && std::chrono::steady_clock::now() >= *deadline; }
  void report(std::string_view stage, double share) const {
    if (progress) {
      progress(stage, share);
    }
  }
};

/// Small seeded generator with a fixed sequence on every machine (splitmix64, Steele, Lea, Flood 2014): the
/// standard library's distributions and shuffles differ between implementations.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  /// Uniform in 0 .. bound-1; bound at least 1 (multiply-shift: the bias is below 2^-32).
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32U) * std::uint64_t{bound}) >> 32U);
  }
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

 private:
  std::uint64_t state_;
};

}  // namespace ridgecraft
