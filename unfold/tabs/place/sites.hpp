// SPDX-License-Identifier: GPL-3.0-or-later
// How much paper a tab hangs on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {

/// Paper that a tab hangs on must reach so far behind its base, mm, along half of it: less tears off, and is
/// nothing to press on.
inline constexpr double least_paper_mm = 2.0;

/// Does enough paper lie behind a cut for a tab to hang on it? Looks from nine places on the edge straight
/// into the piece, over folds, until a cut. O(faces within least_paper_mm).
[[nodiscard]] bool enough_paper_behind(const mesh::Surface& surface, const Nets& nets, CornerId side);

// Where bodies stand on others: flat openings that lie on another body's face.

/// A side of a base: a border edge that lies on a face of another component.
struct BaseSide {
  CornerId side;
  /// The whole opening, laid flat over the edge in the frame of tab shapes: where a tab lies when it is
  /// folded inwards. The edge is its first side.
  std::vector<Vec2> opening;
};

/// Openings that are flat and lie on parallel faces of other components, none farther from them than
/// mesh::touching_mm; of their sides those whose middle does, and whose face rises from there by 30 degrees:
/// a sheet that lies on a face has none. Openings of more than 1000 sides have none either. O(n log n), and
/// the square of an opening's sides. Throws Error(interrupted).
[[nodiscard]] std::vector<BaseSide> find_open_bases(const mesh::Surface& surface, const Context& context);

// The two sides of every join as places for a tab: where they lie, what stands around them, what they are
// glued behind.

/// A rigid frame of the plane: local (x, y) is the point origin + x * axis + y * (axis turned left). No
/// Rigid, whose inverse turns before it shifts: here points of the x axis come in with y = 0 but for one
/// rounding.
struct Frame {
  Vec2 origin;
  Vec2 axis{1.0, 0.0};

  [[nodiscard]] Vec2 out(Vec2 p) const { return origin + p.x * axis + p.y * perpendicular(axis); }
  [[nodiscard]] Vec2 in(Vec2 p) const {
    return {dot(p - origin, axis), dot(p - origin, perpendicular(axis))};
  }
  [[nodiscard]] ConvexShape out(const ConvexShape& shape) const;
  [[nodiscard]] ConvexShape in(const ConvexShape& shape) const;
};

/// One side of a join, as a place for its tab. Site 2 j and 2 j + 1 are the sides of join j.
struct TabSite {
  CornerId side;
  PieceId piece;
  PieceId target_piece;
  std::uint32_t target_region = 0;       ///< of FlatRegions: the tab is glued behind it
  Frame own;                             ///< of tab shapes, in the piece's plane
  Frame target;                          ///< the same over the target, in the target's plane
  double length = 0.0;                   ///< mm
  double area = 0.0;                     ///< of the flat region that the tab grows from, mm^2
  std::array<std::uint32_t, 2> ends{};   ///< net vertices at (0, 0) and (length, 0)
  bool has_paper = true;                 ///< behind it, for a tab to hang on
  std::vector<Obstacle> obstacles;       ///< in the frame of tab shapes
  std::vector<Obstacle> region_outline;  ///< of the target region alone, near the edge; frame of tab shapes
};

/// Of a site's obstacles the outline of its target.
[[nodiscard]] std::vector<Obstacle> target_outline(const TabSite& site);

/// Is the flat region behind wide enough for a usable tab, whatever is a fold and if nothing else stood in
/// its way? Where one over the whole edge doesn't fit, none on a part of it does.
[[nodiscard]] bool target_allows_usable(const TabSite& site, const TabOptions& options);

/// Faces that lie in one panel and are connected by folds inside it: what a tab may be glued behind as one
/// face.
struct FlatRegions {
  IdVector<FaceId, std::uint32_t> region;      ///< of each face
  std::vector<std::vector<CornerId>> outline;  ///< sides of each region's faces that lead out of it
  std::vector<double> area;                    ///< mm^2
};
[[nodiscard]] FlatRegions flat_regions(const mesh::Surface& surface, const prepare::Panels& panels,
                                       const Nets& nets);

/// The net vertex of each corner (indexed by CornerId): corners that a chain of folds joins around a vertex
/// share one (nets-contract, section 2).
[[nodiscard]] std::vector<std::uint32_t> net_vertices(const mesh::Surface& surface, const Nets& nets);

/// Frame whose x axis runs from the end of a side to its start, so that a tab on it grows away from the face.
[[nodiscard]] Frame tab_frame(const Nets& nets, CornerId side);
/// Frame over the face of `twin`, the other side of the same edge, in which the tab lies as it is glued.
[[nodiscard]] Frame glued_frame(const Nets& nets, CornerId twin);

/// All sites, two for each join, with all faces and target outlines that their tabs might meet. O(n log n).
[[nodiscard]] std::vector<TabSite> find_tab_sites(const mesh::Surface& surface, const prepare::Panels& panels,
                                                  const Nets& nets, const TabOptions& options,
                                                  const Context& context);

/// The borders of all pieces as places for tabs that are glued behind nothing of this model: sites without a
/// target. O(n log n).
[[nodiscard]] std::vector<TabSite> find_border_sites(const mesh::Surface& surface, const Nets& nets,
                                                     const TabOptions& options, const Context& context);

/// Sides of pieces, without what stands around them and what they are glued to. O(n log n).
[[nodiscard]] std::vector<TabSite> bare_sites(const mesh::Surface& surface, const Nets& nets,
                                              const std::vector<CornerId>& sides);

/// Sides of bases as places for tabs that lie within the bases's openings, in their order. O(n log n).
[[nodiscard]] std::vector<TabSite> find_base_sites(const mesh::Surface& surface, const Nets& nets,
                                                   const std::vector<BaseSide>& bases,
                                                   const TabOptions& options, const Context& context);

}  // namespace ridgecraft::unfold
