// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/registration.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "export/machine/operations.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double from_edges_mm = 10.0;
constexpr double arm_mm = 20.0;
constexpr double square_mm = 5.0;
constexpr Pen pen{0.3, {}};

bool is_printed(Layer layer) {
  return layer == Layer::paint || layer == Layer::label || layer == Layer::piece_name ||
         layer == Layer::mark || layer == Layer::shadow || layer == Layer::glue;
}

}  // namespace

void fit_registration(Paper& paper) {
  paper.margin = std::max(paper.margin, from_edges_mm);
  const double beyond = from_edges_mm + arm_mm - paper.margin;
  paper.foot = std::max(0.0, beyond);
  paper.head = std::max(0.0, beyond);
}

Group registration_marks(Vec2 sheet) {
  const double left = from_edges_mm;
  const double bottom = from_edges_mm;
  const double right = sheet.x - from_edges_mm;
  const double top = sheet.y - from_edges_mm;
  Group group;
  group.id = std::string(registration_group);
  const auto add = [&](std::vector<Vec2> points, bool closed) {
    Line line{Layer::mark, std::move(points), closed};
    line.pen = pen;
    group.lines.push_back(std::move(line));
  };
  const std::vector<Vec2> square{
      {left, top - square_mm}, {left + square_mm, top - square_mm}, {left + square_mm, top}, {left, top}};
  group.areas.push_back({Layer::mark, square, Color{}});
  // The square itself, without the width of a line around it.
  Line border{Layer::mark, square, true};
  border.pen = Pen{0.01, {}};
  group.lines.push_back(std::move(border));
  add({{right - arm_mm, top}, {right, top}, {right, top - arm_mm}}, false);
  add({{left, bottom + arm_mm}, {left, bottom}, {left + arm_mm, bottom}}, false);
  return group;
}

Drawing printed_page(const Drawing& page) {
  Drawing printed = page;
  for (Group& group : printed.groups) {
    std::erase_if(group.lines, [](const Line& line) {
      // A halo of what isn't printed isn't either.
      return !is_printed(line.layer) || (line.layer == Layer::paint && !is_printed(line.like));
    });
    std::erase_if(group.areas, [](const Area& area) { return !is_printed(area.layer); });
    std::erase_if(group.texts, [](const Text& text) { return !is_printed(text.layer); });
  }
  if (std::ranges::any_of(page.groups, [](const Group& group) { return has_layer(group, Layer::cut); })) {
    printed.groups.push_back(registration_marks(page.size));
  }
  return printed;
}

}  // namespace ridgecraft::export_
