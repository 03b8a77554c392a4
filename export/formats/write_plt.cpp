// SPDX-License-Identifier: GPL-3.0-or-later
// HPGL of one page (Hewlett-Packard, HP-GL reference): pens up and down between whole numbers of plotter
// units, which every roll plotter of the last forty years understands.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"

namespace ridgecraft::paper {
namespace {

/// 0.025 mm each.
constexpr double plotter_units_per_mm = 40.0;

/// 1 scores, 2 cuts, 3 writes; 0: left out, as a plotter looks for its marks by itself.
int pen_of(Operation operation) {
  switch (operation) {
    case Operation::registration:
      return 0;
    case Operation::engrave:
      return 3;
    case Operation::mountain:
    case Operation::valley:
    case Operation::tab_fold:
      return 1;
    case Operation::cut_inner:
    case Operation::cut_outer:
      return 2;
  }
  return 0;
}

struct PlotterPoint {
  long x;
  long y;
  friend bool operator==(const PlotterPoint&, const PlotterPoint&) = default;
};

PlotterPoint units(Vec2 p) {
  return {std::lround(plotter_units_per_mm * p.x), std::lround(plotter_units_per_mm * p.y)};
}

}  // namespace

std::string write_plt(const Drawing& page, const Mark& mark, const PathRules& rules) {
  std::string out = "IN;\n";
  int pen = 0;
  for (const Path& path : machine_paths(page, rules)) {
    const int its = pen_of(path.operation);
    if (its == 0) {
      continue;
    }
    if (its != pen) {
      pen = its;
      append(out, "SP{};\n", pen);
    }
    PlotterPoint at = units(path.points[0]);
    append(out, "PU{},{};PD", at.x, at.y);
    std::size_t count = 0;
    for (std::size_t i = 1; i < path.points.size() + (path.closed ? 1 : 0); ++i) {
      const PlotterPoint next = units(path.points[i % path.points.size()]);
      if (next != at) {
        append(out, "{}{},{}", count++ == 0 ? "" : ",", next.x, next.y);
        at = next;
      }
    }
    out += ";\n";
  }
  // A comment, at the end: some old plotters report an instruction that they don't know, and go on.
  append(out, "PU;SP0;\nCO\"{}\";\n", mark_word(mark));
  return out;
}

}  // namespace ridgecraft::paper
