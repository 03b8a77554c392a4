// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing_checks.hpp"

#include <utility>
#include <vector>

#include "export/packing/packing_shape.hpp"

namespace ridgecraft::test {

std::size_t packing_faults(const export_::PackingTask& task, std::uint32_t pages,
                           const std::function<std::uint32_t(std::uint32_t shape)>& page_of,
                           const PackedPoint& placed) {
  constexpr double rounding = 1e-6;
  std::vector<std::vector<export_::OwnedPolygon>> on_page(pages);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < task.shapes.size(); ++i) {
    for (std::vector<Vec2> polygon : task.shapes[i].convex) {
      for (Vec2& p : polygon) {
        p = placed(i, p);
        const bool inside = p.x >= -rounding && p.y >= -rounding && p.x <= task.area.x + rounding &&
                            p.y <= task.area.y + rounding;
        count += inside ? 0U : 1U;
      }
      on_page.at(page_of(i)).push_back({i, std::move(polygon)});
    }
  }
  for (const auto& polygons : on_page) {
    count += too_near(polygons, task.gap - rounding).size();
  }
  return count;
}

}  // namespace ridgecraft::test
