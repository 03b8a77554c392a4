// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/guide_model.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "export/guide/words.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {

GuideSheet guide_sheet(const Paper& nets) {
  constexpr double inch = 25.4;
  const auto in_inches = [](double side) {
    // Halves of inches, as letter, legal and tabloid have them.
    const double halves = 2.0 * side / inch;
    return std::abs(halves - std::round(halves)) < 1e-3;
  };
  GuideSheet sheet;
  if (in_inches(nets.size.x) && in_inches(nets.size.y)) {
    sheet.size = {8.5 * inch, 11.0 * inch};
  }
  return sheet;
}

Line guide_rule(Vec2 from, Vec2 to) {
  Line line{Layer::mark, {from, to}};
  line.pen = Pen{0.12, {0xb0, 0xb0, 0xb0}};
  return line;
}

Text in_grey(Text text) {
  text.color = guide_grey;
  return text;
}

Group guide_foot(const GuideSheet& sheet, const std::string& title, std::size_t page, std::size_t count) {
  constexpr double height = 2.0;
  constexpr double rule_lift = 4.5;
  Group group;
  group.id = "page";
  const double left = sheet.margin;
  const double right = sheet.size.x - sheet.margin;
  const std::string number = fmt::format("page {} / {}", page, count);
  const double room = right - left - text_width(number, height) - 10.0;
  group.lines.push_back(guide_rule({left, sheet.margin + rule_lift}, {right, sheet.margin + rule_lift}));
  group.texts.push_back(
      words_from(shortened(title + ": how to build it", room, height), {left, sheet.margin}, height));
  group.texts.push_back(words_to(number, {right, sheet.margin}, height));
  return group;
}

const std::array<Viewpoint, 8>& guide_sides() {
  constexpr double degree = std::numbers::pi / 180.0;
  static constexpr std::array<Viewpoint, 8> sides{
      {{35.0 * degree, 22.0 * degree, "as on the first page"},
       {125.0 * degree, 22.0 * degree, "a quarter turn on"},
       {215.0 * degree, 22.0 * degree, "half a turn on"},
       {305.0 * degree, 22.0 * degree, "three quarters of a turn on"},
       {35.0 * degree, -28.0 * degree, "as on the first page, but from below"},
       {125.0 * degree, -28.0 * degree, "a quarter turn on, from below"},
       {215.0 * degree, -28.0 * degree, "half a turn on, from below"},
       {305.0 * degree, -28.0 * degree, "three quarters of a turn on, from below"}}};
  return sides;
}

}  // namespace ridgecraft::export_
