// SPDX-License-Identifier: GPL-3.0-or-later
// EPS of one page's pieces (Adobe, Encapsulated PostScript file format, version 3.0): moves, lines and
// strokes in the colours of the operations, in their order. Cairo would write the time of the run into it,
// and a prologue of its own.
#include <cmath>
#include <optional>
#include <string>

#include "base/utf8.hpp"
#include "export/formats/pdf_file.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"

namespace ridgecraft::paper {

std::string write_eps(const Drawing& page, const Mark& mark, const Preset& preset) {
  std::string out = "%!PS-Adobe-3.0 EPSF-3.0\n";
  const Vec2 size = points_per_mm * page.size;
  append(out, "%%Creator: {}\n%%Title: page {} of {}\n%%Keywords: {}\n", printable_utf8(mark.producer),
         page.page, page.page_count, mark_word(mark));
  append(out, "%%BoundingBox: 0 0 {:.0f} {:.0f}\n%%HiResBoundingBox: 0 0 {} {}\n", std::ceil(size.x),
         std::ceil(size.y), decimals(size.x), decimals(size.y));
  out += "%%LanguageLevel: 2\n%%Pages: 1\n%%EndComments\n%%Page: 1 1\ngsave\n";
  // Points are written in mm: numbers stay those of the other formats.
  append(out, "{0:.9f} {0:.9f} scale\n{1} setlinewidth\n", points_per_mm, decimals(preset.width));
  std::optional<Operation> operation;
  for (const Path& path : machine_paths(page, preset.paths)) {
    if (operation != path.operation) {
      operation = path.operation;
      const Color c = preset.colors[static_cast<std::size_t>(path.operation)];
      append(out, "% {}\n{} {} {} setrgbcolor\n", word(path.operation), decimals(c.red / 255.0),
             decimals(c.green / 255.0), decimals(c.blue / 255.0));
    }
    for (std::size_t i = 0; i < path.points.size(); ++i) {
      append(out, "{} {} {}\n", decimals(path.points[i].x), decimals(path.points[i].y),
             i == 0 ? "moveto" : "lineto");
    }
    out += path.closed ? "closepath stroke\n" : "stroke\n";
  }
  out += "grestore\nshowpage\n%%EOF\n";
  return out;
}

}  // namespace ridgecraft::paper
