// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/telling/summary_blocks.hpp"

#include <cmath>

#include <fmt/format.h>

namespace ridgecraft::cli {

double rounded(double value) {
  return std::round(value * 1000.0) / 1000.0;
}

Json repairs_json(const mesh::RepairReport& report) {
  Json list = Json::array();
  for (const mesh::Repair& repair : report.entries()) {
    list.push_back({{"kind", mesh::name(repair.kind)}, {"count", repair.count}});
  }
  return list;
}

Json seconds_json(const StageClock& clock) {
  Json seconds = Json::object();
  for (const auto& [name, value] : clock.seconds()) {
    const double before = seconds.contains(name) ? seconds[name].get<double>() : 0.0;
    seconds[name] = std::round((before + value) * 1e6) / 1e6;
  }
  seconds["total"] = std::round(clock.total() * 1e6) / 1e6;
  return seconds;
}

std::string seconds_text(const StageClock& clock) {
  std::string text = fmt::format("{:.2f} s", clock.total());
  const char* separator = " (";
  const Json seconds = seconds_json(clock);
  for (const auto& [name, value] : seconds.items()) {
    if (name != "total" && value.get<double>() >= 0.005) {
      text += fmt::format("{}{} {:.2f}", separator, name, value.get<double>());
      separator = ", ";
    }
  }
  return text + (*separator == ',' ? ")" : "");
}

std::string written_text(const std::vector<std::string>& files) {
  // Hundreds of pages would push everything else off the screen.
  constexpr std::size_t most = 12;
  if (files.empty()) {
    return "nothing was written: -o says where to\n";
  }
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files.size() <= most || i < 4 || i + 2 >= files.size()) {
      text += "wrote " + files[i] + "\n";
    } else if (i == 4) {
      text += fmt::format("wrote {} more\n", files.size() - 6);
    }
  }
  return text;
}

}  // namespace ridgecraft::cli
