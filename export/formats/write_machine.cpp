// SPDX-License-Identifier: GPL-3.0-or-later
// The paths of a machine as SVG, for LightBurn, and as HPGL.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/text.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"

namespace ridgecraft::export_ {
namespace {

/// By Operation: ids, and names for people.
constexpr std::array<std::array<std::string_view, 2>, operation_count> groups{
    {{"registration", "Regmarks"},
     {"engrave", "Engrave"},
     {"mountain", "Score: mountain folds"},
     {"valley", "Score: valley folds"},
     {"tab", "Score: tabs"},
     {"cut-inner", "Cut: holes and slits"},
     {"cut", "Cut: outlines"}}};

constexpr double mm_per_inch = 25.4;

class MachineSvg {
 public:
  MachineSvg(const Drawing& page, const Mark& mark, const Preset& preset)
      : page_(page), mark_(mark), preset_(preset), paths_(machine_paths(page, preset.paths)) {}

  std::string write() {
    const std::string width = number(page_.size.x);
    const std::string height = number(page_.size.y);
    append(out_,
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<svg xmlns=\"http://www.w3.org/2000/svg\" "
           "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\"\n"
           "     width=\"{0}{2}\" height=\"{1}{2}\" viewBox=\"0 0 {0} {1}\">\n",
           width, height, preset_.svg_units_per_inch > 0.0 ? "" : "mm");
    append(out_, "  <title>{} – page {} of {}</title>\n", escaped(page_.title), page_.page, page_.page_count);
    append(out_, "  <metadata id=\"metadata\">{} preset:{} {}</metadata>\n", escaped(mark_.producer),
           preset_.name, escaped(mark_word(mark_)));
    for (std::size_t i = 0; i < groups.size(); ++i) {
      group(static_cast<Operation>(i));
    }
    append(out_, "</svg>\n");
    return std::move(out_);
  }

 private:
  /// A length in the file's units.
  [[nodiscard]] std::string number(double mm) const {
    return decimals(preset_.svg_units_per_inch > 0.0 ? mm * preset_.svg_units_per_inch / mm_per_inch : mm);
  }
  static std::string escaped(std::string_view text) { return xml_escaped(printable_utf8(text)); }

  /// Programs honour empty layers in ways of their own, so there are none.
  void group(Operation operation) {
    std::vector<std::string> lines;
    for (const Path& path : paths_) {
      if (path.operation == operation) {
        lines.push_back(outline(path));
      }
    }
    if (lines.empty()) {
      return;
    }
    const auto& [id, title] = groups[static_cast<std::size_t>(operation)];
    append(out_, "  <g inkscape:groupmode=\"layer\" inkscape:label=\"{}\" id=\"{}\">\n", title, id);
    if (preset_.joined) {
      lines = {fmt::format("{}", fmt::join(lines, " "))};
    }
    const Color c = preset_.colors[static_cast<std::size_t>(operation)];
    for (const std::string& line : lines) {
      append(out_, "    <path fill=\"none\" stroke=\"#{:02x}{:02x}{:02x}\" stroke-width=\"{}\" d=\"{}\"/>\n",
             c.red, c.green, c.blue, number(preset_.width), line);
    }
    append(out_, "  </g>\n");
  }

  [[nodiscard]] std::string outline(const Path& path) const {
    std::string d;
    for (const Vec2 p : path.points) {
      d += fmt::format("{}{},{}", d.empty() ? "M" : " L", number(p.x), number(page_.size.y - p.y));
    }
    return path.closed ? d + " Z" : d;
  }

  const Drawing& page_;
  const Mark& mark_;
  const Preset& preset_;
  std::vector<Path> paths_;
  std::string out_;
};

}  // namespace

std::string write_machine_svg(const Drawing& page, const Mark& mark, const Preset& preset) {
  return MachineSvg(page, mark, preset).write();
}

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

}  // namespace ridgecraft::export_
