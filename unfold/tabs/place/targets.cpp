// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/targets.hpp"

#include "base/box_grid.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {

namespace {

class TargetFinder {
 public:
  TargetFinder(const mesh::Surface& surface, const prepare::Panels& panels, const TabOptions& options)
      : surface_(surface), panels_(panels), options_(options) {}

  /// Sides of the panel behind c's twin that a tab on c might run over, in the frame of tab shapes.
  std::vector<Obstacle> outline(CornerId c) const {
    std::vector<Obstacle> result;
    const CornerId twin = surface_.twin(c);
    const ConvexShape widest = widest_tab(surface_.length(surface_.edge(c)), options_);
    const FaceId g = mesh::face_of(twin);
    if (widest.empty() || !options_.inside_target) {
      return result;
    }
    const Vec3 origin = surface_.point(surface_.vertex(twin));
    const Vec3 along = normalized(surface_.point(surface_.vertex(mesh::next(twin))) - origin);
    const Vec3 inward = cross(surface_.normal(g), along);
    const auto flat = [&](CornerId corner) {
      const Vec3 away = surface_.point(surface_.vertex(corner)) - origin;
      return Vec2{dot(away, along), dot(away, inward)};
    };
    if (flat(mesh::previous(twin)).y < least_target_mm) {
      return {no_target(surface_.length(surface_.edge(c)))};
    }
    for (const FaceId f : panels_.faces[panels_.panel[g]]) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId edge = mesh::corner(f, k);
        if (edge == twin || !leads_out(edge)) {
          continue;
        }
        const ConvexShape segment{flat(edge), flat(mesh::next(edge))};
        if (meet(segment.box(), widest.box()) && !apart(widest, segment, 0.0)) {
          result.push_back({segment, Obstacle::Kind::target_edge});
        }
      }
    }
    return result;
  }

  ConvexShape largest(CornerId c, const std::vector<Obstacle>& outline) const {
    const double size = surface_.length(surface_.edge(c));
    return largest_tab({0.0, size, size}, outline, options_, TabNeed::usable);
  }

  bool leads_out(CornerId c) const {
    const FaceId g = surface_.neighbor(c);
    return !g.valid() || panels_.panel[g] != panels_.panel[mesh::face_of(c)];
  }

  double panel_area(FaceId f) const {
    double sum = 0.0;
    for (const FaceId g : panels_.faces[panels_.panel[f]]) {
      sum += surface_.area(g);
    }
    return sum;
  }

 private:
  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const TabOptions& options_;
};

}  // namespace

TabTargets find_tab_targets(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                            const TabOptions& options) {
  const TargetFinder finder(surface, panels, options);
  TabTargets targets;
  const std::size_t sides = patch.twin.size();
  targets.outline.resize(sides);
  targets.largest.resize(sides);
  targets.seam.assign(sides, 0);
  for (std::uint32_t side = 0; side < sides; ++side) {
    const CornerId c = mesh::corner(patch.face[side / 3], side % 3);
    if (surface.is_border(surface.edge(c)) || !finder.leads_out(c)) {
      continue;
    }
    targets.outline[side] = finder.outline(c);
    targets.largest[side] = finder.largest(c, targets.outline[side]);
    if (patch.twin[side] != nothing || targets.largest[side].empty()) {
      continue;
    }
    const CornerId twin = surface.twin(c);
    const double here = finder.panel_area(mesh::face_of(c));
    const double there = finder.panel_area(mesh::face_of(twin));
    const bool first = here != there ? here < there : c < twin;
    targets.seam[side] = first || finder.largest(twin, finder.outline(twin)).empty() ? 1 : 0;
  }
  return targets;
}

}  // namespace ridgecraft::unfold
