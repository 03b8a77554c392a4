// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

namespace ridgecraft::cli {
namespace {

bool capable_terminal() {
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace

Progress::Progress(bool wanted) : visible_(wanted && capable_terminal()) {}

void Progress::show(std::string_view stage, double share) {
  if (!visible_) {
    return;
  }
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (stage == stage_ && now - last_ < std::chrono::milliseconds(50)) {
    return;
  }
  stage_ = stage;
  last_ = now;
  constexpr int width = 30;
  const int filled = static_cast<int>(width * std::clamp(share, 0.0, 1.0));
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(width, '.');
  std::fprintf(stderr, "\r\033[K%-14s [%s] %3d %%", stage_.c_str(), bar.c_str(),
               static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0)));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  const std::lock_guard lock(mutex_);
  if (drawn_) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    drawn_ = false;
  }
}

}  // namespace ridgecraft::cli
