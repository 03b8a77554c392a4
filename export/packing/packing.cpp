// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/packing/packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/elementary.hpp"
#include "export/packing/packing_search.hpp"

namespace ridgecraft::export_ {
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

/// Where the shapes lie, before pages with room are loosened; the search ends where so few pages are enough.
std::vector<Packed> searched(const PackingTask& task, std::size_t enough_pages, const Context& context) {
  return PackingSearch(task, detail_for(task), context).run(enough_pages);
}

/// Makes use of the room that is left on each page.
void spread_out(const PackingTask& task, const Context& context, std::vector<Packed>& packed) {
  std::vector<std::vector<std::uint32_t>> on_page;
  for (std::uint32_t i = 0; i < packed.size(); ++i) {
    on_page.resize(std::max<std::size_t>(on_page.size(), packed[i].page + 1));
    on_page[packed[i].page].push_back(i);
  }
  for (const std::vector<std::uint32_t>& shapes : on_page) {
    loosen(task, shapes, context, packed);
    move_inwards(task, shapes, packed);
  }
}

std::size_t pages_of(const std::vector<Packed>& packed) {
  std::size_t pages = 0;
  for (const Packed& one : packed) {
    pages = std::max<std::size_t>(pages, one.page + 1);
  }
  return pages;
}

/// Height of the strips in which the sides of shapes are compared, mm.
constexpr double strip_mm = 0.5;
/// What rows have beyond the gap between their shapes, mm: room for a number, for a tip of a leader, none.
constexpr std::array<double, 3> spare_mm{5.0, 2.0, 0.0};
/// Turns of a shape that are tried in a row, at most.
constexpr std::size_t most_turns = 24;
/// Kinds that are given up one after the other before there are no rows at all.
constexpr std::size_t most_given_up = 3;

std::vector<std::vector<Vec2>> moved(const PackingShape& shape, const Rigid& motion) {
  std::vector<std::vector<Vec2>> polygons = shape.convex;
  for (std::vector<Vec2>& polygon : polygons) {
    for (Vec2& p : polygon) {
      p = motion(p);
    }
  }
  return polygons;
}

/// How far a shape reaches to the left and to the right in each strip, from its lowest on.
struct Sides {
  double bottom = 0.0;
  std::vector<double> left, right;
};

Sides sides_of(const std::vector<std::vector<Vec2>>& polygons) {
  Box2 box;
  for (const std::vector<Vec2>& polygon : polygons) {
    for (const Vec2 p : polygon) {
      box.add(p);
    }
  }
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto strips = static_cast<std::size_t>(box.size().y / strip_mm) + 1;
  Sides sides{box.low.y, std::vector<double>(strips, far), std::vector<double>(strips, -far)};
  for (const std::vector<Vec2>& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto [a, b] = std::minmax(polygon[i], polygon[(i + 1) % polygon.size()],
                                      [](Vec2 p, Vec2 q) { return p.y < q.y; });
      const auto strip_at = [&](double y) {
        return std::min(strips - 1, static_cast<std::size_t>(std::max(0.0, y - box.low.y) / strip_mm));
      };
      for (std::size_t s = strip_at(a.y); s <= strip_at(b.y); ++s) {
        const double low = box.low.y + static_cast<double>(s) * strip_mm;
        for (const double y : {std::clamp(low, a.y, b.y), std::clamp(low + strip_mm, a.y, b.y)}) {
          const double x = b.y > a.y ? a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) : a.x;
          sides.left[s] = std::min({sides.left[s], x, b.y > a.y ? x : b.x});
          sides.right[s] = std::max({sides.right[s], x, b.y > a.y ? x : b.x});
        }
      }
    }
  }
  return sides;
}

/// How far to the right of the first shape the second has to be moved, both standing on one line.
double distance(const Sides& first, const Sides& second, double gap) {
  const auto reach = static_cast<std::size_t>(std::ceil(gap / strip_mm)) + 1;
  double most = 0.0;
  for (std::size_t i = 0; i < first.right.size(); ++i) {
    const std::size_t begin = i < reach ? 0 : i - reach;
    for (std::size_t k = begin; k < std::min(second.left.size(), i + reach + 1); ++k) {
      most = std::max(most, first.right[i] - second.left[k] + gap);
    }
  }
  return most;
}

/// Some shapes as one: how each lies in it.
struct Row {
  std::vector<std::uint32_t> shapes;
  std::vector<Rigid> places;
  PackingShape whole;
};

/// Shapes of one kind, all turned in one way, as far as the room goes.
class RowMaker {
 public:
  RowMaker(const PackingTask& task, const AlikeShapes& kind, double gap)
      : task_(task), kind_(kind), gap_(gap) {}

  /// Rows of equally many shapes, of two at least; none where not two have room beside each other.
  [[nodiscard]] std::vector<Row> rows() {
    turn_ = narrowest_turn();
    const std::size_t all = kind_.shapes.size();
    const double longest = elementary::hypot(task_.area.x, task_.area.y);
    const double step = std::max(1.0, distance(sides(0), sides(0), gap_));
    std::size_t most = std::min(all, static_cast<std::size_t>(longest / step) + 1);
    std::vector<Row> result;
    for (; most > 1; --most) {
      const std::size_t count = (all + most - 1) / most;
      result.clear();
      for (std::size_t r = 0; r < count; ++r) {
        result.push_back(row(r * all / count, (r + 1) * all / count));
        if (promising_turns(result.back().whole.hull, task_.area, 1).empty()) {
          break;
        }
      }
      if (result.size() == count && !promising_turns(result.back().whole.hull, task_.area, 1).empty()) {
        return result;
      }
    }
    return {};
  }

 private:
  [[nodiscard]] Rigid upright(std::size_t i) const {
    // A mirror image of what was turned to the left is turned to the right.
    const double sine = kind_.mirrored[i] ? -turn_.sine : turn_.sine;
    return Rigid{turn_.cosine, sine, {}} * kind_.motion[i];
  }
  [[nodiscard]] Sides sides(std::size_t i) const {
    return sides_of(moved(task_.shapes[kind_.shapes[i]], upright(i)));
  }

  /// Of the turns in which a side of the hull stands upright or lies, the one that needs least paper.
  [[nodiscard]] Turn narrowest_turn() {
    const std::vector<Vec2>& hull = task_.shapes[kind_.shapes[0]].hull;
    const std::size_t step = hull.size() / most_turns + 1;
    Turn best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); i += step) {
      const Vec2 along = hull[(i + 1) % hull.size()] - hull[i];
      const Vec2 side = kind_.motion[0].turn(along / length(along));
      for (const Turn turn : {Turn{side.x, -side.y}, Turn{side.y, side.x}}) {
        turn_ = turn;
        const Sides own = sides(0);
        const double paper =
            distance(own, own, gap_) * (static_cast<double>(own.left.size()) * strip_mm + gap_);
        if (paper < least) {
          least = paper;
          best = turn;
        }
      }
    }
    return best;
  }

  [[nodiscard]] Row row(std::size_t first, std::size_t last) const {
    Row row;
    std::vector<Sides> before;
    std::vector<double> at;
    std::vector<std::vector<Vec2>> polygons;
    for (std::size_t i = first; i < last; ++i) {
      const Sides own = sides(i);
      double x = 0.0;
      for (std::size_t k = 0; k < before.size(); ++k) {
        x = std::max(x, at[k] + distance(before[k], own, gap_));
      }
      Rigid place = upright(i);
      place.shift = place.shift + Vec2{x, -own.bottom};
      for (std::vector<Vec2>& polygon : moved(task_.shapes[kind_.shapes[i]], place)) {
        polygons.push_back(std::move(polygon));
      }
      row.shapes.push_back(kind_.shapes[i]);
      row.places.push_back(place);
      before.push_back(own);
      at.push_back(x);
    }
    row.whole = packing_shape(std::move(polygons));
    return row;
  }

  const PackingTask& task_;
  const AlikeShapes& kind_;
  double gap_;
  Turn turn_;
};

/// Rows of all kinds, larger ones first.
std::vector<std::vector<Row>> rows_of(const PackingTask& task, const std::vector<AlikeShapes>& kinds,
                                      double gap) {
  std::vector<std::vector<Row>> all;
  for (const AlikeShapes& kind : kinds) {
    std::vector<Row> rows = RowMaker(task, kind, gap).rows();
    if (!rows.empty()) {
      all.push_back(std::move(rows));
    }
  }
  const auto area = [](const std::vector<Row>& rows) {
    double sum = 0.0;
    for (const Row& row : rows) {
      sum += row.whole.area;
    }
    return sum;
  };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return area(a) > area(b); });
  return all;
}

/// The shapes with these rows of them as one; empty where they need more pages.
std::vector<Packed> packed_with(const PackingTask& task, std::span<const std::vector<Row>> kinds,
                                std::size_t most_pages, const Context& context) {
  PackingTask reduced = task;
  reduced.shapes.clear();
  reduced.group.clear();
  std::vector<bool> in_row(task.shapes.size(), false);
  std::vector<const Row*> rows;
  for (const std::vector<Row>& kind : kinds) {
    for (const Row& row : kind) {
      rows.push_back(&row);
      reduced.shapes.push_back(row.whole);
      reduced.group.push_back(task.group[row.shapes.front()]);
      for (const std::uint32_t shape : row.shapes) {
        in_row[shape] = true;
      }
    }
  }
  std::vector<std::uint32_t> single;
  for (std::uint32_t i = 0; i < task.shapes.size(); ++i) {
    if (!in_row[i]) {
      single.push_back(i);
      reduced.shapes.push_back(task.shapes[i]);
      reduced.group.push_back(task.group[i]);
    }
  }
  std::vector<Packed> packed = searched(reduced, most_pages, context);
  if (pages_of(packed) > most_pages) {
    return {};
  }
  spread_out(reduced, context, packed);
  std::vector<Packed> result(task.shapes.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Rigid whole{packed[r].turn.cosine, packed[r].turn.sine, packed[r].shift};
    for (std::size_t i = 0; i < rows[r]->shapes.size(); ++i) {
      const Rigid place = whole * rows[r]->places[i];
      result[rows[r]->shapes[i]] = {packed[r].page, {place.cosine, place.sine}, place.shift};
    }
  }
  for (std::size_t i = 0; i < single.size(); ++i) {
    result[single[i]] = packed[rows.size() + i];
  }
  return result;
}

}  // namespace

std::size_t rough_page_count(const PackingTask& task, const Context& context) {
  return task.shapes.empty() ? 0 : PackingSearch(task, rough_detail, context).rough_page_count();
}

std::vector<Packed> pack(const PackingTask& task, const Context& context) {
  return pack_in_rows(task, {}, context);
}

std::vector<Packed> pack_in_rows(const PackingTask& task, const std::vector<AlikeShapes>& kinds,
                                 const Context& context) {
  if (task.shapes.empty()) {
    return {};
  }
  std::vector<Packed> plain = searched(task, 1, context);
  const std::size_t pages = pages_of(plain);
  for (const double spare : spare_mm) {
    const std::vector<std::vector<Row>> rows = rows_of(task, kinds, task.gap + spare);
    for (std::size_t given_up = 0; given_up < std::min(rows.size(), most_given_up) && !context.out_of_time();
         ++given_up) {
      std::vector<Packed> packed = packed_with(task, std::span(rows).subspan(given_up), pages, context);
      if (!packed.empty()) {
        return packed;
      }
      if (spare != spare_mm.back()) {
        break;  // all kinds in narrower rows are better than some in wide ones
      }
    }
  }
  spread_out(task, context, plain);
  return plain;
}

}  // namespace ridgecraft::export_
