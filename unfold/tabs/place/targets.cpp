// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/targets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/boxes.hpp"
#include "unfold/tabs/place/sites.hpp"

namespace ridgecraft::unfold {

namespace {

/// More folds behind one tab are hardly ever all there.
constexpr std::size_t most_folds_behind = 4;

class TargetFinder {
 public:
  TargetFinder(const mesh::Surface& surface, const prepare::Panels& panels, const TabOptions& options)
      : surface_(surface), panels_(panels), options_(options) {}

  /// Sides of the panel behind c's twin that a tab on c might run over, in the frame of tab shapes.
  [[nodiscard]] std::vector<Obstacle> outline(CornerId c) const {
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

  /// What lies behind a tab on c, of the patch, as long as it is bent by no more than a tab follows.
  struct Chain {
    std::vector<Obstacle> outline;      ///< in the frame of tab shapes
    std::vector<std::uint32_t> across;  ///< sides of the patch that lie inside it, one of each
  };
  [[nodiscard]] Chain chain(const Patch& patch, std::uint32_t side) const {
    Chain result;
    const std::uint32_t first = patch.twin[side];
    const ConvexShape widest = widest_tab(patch.length[side], options_);
    if (first == nothing || widest.empty()) {
      return result;
    }
    struct Behind {
      std::uint32_t face;
      Rigid place;
      double bend;
    };
    // The face behind lies over the base, which runs from the start of its side to its end.
    const Triangle& t = patch.shape[first / 3];
    const Vec2 from = t[first % 3];
    const Vec2 along = (t[(first % 3 + 1) % 3] - from) / patch.length[side];
    const Rigid placed = Rigid{along.x, along.y, from}.inverse();
    std::vector<Behind> behind{{first / 3, placed, 0.0}};
    for (std::size_t i = 0; i < behind.size(); ++i) {
      const auto [face, place, bend] = behind[i];
      for (std::uint32_t s = 3 * face; s < 3 * face + 3; ++s) {
        if (s == first) {
          continue;
        }
        const ConvexShape edge{place(patch.shape[face][s % 3]), place(patch.shape[face][(s % 3 + 1) % 3])};
        if (!meet(edge.box(), widest.box()) || apart(widest, edge, -just_touching_mm)) {
          continue;
        }
        const std::uint32_t twin = patch.twin[s];
        const bool frozen = twin != nothing && patch.frozen[s] != 0;
        const double beyond = bend + (frozen ? 0.0 : std::abs(patch.fold_angle[s]));
        if (twin == nothing || beyond > most_bend_of_tab) {
          result.outline.push_back({edge, Obstacle::Kind::target_edge});
          continue;
        }
        if (!frozen) {
          result.across.push_back(std::min(s, twin));
        }
        if (std::none_of(behind.begin(), behind.end(), [&](const Behind& b) { return b.face == twin / 3; })) {
          behind.push_back({twin / 3, place * patch.across[s], beyond});
        }
      }
    }
    std::sort(result.across.begin(), result.across.end());
    result.across.erase(std::unique(result.across.begin(), result.across.end()), result.across.end());
    return result;
  }

  [[nodiscard]] ConvexShape largest(CornerId c, const std::vector<Obstacle>& outline) const {
    const double size = surface_.length(surface_.edge(c));
    return largest_tab({0.0, size, size}, outline, options_, TabNeed::usable);
  }

  [[nodiscard]] bool leads_out(CornerId c) const {
    const FaceId g = surface_.neighbor(c);
    return !g.valid() || panels_.panel[g] != panels_.panel[mesh::face_of(c)];
  }

  [[nodiscard]] double panel_area(FaceId f) const {
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
  targets.across.resize(sides);
  targets.seam.assign(sides, 0);
  for (std::uint32_t side = 0; side < sides; ++side) {
    const CornerId c = mesh::corner(patch.face[side / 3], side % 3);
    if (surface.is_border(surface.edge(c)) || !finder.leads_out(c)) {
      continue;
    }
    targets.outline[side] = finder.outline(c);
    targets.largest[side] = finder.largest(c, targets.outline[side]);
    if (targets.largest[side].empty() && options.inside_target) {
      TargetFinder::Chain chain = finder.chain(patch, side);
      if (!chain.across.empty() && chain.across.size() <= most_folds_behind) {
        targets.largest[side] = finder.largest(c, chain.outline);
        if (!targets.largest[side].empty()) {
          targets.outline[side] = std::move(chain.outline);
          targets.across[side] = std::move(chain.across);
        }
      }
    }
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
