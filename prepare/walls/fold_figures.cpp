// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/walls/fold_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Vertices are off the planes of walls by no more than this share of the diagonal.
constexpr double in_plane = 2e-5;
/// Edges of so many times the short edge have room for a tab of full width and a number.
constexpr double roomy = 2.5;
/// Cosine of the angle (5 degrees) within which walls count as parallel.
constexpr double parallel = 0.996;

class WallsAtEdges {
 public:
  WallsAtEdges(const mesh::Surface& surface, const Walls& walls)
      : surface_(surface), walls_(walls), tolerance_(in_plane * surface.bounds().diagonal()) {}

  /// Whether no point near an edge is in all walls at its ends.
  [[nodiscard]] bool keep_apart(EdgeId e) const {
    const auto [v, w] = ends(e);
    std::vector<std::uint32_t> around = walls_at(v);
    const std::vector<std::uint32_t> at_w = walls_at(w);
    around.insert(around.end(), at_w.begin(), at_w.end());
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

  /// Whether an edge goes from one wall to another one that is parallel.
  [[nodiscard]] bool across_plate(EdgeId e) const {
    const auto [v, w] = ends(e);
    for (const std::uint32_t a : walls_at(v)) {
      for (const std::uint32_t b : walls_at(w)) {
        if (a != b && std::abs(dot(walls_.walls[a].normal, walls_.walls[b].normal)) > parallel) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] std::array<VertexId, 2> ends(EdgeId e) const {
    const CornerId c = surface_.sides(e)[0];
    return {surface_.vertex(c), surface_.vertex(mesh::next(c))};
  }
  [[nodiscard]] std::vector<std::uint32_t> walls_at(VertexId v) const {
    std::vector<std::uint32_t> walls;
    for (const CornerId at : surface_.corners_at(v)) {
      const std::uint32_t wall = walls_.wall(mesh::face_of(at).value());
      if (wall != Walls::none) {
        walls.push_back(wall);
      }
    }
    return walls;
  }

  const mesh::Surface& surface_;
  const Walls& walls_;
  double tolerance_;
};

}  // namespace

FoldFigures fold_figures(const mesh::Surface& surface, const SimplifyOptions& options) {
  const Panels panels = find_panels(surface);
  return fold_figures(surface, panels, find_walls(surface, panels, options.short_edge_mm, Slats::are_none),
                      options);
}

FoldFigures fold_figures(const mesh::Surface& surface, const Panels& panels, const Walls& walls,
                         const SimplifyOptions& options) {
  const WallsAtEdges at_edges(surface, walls);
  FoldFigures figures;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (!d.valid() || panels.panel[mesh::face_of(c)] == panels.panel[mesh::face_of(d)]) {
      continue;
    }
    const double length = surface.length(e);
    ++figures.edges;
    figures.close += length < roomy * options.short_edge_mm ? 1U : 0U;
    figures.length += length;
    figures.cramped += length < options.short_edge_mm ? length : 0.0;
    if (std::abs(surface.fold_angle(e)) < options.hidden_fold_angle) {
      continue;
    }
    ++figures.folds;
    if (length < options.short_edge_mm) {
      figures.brief += at_edges.keep_apart(e) ? 0U : 1U;
      if (length < options.tiny_edge_mm) {
        figures.tiny += length < 0.5 * options.tiny_edge_mm || !at_edges.across_plate(e) ? 1U : 0U;
      }
    }
  }
  return figures;
}

std::vector<bool> too_fine_components(const mesh::Surface& surface, const SimplifyOptions& options) {
  std::vector<std::vector<FaceId>> faces(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces[surface.component(f).value()].push_back(f);
  }
  std::vector<bool> result;
  for (const std::vector<FaceId>& component : faces) {
    const FoldFigures figures = component.size() == surface.face_count()
                                    ? fold_figures(surface, options)
                                    : fold_figures(mesh::faces_alone(surface, component), options);
    result.push_back(figures.brief_share() > options.short_edge_share ||
                     component.size() > options.most_faces);
  }
  return result;
}

}  // namespace ridgecraft::prepare
