// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft formats tells.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/files/formats.hpp"
#include "cli/telling/summary.hpp"

namespace ridgecraft::cli {
namespace {

std::string lines_of(const std::vector<FormatRow>& rows) {
  std::string text;
  for (const FormatRow& row : rows) {
    text += fmt::format("  {:<6} {}\n", row.suffix, row.what);
  }
  return text;
}

Value rows_of(const std::vector<FormatRow>& rows) {
  Value list(Value::List{});
  for (const FormatRow& row : rows) {
    list.add(Value::Object{{"suffix", row.suffix}, {"what", row.what}});
  }
  return list;
}

/// ".svg, .dxf", what --preset writes where no file is named.
std::string suffixes_of(const paper::Preset& preset) {
  std::vector<std::string> suffixes;
  for (const Format format : default_formats(&preset)) {
    suffixes.emplace_back(suffix(format));
  }
  return fmt::format("{}", fmt::join(suffixes, ", "));
}

std::string preset_lines() {
  std::string text;
  for (const paper::Preset& preset : paper::presets()) {
    text += fmt::format("  {:<11} {} ({})\n", preset.name, preset.what, suffixes_of(preset));
  }
  return text;
}

Value presets_value() {
  Value list(Value::List{});
  for (const paper::Preset& preset : paper::presets()) {
    list.add(Value::Object{{"name", std::string(preset.name)},
                           {"what", std::string(preset.what)},
                           {"files", suffixes_of(preset)}});
  }
  return list;
}

}  // namespace

std::string formats_text() {
  return "read:\n" + lines_of(read_formats()) + "written:\n" + lines_of(written_formats()) +
         "written for machines, with --preset:\n" + preset_lines();
}

std::string formats_json() {
  return json_text(Value::Object{{"read", rows_of(read_formats())},
                                 {"written", rows_of(written_formats())},
                                 {"presets", presets_value()}}) +
         "\n";
}

}  // namespace ridgecraft::cli
