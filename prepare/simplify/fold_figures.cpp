// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/fold_figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "prepare/prepared/panels.hpp"
#include "prepare/simplify/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Vertices are off the planes of walls by no more than this share of the diagonal.
constexpr double in_plane = 2e-5;

class WallsAtEdges {
 public:
  WallsAtEdges(const mesh::Surface& surface, const Walls& walls)
      : surface_(surface), walls_(walls), tolerance_(in_plane * surface.bounds().diagonal()) {}

  /// Whether no point near an edge is in all walls at its ends.
  [[nodiscard]] bool keep_apart(EdgeId e) const {
    const CornerId c = surface_.sides(e)[0];
    const VertexId v = surface_.vertex(c);
    const VertexId w = surface_.vertex(mesh::next(c));
    std::vector<std::uint32_t> around;
    for (const VertexId end : {v, w}) {
      for (const CornerId at : surface_.corners_at(end)) {
        const std::uint32_t wall = walls_.wall(mesh::face_of(at).value());
        if (wall != Walls::none) {
          around.push_back(wall);
        }
      }
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    const Vec3 middle = 0.5 * (surface_.point(v) + surface_.point(w));
    Meeting meeting(middle);
    for (const std::uint32_t wall : around) {
      meeting.add(walls_.walls[wall].normal, walls_.walls[wall].offset);
    }
    return length(meeting.place() - middle) > surface_.length(e) ||
           std::any_of(around.begin(), around.end(), [&](std::uint32_t wall) {
             return std::abs(walls_.walls[wall].height(meeting.place())) > tolerance_;
           });
  }

 private:
  const mesh::Surface& surface_;
  const Walls& walls_;
  double tolerance_;
};

}  // namespace

FoldFigures fold_figures(const mesh::Surface& surface, const SimplifyOptions& options) {
  const Panels panels = find_panels(surface);
  const Walls walls = find_walls(surface, panels, options.short_edge_mm);
  const WallsAtEdges at_edges(surface, walls);
  FoldFigures figures;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (!d.valid() || panels.panel[mesh::face_of(c)] == panels.panel[mesh::face_of(d)] ||
        std::abs(surface.fold_angle(e)) < options.hidden_fold_angle) {
      continue;
    }
    ++figures.folds;
    const double length = surface.length(e);
    if (length < options.short_edge_mm) {
      const bool across = at_edges.keep_apart(e);
      figures.brief += across ? 0U : 1U;
      figures.tiny += length < (across ? 0.5 : 1.0) * options.tiny_edge_mm ? 1U : 0U;
    }
  }
  return figures;
}

}  // namespace ridgecraft::prepare
