// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/lengths.hpp"

#include <fmt/format.h>

namespace ridgecraft::cli {

std::string metres(double mm) {
  return mm < 1000.0 ? fmt::format("{:.0f} mm", mm) : fmt::format("{:.2f} m", mm / 1000.0);
}

}  // namespace ridgecraft::cli
