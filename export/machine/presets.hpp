// SPDX-License-Identifier: GPL-3.0-or-later
// What machines and their programs expect of a file, one row each.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "export/machine/operations.hpp"
#include "export/style/line_style.hpp"

namespace ridgecraft::paper {

/// Which DXF.
enum class DxfKind {
  r2000,  ///< release 2000: millimetres stand in the file
  r12,    ///< release 12, for older machines: a unit can't be told
  plain,  ///< release 12, single lines on layer 0
};

struct Preset {
  std::string_view name = {};  ///< as it is typed: "lightburn"
  std::string_view what = {};  ///< whose it is, for people
  bool svg = true;             ///< it is written where no file is named
  std::optional<DxfKind> dxf = std::nullopt;
  PathRules paths = {};
  /// SVG: by Operation, each exactly one colour, as programs sort lines by it; the base of a tab has that of
  /// its fold.
  std::array<Color, operation_count> colors{};
  double width = 0.1;      ///< SVG: of all lines, mm
  bool simulates = false;  ///< SVG: edges of nets with their angles, as a simulator of folding reads them
  bool joined = false;     ///< SVG: all lines of an operation are one path, which a program can't take apart
};

/// All of them, "print" (no machine) not among them.
[[nodiscard]] std::span<const Preset> presets();

}  // namespace ridgecraft::paper
