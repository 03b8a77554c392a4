// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft formats tells.
#include <algorithm>
#include <cstddef>

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
  for (const Format format : default_formats(preset)) {
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

std::string hex(paper::Color c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

/// What a preset's files are like, a word for each column.
std::vector<std::string> columns_of(const paper::Preset& preset) {
  const auto colour = [&](paper::Operation operation) {
    return preset.svg && !preset.simulates ? hex(preset.colors[static_cast<std::size_t>(operation)]) : "-";
  };
  const paper::PathRules& paths = preset.paths;
  const bool cuts = !preset.simulates;
  return {std::string(preset.name),
          suffixes_of(preset),
          preset.sheet.x > 0.0 ? fmt::format("{:g}x{:g}", preset.sheet.x, preset.sheet.y) : "--paper",
          colour(paper::Operation::cut_outer),
          colour(paper::Operation::cut_inner),
          colour(paper::Operation::mountain),
          colour(paper::Operation::valley),
          cuts && paths.engraves ? colour(paper::Operation::engrave) : "none",
          cuts ? std::string(word(paths.scores)) : "-",
          preset.svg || preset.pdf ? fmt::format("{:g}", preset.width) : "-",
          cuts ? fmt::format("{:g}", paths.kerf_mm) : "-"};
}

std::string preset_table() {
  std::vector<std::vector<std::string>> rows{
      {"preset", "files", "sheet", "cut", "inner", "mountain", "valley", "numbers", "folds", "line", "kerf"}};
  for (const paper::Preset& preset : paper::presets()) {
    rows.push_back(columns_of(preset));
  }
  std::vector<std::size_t> widths(rows[0].size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += fmt::format("{:<{}}  ", row[i], widths[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text + "Lengths in mm. Colours are those of SVG and EPS; DXF has a layer for each operation.\n";
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

std::string formats_text(bool presets) {
  if (presets) {
    return preset_table();
  }
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
