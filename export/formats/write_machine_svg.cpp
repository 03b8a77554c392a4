// SPDX-License-Identifier: GPL-3.0-or-later
// SVG of one page for a machine: straight lines without pattern, one colour for each operation, in the order
// of work; true millimetres, no text, areas, transforms or styles.
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/utf8.hpp"
#include "base/xml_text.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"

namespace ridgecraft::paper {
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

}  // namespace ridgecraft::paper
