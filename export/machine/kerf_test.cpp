// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/machine/kerf_test.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "base/geometry.hpp"

namespace ridgecraft::export_ {
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
