// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing.hpp"

#include <algorithm>
#include <array>

#include "export/packing/packing_search.hpp"

namespace ridgecraft::paper {
namespace {

/// Pages that hold no more than this share in paper are tried with more room between the shapes, mm: numbers
/// find places there, and scissors do.
constexpr double loose_fill = 0.5;
constexpr std::array<double, 2> loose_gaps{7.0, 4.5};
constexpr PackingDetail loose_detail{200.0, 12};
constexpr PackingDetail rough_detail{150.0, 8};
/// Shapes stay in the upper part of a page that isn't full, this far below its border, mm.
constexpr double most_from_top = 8.0;

/// As fine as some 20 ms of drawing shapes into bitmaps allow; turns find room, where shapes are few.
PackingDetail detail_for(const PackingTask& task) {
  constexpr std::size_t most_drawn = 40'000;
  constexpr std::size_t most_turned = 4'000;
  std::size_t polygons = 1;
  for (const PackingShape& shape : task.shapes) {
    polygons += shape.convex.size();
  }
  const std::size_t turns = std::min(most_drawn / polygons, most_turned / task.shapes.size());
  return {task.shapes.size() > 150 ? 220.0 : 300.0, std::clamp<std::size_t>(turns, 4, 64)};
}

/// Lays the shapes of a page further apart if they have room to be.
void loosen(const PackingTask& task, const std::vector<std::uint32_t>& shapes, const Context& context,
            std::vector<Packed>& packed) {
  PackingTask page;
  double used = 0.0;
  for (const std::uint32_t shape : shapes) {
    page.shapes.push_back(task.shapes[shape]);
    page.group.push_back(0);
    used += task.shapes[shape].area;
  }
  page.area = task.area;
  if (shapes.size() < 2 || used > loose_fill * page.area.x * page.area.y) {
    return;
  }
  for (const double gap : loose_gaps) {
    if (gap <= task.gap || context.out_of_time()) {
      return;
    }
    page.gap = gap;
    const std::vector<Packed> loose = PackingSearch(page, loose_detail, context).run_for_one_page();
    for (std::size_t i = 0; i < loose.size(); ++i) {
      packed[shapes[i]].turn = loose[i].turn;
      packed[shapes[i]].shift = loose[i].shift;
    }
    if (!loose.empty()) {
      return;
    }
  }
}

/// Moves all shapes of a page off its borders where there is room, for numbers beside them.
void move_inwards(const PackingTask& task, const std::vector<std::uint32_t>& shapes,
                  std::vector<Packed>& packed) {
  Box2 box;
  for (const std::uint32_t shape : shapes) {
    for (const Vec2 p : task.shapes[shape].hull) {
      box.add(packed[shape].turn(p) + packed[shape].shift);
    }
  }
  const Vec2 left = task.area - box.size();
  // Exact fits stay as they are: nothing may be moved over a border by rounding.
  const double from_side = std::max(0.0, 0.5 * left.x);
  const double from_top = std::clamp(0.5 * left.y, 0.0, most_from_top);
  const Vec2 by{left.x > fit_tolerance_mm ? from_side - box.low.x : 0.0,
                left.y > fit_tolerance_mm ? task.area.y - from_top - box.high.y : 0.0};
  for (const std::uint32_t shape : shapes) {
    packed[shape].shift += by;
  }
}

}  // namespace

std::size_t rough_page_count(const PackingTask& task, const Context& context) {
  return task.shapes.empty() ? 0 : PackingSearch(task, rough_detail, context).rough_page_count();
}

std::vector<Packed> pack(const PackingTask& task, const Context& context) {
  if (task.shapes.empty()) {
    return {};
  }
  std::vector<Packed> packed = PackingSearch(task, detail_for(task), context).run();
  std::vector<std::vector<std::uint32_t>> on_page;
  for (std::uint32_t i = 0; i < packed.size(); ++i) {
    on_page.resize(std::max<std::size_t>(on_page.size(), packed[i].page + 1));
    on_page[packed[i].page].push_back(i);
  }
  for (const std::vector<std::uint32_t>& shapes : on_page) {
    loosen(task, shapes, context, packed);
    move_inwards(task, shapes, packed);
  }
  return packed;
}

}  // namespace ridgecraft::paper
