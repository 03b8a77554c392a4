// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/piece_shapes.hpp"

#include <array>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/error.hpp"
#include "base/geometry.hpp"
#include "export/sheet/fold_directions.hpp"
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
  const bool heeds_grain = paper.grain != Grain::any && !fold_directions.empty();
  for (const PieceId piece : ids<PieceId>(heeds_grain ? nets.pieces.size() : 0)) {
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

}  // namespace ridgecraft::export_
