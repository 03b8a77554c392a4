// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/marks.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "base/geometry.hpp"
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

namespace {

constexpr double place_step_mm = 4.0;

std::vector<Vec2> square(Vec2 centre, double side) {
  const double h = 0.5 * side;
  return {centre + Vec2{-h, -h}, centre + Vec2{h, -h}, centre + Vec2{h, h}, centre + Vec2{-h, h}};
}

Group test_piece(Vec2 centre) {
  Group group;
  group.id = "kerf-test";
  std::vector<Vec2> hole = square(centre, kerf_test_hole_mm);
  std::ranges::reverse(hole);
  group.lines.push_back({Layer::cut, square(centre, kerf_test_mm), true});
  group.lines.push_back({Layer::cut, std::move(hole), true});
  Text words;
  words.layer = Layer::piece_name;
  words.text = "20, 10";
  words.height = 2.0;
  words.centre = centre + Vec2{0.0, -0.25 * (kerf_test_mm + kerf_test_hole_mm)};
  group.texts.push_back(std::move(words));
  return group;
}

/// Whether nothing of the page's pieces lies in the box, and no piece encloses it.
bool is_free(const Drawing& page, const Box2& box) {
  const Vec2 middle = 0.5 * (box.low + box.high);
  std::vector<std::vector<Vec2>> loops;
  for (const Group& group : page.groups) {
    for (const Line& line : group.lines) {
      if (line.layer == Layer::mark && line.like == Layer::mark) {
        continue;
      }
      const std::size_t count = line.points.size() - (line.closed ? 0 : 1);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec2 a = line.points[i];
        const Vec2 b = line.points[(i + 1) % line.points.size()];
        // By the side's box: a free place more or less is no loss.
        if (std::max(a.x, b.x) > box.low.x && std::min(a.x, b.x) < box.high.x &&
            std::max(a.y, b.y) > box.low.y && std::min(a.y, b.y) < box.high.y) {
          return false;
        }
      }
      if (line.layer == Layer::cut && line.closed) {
        loops.push_back(line.points);
      }
    }
    for (const Text& text : group.texts) {
      if (group.id != "page" && length(text.centre - middle) < kerf_test_mm) {
        return false;
      }
    }
  }
  return !inside(loops, middle);
}

std::optional<Vec2> free_place(const Drawing& page, const Paper& paper) {
  const Box2 area = piece_box(paper);
  const double half = 0.5 * kerf_test_mm;
  const Vec2 around{half + paper.gap, half + paper.gap};
  for (double y = area.high.y - half; y >= area.low.y + half; y -= place_step_mm) {
    for (double x = area.high.x - half; x >= area.low.x + half; x -= place_step_mm) {
      Box2 box;
      box.add(Vec2{x, y} - around);
      box.add(Vec2{x, y} + around);
      if (is_free(page, box)) {
        return Vec2{x, y};
      }
    }
  }
  return std::nullopt;
}

}  // namespace

void add_kerf_test(std::vector<Drawing>& pages, const Paper& paper) {
  for (Drawing& page : pages) {
    if (const auto place = free_place(page, paper)) {
      page.groups.push_back(test_piece(*place));
      return;
    }
  }
  Drawing own;
  own.size = paper.size;
  own.title = pages.empty() ? "" : pages.front().title;
  const Box2 area = piece_box(paper);
  own.groups.push_back(test_piece(area.low + Vec2{0.5 * kerf_test_mm, 0.5 * kerf_test_mm}));
  pages.push_back(std::move(own));
  for (std::size_t i = 0; i < pages.size(); ++i) {
    pages[i].page = static_cast<int>(i + 1);
    pages[i].page_count = static_cast<int>(pages.size());
  }
}

}  // namespace ridgecraft::export_
