// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/lengths.hpp"

#include <fmt/format.h>

namespace ridgecraft::cli {
namespace {

/// "6.67", "1500".
std::string three_digits(double ratio) {
  return ratio < 999.5 ? fmt::format("{:.3g}", ratio) : fmt::format("{:.0f}", ratio);
}

}  // namespace

std::string metres(double mm) {
  return mm < 1000.0 ? fmt::format("{:.0f} mm", mm) : fmt::format("{:.2f} m", mm / 1000.0);
}

std::string scale_text(const prepare::Prepared& prepared) {
  const mesh::FileFrame& frame = prepared.model.frame;
  if (!frame.mm_per_unit) {
    return {};
  }
  const double scale = prepared.mm_per_unit / *frame.mm_per_unit;
  return fmt::format("; the file counts in {}{}: this is {} of its size",
                     mesh::unit_names(*frame.mm_per_unit),
                     frame.up ? fmt::format(", {} up", mesh::axis_name(*frame.up)) : "",
                     scale >= 1.0 ? three_digits(scale) + ":1" : "1:" + three_digits(1.0 / scale));
}

}  // namespace ridgecraft::cli
