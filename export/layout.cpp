// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces onto pages: shapes for the packer, its answer as placements, and an exact check of it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "export/export.hpp"
#include "export/packing/clearance.hpp"
#include "export/packing/packing.hpp"
#include "export/piece_shapes.hpp"

namespace ridgecraft::export_ {
namespace {

using unfold::Nets;

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

Pages layout(const Nets& nets, const Paper& paper, const Context& context,
             const IdVector<PieceId, std::uint32_t>& sort, const IdVector<PieceId, Vec2>& fold_directions) {
  check_paper(paper);
  const PackingTask task = packing_task(nets, paper, fold_directions);
  const bool heeds_grain = paper.grain != Grain::any && !fold_directions.empty();
  check_fit(nets, task, paper);
  Pages pages;
  pages.paper = paper;
  pages.placements = IdVector<PieceId, Placement>(task.shapes.size());
  const Vec2 corner = piece_box(paper).low;
  const std::vector<AlikeShapes> alike = alike_shapes(nets);
  for (const std::vector<std::uint32_t>& shapes : sorts_of(sort, task.shapes.size())) {
    const std::size_t first_page = pages.count;
    const PackingTask part = part_of(task, shapes);
    const std::vector<Packed> packed =
        heeds_grain ? pack(part, context) : pack_in_rows(part, part_of(alike, shapes), context);
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

std::optional<double> share_that_saves_a_page(const Nets& nets, const Pages& pages, const Context& context) {
  // The smallest first: where it doesn't do, the others needn't be tried.
  constexpr std::array<double, 3> shares{0.87, 0.9, 0.93};
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
  for (const double share : shares) {
    // Smaller pieces on this paper are these pieces on larger paper.
    task.area = area / (reserve * share);
    task.gap = pages.paper.gap / (reserve * share);
    const double room = static_cast<double>(pages.count - 1) * task.area.x * task.area.y;
    if (used > densest * room || context.out_of_time() || rough_page_count(task, context) >= pages.count) {
      return best;
    }
    best = share;
  }
  return best;
}

}  // namespace ridgecraft::export_
