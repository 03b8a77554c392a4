// SPDX-License-Identifier: GPL-3.0-or-later
// LightBurn project of one page: XML that its maker doesn't document. What it needs is known from the
// programs that read or write it (boxes.py, MeerK40t): settings by number, and shapes with the number of
// theirs. Layers have names and an order; power and speed are the owner's, so none are written.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/utf8.hpp"
#include "base/xml_text.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"

namespace ridgecraft::paper {
namespace {

/// The layers of LightBurn's palette that have the colours of its preset.
struct Setting {
  int index;
  std::string_view name;
};

/// By Operation. 30 is tool layer T1, which is shown and never cut.
constexpr std::array<Setting, operation_count> settings{{{30, "Marks"},
                                                         {3, "Numbers"},
                                                         {1, "Mountain folds"},
                                                         {15, "Valley folds"},
                                                         {4, "Bases of tabs"},
                                                         {2, "Holes and slits"},
                                                         {0, "Outlines"}}};

const Setting& setting_of(const Path& path) {
  return settings[static_cast<std::size_t>(path.operation)];
}

void add_shape(const Path& path, std::string& out) {
  append(out, "  <Shape Type=\"Path\" CutIndex=\"{}\">\n    <XForm>1 0 0 1 0 0</XForm>\n    <VertList>",
         setting_of(path).index);
  for (const Vec2 p : path.points) {
    // Without curves: neither side of a corner has a control point.
    append(out, "V{} {}c0x1c1x1", decimals(p.x), decimals(p.y));
  }
  out += "</VertList>\n    <PrimList>";
  if (path.closed) {
    out += "LineClosed";
  } else {
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      append(out, "L{} {}", i - 1, i);
    }
  }
  out += "</PrimList>\n  </Shape>\n";
}

}  // namespace

std::string write_lbrn(const Drawing& page, const Mark& mark, const PathRules& rules) {
  const std::vector<Path> paths = machine_paths(page, rules);
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  append(out, "<!-- {} {} -->\n", xml_escaped(printable_utf8(mark.producer)),
         xml_escaped(printable_utf8(mark_word(mark))));
  out +=
      "<LightBurnProject AppVersion=\"1.0.06\" FormatVersion=\"1\" MaterialHeight=\"0\" MirrorX=\"False\" "
      "MirrorY=\"False\">\n";
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const bool used = std::ranges::any_of(
        paths, [&](const Path& path) { return path.operation == static_cast<Operation>(i); });
    if (!used) {
      continue;
    }
    const bool tool = settings[i].index >= 30;
    append(out,
           "  <CutSetting type=\"{}\">\n    <index Value=\"{}\"/>\n    <name Value=\"{}\"/>\n"
           "    <priority Value=\"{}\"/>\n  </CutSetting>\n",
           tool ? "Tool" : "Cut", settings[i].index, settings[i].name, i);
  }
  for (const Path& path : paths) {
    add_shape(path, out);
  }
  out += "</LightBurnProject>\n";
  return out;
}

}  // namespace ridgecraft::paper
