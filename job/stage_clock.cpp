// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/stage_clock.hpp"

#include <algorithm>
#include <numeric>

namespace ridgecraft::job {

void StageClock::add(std::string_view name, double seconds) {
  const auto known =
      std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& stage) { return stage.first == name; });
  if (known != seconds_.end()) {
    known->second += seconds;
  } else {
    seconds_.emplace_back(name, seconds);
  }
}

void StageClock::add(const StageSeconds& seconds) {
  for (const auto& [name, value] : seconds) {
    add(name, value);
  }
}

double total(const StageSeconds& seconds) {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0,
                         [](double sum, const auto& stage) { return sum + stage.second; });
}

}  // namespace ridgecraft::job
