// SPDX-License-Identifier: GPL-3.0-or-later
// Numbered values that remember what they were, so that a change of many of them can be taken back.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace ridgecraft::unfold {

/// A fixed number of values with a log of all that was overwritten since the last keep(). Taking back reads
/// the log and never writes to it. T must be comparable.
template <class T>
class LoggedValues {
 public:
  /// `count` default values and an empty log.
  explicit LoggedValues(std::size_t count) : now_(count) {}

  [[nodiscard]] const T& operator[](std::uint32_t i) const { return now_[i]; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(now_.size()); }

  /// Overwrites a value; one that stays the same isn't logged.
  void set(std::uint32_t i, const T& value) {
    if (!(now_[i] == value)) {
      before_.emplace_back(i, now_[i]);
      now_[i] = value;
    }
  }

  /// From here on: what is overwritten now can't be taken back any more.
  void keep() { before_.clear(); }

  /// Makes all values what they were at the last keep(). O(values overwritten since).
  void take_back() {
    // The oldest entry of a value is the one that counts, so the newest come first.
    for (auto entry = before_.rbegin(); entry != before_.rend(); ++entry) {
      now_[entry->first] = entry->second;
    }
    before_.clear();
  }

  /// Default values for all, and nothing to take back.
  void reset() {
    now_.assign(now_.size(), T());
    before_.clear();
  }

 private:
  std::vector<T> now_;
  std::vector<std::pair<std::uint32_t, T>> before_;
};

}  // namespace ridgecraft::unfold
