// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/layout.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/geometry.hpp"
#include "export/export.hpp"
#include "export/packing/packing.hpp"
#include "export/packing/packing_shape.hpp"
#include "export/sheet/pages.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::export_ {
namespace {

using unfold::Nets;

std::vector<PackingShape> shapes_of(const Nets& nets) {
  std::vector<std::vector<std::vector<Vec2>>> convex(nets.pieces.size());
  for (const FaceId f : ids<FaceId>(nets.piece.size())) {
    const auto& corners = nets.flat[f];
    convex[nets.piece[f].value()].emplace_back(corners.begin(), corners.end());
  }
  for (const unfold::Tab& tab : nets.tabs) {
    convex[nets.piece[mesh::face_of(tab.side)].value()].push_back(tab.slit ? convex_hull(tab.polygon)
                                                                           : tab.polygon);
  }
  std::vector<PackingShape> shapes;
  for (auto& polygons : convex) {
    shapes.push_back(packing_shape(std::move(polygons)));
  }
  return shapes;
}

/// The smallest rectangle around the hull: one side of it lies along a side of the hull (Freeman and Shapira
/// 1975).
Vec2 smallest_rectangle(const std::vector<Vec2>& hull) {
  Vec2 smallest = extent(hull, {});
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 side = hull[(i + 1) % hull.size()] - hull[i];
    const double size = length(side);
    const Vec2 box = extent(hull, {side.x / size, -side.y / size});
    if (box.x * box.y < smallest.x * smallest.y) {
      smallest = box;
    }
  }
  return smallest;
}

/// Turns in which a line of a net runs along the grain, or nearly so, which leaves the packer some choice.
std::vector<Turn> turns_along_grain(Vec2 line, const Paper& paper) {
  constexpr double most = grain_tolerance_degrees;
  constexpr std::array<double, 7> degrees{0.0, most / 3.0, -most / 3.0, most / 1.5, -most / 1.5, most, -most};
  const Vec2 grain = grain_direction(paper);
  const Vec2 straight{dot(line, grain), cross(line, grain)};
  std::vector<Turn> turns;
  for (const double more : degrees) {
    const double angle = more * std::numbers::pi / 180.0;
    const Vec2 by{elementary::cos(angle), elementary::sin(angle)};
    const Turn turn{straight.x * by.x - straight.y * by.y, straight.y * by.x + straight.x * by.y};
    turns.insert(turns.end(), {turn, {-turn.cosine, -turn.sine}});
  }
  return turns;
}

}  // namespace

PackingTask packing_task(const Nets& nets, const Paper& paper,
                         const IdVector<PieceId, Vec2>& fold_directions) {
  PackingTask task;
  task.shapes = shapes_of(nets);
  task.area = piece_area(paper);
  task.gap = paper.gap;
  task.search_work = paper.packing == PackingEffort::good ? long_search_work : usual_search_work;
  for (const unfold::Piece& piece : nets.pieces) {
    task.group.push_back(piece.parts.empty() ? 0 : piece.parts.front().value());
  }
  for (const PieceId piece : ids<PieceId>(follows_grain(paper, fold_directions) ? nets.pieces.size() : 0)) {
    if (const Vec2 line = fold_directions[piece]; line != Vec2{}) {
      task.shapes[piece.value()].along_grain = turns_along_grain(line, paper);
    }
  }
  return task;
}

PackingTask part_of(const PackingTask& task, const std::vector<std::uint32_t>& shapes) {
  PackingTask part;
  part.area = task.area;
  part.gap = task.gap;
  part.search_work = task.search_work;
  for (const std::uint32_t shape : shapes) {
    part.shapes.push_back(task.shapes[shape]);
    part.group.push_back(task.group[shape]);
  }
  return part;
}

void check_fit(const Nets& nets, const PackingTask& task, const Paper& paper) {
  const Vec2 area = task.area;
  for (const PieceId p : ids<PieceId>(task.shapes.size())) {
    const auto& hull = task.shapes[p.value()].hull;
    if (promising_turns(hull, area, 1).empty()) {
      const Vec2 size = smallest_rectangle(hull);
      throw Error(
          ErrorKind::no_nets,
          fmt::format("piece {} of {:.1f} x {:.1f} mm doesn't fit the {:.1f} x {:.1f} mm that paper of "
                      "{:.1f} x {:.1f} mm leaves for pieces",
                      nets.pieces[p].name, size.x, size.y, area.x, area.y, paper.size.x, paper.size.y));
    }
  }
}

std::vector<std::vector<Vec2>> placed(const PackingShape& shape, const Rigid& placement) {
  std::vector<std::vector<Vec2>> polygons = shape.convex;
  for (auto& polygon : polygons) {
    for (Vec2& corner : polygon) {
      corner = placement(corner);
    }
  }
  return polygons;
}

namespace {

// Pieces onto pages: shapes for the packer, its answer as placements, and an exact check of it.

/// The packer keeps its promise by construction; should it ever not, the offending piece gets a page of its
/// own.
void separate_collisions(const std::vector<PackingShape>& shapes, Pages& pages) {
  std::vector<std::vector<OwnedPolygon>> on_page(pages.count);
  for (const PieceId p : ids<PieceId>(shapes.size())) {
    const Placement& placement = pages.placements[p];
    for (auto& polygon : placed(shapes[p.value()], placement)) {
      on_page[placement.page.value()].push_back({p.value(), std::move(polygon)});
    }
  }
  std::vector<bool> moved(shapes.size());
  for (const auto& polygons : on_page) {
    const auto pairs = too_near(polygons, pages.paper.gap - gap_rounding_mm);
    RIDGECRAFT_ASSERT(pairs.empty());
    for (const auto& [first, second] : pairs) {
      if (!moved[first] && !moved[second]) {
        pages.placements[PieceId(second)].page = PageId(pages.count++);
        moved[second] = true;
      }
    }
  }
}

/// Equal pieces as the packer sees them.
std::vector<AlikeShapes> alike_shapes(const Nets& nets) {
  std::vector<AlikeShapes> kinds;
  for (const std::vector<unfold::EqualPiece>& equal : nets.equal) {
    AlikeShapes& kind = kinds.emplace_back();
    for (const unfold::EqualPiece& piece : equal) {
      kind.shapes.push_back(piece.piece.value());
      kind.motion.push_back(piece.motion.inverse());
      kind.mirrored.push_back(piece.mirrored);
    }
  }
  return kinds;
}

/// The shapes of each sort; all, where there are no sorts.
std::vector<std::vector<std::uint32_t>> sorts_of(const IdVector<PieceId, std::uint32_t>& sort,
                                                 std::size_t count) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> of_sort;
  for (std::uint32_t i = 0; i < count; ++i) {
    of_sort[sort.empty() ? 0 : sort[PieceId(i)]].push_back(i);
  }
  std::vector<std::vector<std::uint32_t>> result;
  for (auto& [value, shapes] : of_sort) {
    result.push_back(std::move(shapes));
  }
  return result;
}

/// Kinds of which there is more than one among these shapes (ascending), by their new numbers.
std::vector<AlikeShapes> part_of(const std::vector<AlikeShapes>& kinds,
                                 const std::vector<std::uint32_t>& shapes) {
  std::vector<AlikeShapes> result;
  for (const AlikeShapes& kind : kinds) {
    AlikeShapes part;
    for (std::size_t i = 0; i < kind.shapes.size(); ++i) {
      const auto at = std::lower_bound(shapes.begin(), shapes.end(), kind.shapes[i]);
      if (at != shapes.end() && *at == kind.shapes[i]) {
        part.shapes.push_back(static_cast<std::uint32_t>(at - shapes.begin()));
        part.motion.push_back(kind.motion[i]);
        part.mirrored.push_back(kind.mirrored[i]);
      }
    }
    if (part.shapes.size() > 1) {
      result.push_back(std::move(part));
    }
  }
  return result;
}

}  // namespace

Pages layout(const Nets& nets, const Paper& paper, const Context& context, const LayoutRules& rules) {
  check_paper(paper);
  const PackingTask task = packing_task(nets, paper, rules.fold_directions);
  const bool along_grain = follows_grain(paper, rules.fold_directions);
  check_fit(nets, task, paper);
  Pages pages;
  pages.paper = paper;
  pages.placements = IdVector<PieceId, Placement>(task.shapes.size());
  const Vec2 corner = piece_box(paper).low;
  const std::vector<AlikeShapes> alike = alike_shapes(nets);
  for (const std::vector<std::uint32_t>& shapes : sorts_of(rules.sort, task.shapes.size())) {
    const std::size_t first_page = pages.count;
    const PackingTask part = part_of(task, shapes);
    const std::vector<Packed> packed =
        along_grain ? pack(part, context) : pack_in_rows(part, part_of(alike, shapes), context);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      Placement& placement = pages.placements[PieceId(shapes[i])];
      placement.page = PageId(first_page + packed[i].page);
      placement.cosine = packed[i].turn.cosine;
      placement.sine = packed[i].turn.sine;
      placement.shift = packed[i].shift + corner;
      pages.count = std::max<std::size_t>(pages.count, first_page + packed[i].page + 1);
    }
  }
  separate_collisions(task.shapes, pages);
  return pages;
}

std::optional<double> scale_that_saves_a_page(const Nets& nets, const Pages& pages, const Context& context) {
  // The smallest first: where it doesn't do, the others needn't be tried.
  constexpr std::array<double, 3> fractions{0.87, 0.9, 0.93};
  /// Pieces are tried so many times as large as they would be: at another size others come out, and less
  /// fits.
  constexpr double reserve = 1.04;
  /// Nobody gets shapes closer than this share of their pages.
  constexpr double densest = 0.85;
  std::optional<double> best;
  if (pages.count < 2) {
    return best;
  }
  PackingTask task = packing_task(nets, pages.paper);
  double used = 0.0;
  for (const PackingShape& shape : task.shapes) {
    used += shape.area;
  }
  const Vec2 area = task.area;
  for (const double fraction : fractions) {
    // Smaller pieces on this paper are these pieces on larger paper.
    task.area = area / (reserve * fraction);
    task.gap = pages.paper.gap / (reserve * fraction);
    const double room = static_cast<double>(pages.count - 1) * task.area.x * task.area.y;
    if (used > densest * room || context.out_of_time() || rough_page_count(task, context) >= pages.count) {
      return best;
    }
    best = fraction;
  }
  return best;
}

}  // namespace ridgecraft::export_
