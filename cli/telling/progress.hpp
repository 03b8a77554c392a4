// SPDX-License-Identifier: GPL-3.0-or-later
// A progress line on standard error, with the stage's name; only on a terminal.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace ridgecraft::cli {

class Progress {
 public:
  /// Silent unless `wanted` and standard error is a terminal.
  explicit Progress(bool wanted);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  /// share 0 .. 1 of a stage.
  void show(std::string_view stage, double share);
  /// Wipes the line, so that other output begins at its start.
  void clear();

 private:
  bool visible_;
  bool drawn_ = false;
  std::mutex mutex_;
  std::string stage_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace ridgecraft::cli
