// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/thin_out.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/repair/loose_faces.hpp"
#include "prepare/collapses/quick_collapses.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/shares/symmetric_share.hpp"
#include "prepare/shares/whole.hpp"
#include "prepare/simplify/many_faces.hpp"
#include "prepare/walls/fold_figures.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Flat regions of this many times the short edge's square stay flat: the foot of a statue.
constexpr double large_flat = 1.0;

/// Flat regions as if they were walls.
Walls large_regions(const mesh::Surface& surface, const Panels& panels, double short_edge_mm) {
  Walls result;
  result.walls.emplace_back();
  result.of_face.assign(surface.face_count(), Walls::none);
  for (const std::vector<FaceId>& faces : panels.faces) {
    double area = 0.0;
    for (const FaceId f : faces) {
      area += surface.area(f);
    }
    if (area >= large_flat * short_edge_mm * short_edge_mm) {
      for (const FaceId f : faces) {
        result.of_face[f.value()] = 0;
      }
    }
  }
  return result;
}

}  // namespace

bool is_dense(const mesh::Surface& surface, const SimplifyOptions& options) {
  return surface.face_count() > std::max(very_many_faces, options.most_faces) &&
         surface.face_count() > 2 * quick * careless_faces(surface, options.short_edge_mm);
}

std::optional<Dense> thin_out(mesh::Model& model, double symmetric_within, const SimplifyOptions& options,
                              const Context& context) {
  const std::size_t aim = quick * careless_faces(model.surface, options.short_edge_mm);
  const double largest_mm = options.largest_deviation * model.surface.bounds().largest_extent();
  mesh::LooseFaces faces;
  Dense dense;
  {
    const Panels panels = find_panels(model.surface);
    context.check();
    const Walls walls = find_walls(model.surface, panels, options.short_edge_mm, Slats::are_walls);
    if (!walls.walls.empty()) {
      return std::nullopt;
    }
    context.check();
    dense.short_edges_share = fold_figures(model.surface, panels, walls, options).brief_share();
    const mesh::LooseFaces all = mesh::take_apart(model);
    const SymmetricShare share = symmetric_share(model, symmetric_within, context);
    dense.unevenness_mm = share.deviation;
    const Walls flat = walls_of(large_regions(model.surface, panels, options.short_edge_mm), share);
    faces = whole(collapsed(share, quick_collapses(share.faces, share.points, flat, aim,
                                                   quick_share * largest_mm, context)),
                  all);
  }
  dense.before = std::move(model.surface);
  mesh::put_together(model, std::move(faces));
  return dense;
}

}  // namespace ridgecraft::prepare
