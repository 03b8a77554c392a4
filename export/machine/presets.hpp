// SPDX-License-Identifier: GPL-3.0-or-later
// What machines and their programs expect of a file, one row each.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "export/machine/operations.hpp"
#include "export/style/line_style.hpp"

namespace ridgecraft::export_ {

// Names of the inks that stand for what a packaging machine does.

/// Letter case matters to the programs that drive cutters.
struct SpotNames {
  std::string cut = "CutContour";
  std::string perforation = "PerfCutContour";
  std::string crease = "Crease";
  std::string glue = "Glue";
};

/// Which DXF.
enum class DxfKind {
  r2000,  ///< release 2000: millimetres stand in the file
  r12,    ///< release 12, for older machines: it holds no unit
  plain,  ///< release 12, single lines on layer 0
};

/// What a machine's files are like. Each value of a preset can be set by an option.
struct Preset {
  std::string_view name = {};  ///< as it is typed: "lightburn"; empty: no machine, a printer
  std::string_view what = {};  ///< whose it is, for people
  bool svg = true;             ///< these are written where no file is named
  bool pdf = false;            ///< with inks for a packaging shop (write_packaging_pdf)
  bool dxf = false;
  bool plt = false;
  bool fold = false;
  DxfKind dxf_kind = DxfKind::r2000;
  PathRules paths = {};
  /// By Operation, each exactly one colour, as programs sort lines by it; the base of a tab has that of its
  /// fold. LightBurn's first layers, unless a preset says otherwise.
  std::array<Color, operation_count> colors{{{0xf3, 0x69, 0x26},
                                             {0x00, 0xe0, 0x00},
                                             {0x00, 0x00, 0xff},
                                             {0xa0, 0x00, 0xa0},
                                             {0x00, 0x00, 0xff},
                                             {0xff, 0x00, 0x00},
                                             {0x00, 0x00, 0x00}}};
  double width = 0.1;      ///< SVG and EPS: of all lines, mm
  bool own_marks = false;  ///< the machine's program adds registration marks by itself
  bool simulates = false;  ///< SVG: edges of nets with their angles, as a simulator of folding reads them
  bool joined = false;     ///< SVG: all lines of an operation are one path, which a program can't take apart
  /// SVG: units per inch, for programs that take a unit for a pixel; 0: a unit is a millimetre.
  double svg_units_per_inch = 0.0;
  Vec2 sheet{};         ///< mm; {0, 0}: the paper's
  double margin = 0.0;  ///< of that sheet, mm

  [[nodiscard]] bool is_machine() const { return !name.empty(); }
};

/// The words of Operation, for options and tables: "cut", "inner", "mountain", ...
[[nodiscard]] std::string_view word(Operation operation);
[[nodiscard]] std::string_view word(Scores scores);

/// All of them, "print" (no machine) not among them.
[[nodiscard]] std::span<const Preset> presets();

}  // namespace ridgecraft::export_
