// SPDX-License-Identifier: GPL-3.0-or-later
// A model ready for paper, and what was done to it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/id.hpp"
#include "base/vector.hpp"
#include "mesh/look/look.hpp"
#include "mesh/look/relief.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/rolls.hpp"

namespace ridgecraft::prepare {

/// Whether they become one skin.
enum class Bodies { unite, keep };

/// For the summary. Components are those of the surface, faces its triangles.
struct SkinReport {
  std::size_t united = 0;         ///< components that took part
  std::size_t united_into = 0;    ///< components that became of them
  std::size_t faces_hidden = 0;   ///< faces that nothing is left of: they lay inside others
  double hidden_fraction = 0.0;   ///< of the area of these components: how much lay inside others
  std::size_t left_crossing = 0;  ///< components that stay as they were, since no sound skin was found
  std::size_t gaps_closed = 0;    ///< corners that ended just before another body, and touch it now
  std::size_t unseen = 0;         ///< components that were left out, since nobody sees any of them
  std::size_t rims_closed = 0;    ///< flat openings that were closed for it and stay closed
};

/// One of several bodies that are copies of the first of them: face i here is its face i, moved. Where it is
/// mirrored, too, corners run the other way round: corner k of the first one's face is corner (3 - k) % 3.
struct TwinBody {
  bool mirrored = false;
  std::vector<FaceId> faces;  ///< a whole component
};

/// Kinds of bodies that there are several of; the first of each kind is the one that the others are copies
/// of, with its faces ascending.
using TwinBodies = std::vector<std::vector<TwinBody>>;

/// The corner of `image`, a copy of a face, that is its corner k.
[[nodiscard]] constexpr CornerId twin_corner(FaceId image, unsigned k, bool mirrored) {
  return mesh::corner(image, mirrored ? (3 - k) % 3 : k);
}
/// The same for the side that runs from corner k on.
[[nodiscard]] constexpr CornerId twin_side(FaceId image, unsigned k, bool mirrored) {
  return mesh::corner(image, mirrored ? 2 - k : k);
}

/// What simplification did, for the summary. Lengths in mm.
struct SimplifyReport {
  std::size_t faces_before = 0;
  std::size_t faces_after = 0;
  std::size_t features_removed = 0;  ///< automatic: small holes closed and small knobs cut off flat walls
  /// automatic: lines between narrow faces side by side that went, of arches, columns and rounded corners
  std::size_t rulings_removed = 0;
  double deviation_mm = 0.0;  ///< greatest measured distance between the old and the new surface, both ways
  /// Its sides were mirror images only nearly, off by so much, and are so exactly now; 0 where they were, or
  /// where the model isn't symmetric.
  double asymmetry_mm = 0.0;
  bool at_its_size = false;  ///< some faces went at the model's size, not just before bodies were united
};

/// Why a model isn't of the size that it has by default.
enum class SizeReason {
  none,   ///< it is
  folds,  ///< too many folds would be too short, or faces too narrow
  shape,  ///< simplification would move its surface so far that it is seen
  pages,  ///< it would take too many pages
};

/// The way of a point from the model to its place at the size that it has on paper.
struct ToSize {
  double factor = 1.0;
  Vec3 shift;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return factor * p + shift; }
};

/// A model ready for paper.
struct Prepared {
  mesh::Model model;  ///< in mm, centred on the origin; not turned, not mirrored
  Panels panels;      ///< flat regions of model.surface; those that no page holds in cells that pages hold
  Rolls rolls;        ///< bands of model.surface that are rolled
  TwinBodies twins;   ///< components that are equal; they are exact copies of each other
  double mm_per_unit = 1.0;
  ToSize from_model;  ///< points that nothing else moved
  /// What the model looked like before anything was done to its faces, in the place of `model`; null where it
  /// has no colours, or nobody wants them.
  std::shared_ptr<const mesh::Look> look;
  /// Sharp edges of the model as it was read that its faces have no fold for, as lines on its faces,
  /// ascending by face; empty where nobody wants them.
  std::vector<mesh::FaceLine> lost_edges;
  SizeReason size_reason = SizeReason::none;
  /// Where nobody could fold it at this size: the smallest largest extent, mm, at which somebody can; none if
  /// there is none that makes sense.
  std::optional<double> smallest_size_mm;
  Work work;                     ///< that is to be expected of it
  double sliver_fraction = 0.0;  ///< of the faces, narrower than sliver_mm
  SimplifyReport simplified;
  /// Components that were a part of others and are glued onto flat faces of these, open at their bases.
  std::size_t attached = 0;
  std::size_t loose = 0;           ///< components that were left out, as simplification took what held them
  std::size_t divided_panels = 0;  ///< flat regions that are in cells
};

/// Components that were left out.
struct Details {
  std::size_t small = 0;  ///< too small or too narrow to be folded and held
  std::size_t flat = 0;   ///< flat, and lying on another one
  std::size_t low = 0;    ///< bodies that hardly stand out of another one
  std::size_t loose = 0;  ///< what held them was left out

  [[nodiscard]] std::size_t count() const { return small + flat + low + loose; }
  Details& operator+=(const Details& other) {
    small += other.small;
    flat += other.flat;
    low += other.low;
    loose += other.loose;
    return *this;
  }
};

/// Thin walls that became sheets.
struct ThinWallReport {
  std::size_t walls = 0;      ///< components
  double thickness_mm = 0.0;  ///< of the thickest one, on paper as far as its size is known
};

/// What was done to bodies before they had their size.
struct CleanupReport {
  ThinWallReport thin_walls;
  Details left_out;
};

/// Pages of a printable area that pieces of so much area fill.
[[nodiscard]] double pages_filled(double area, Vec2 printable);

/// About how many pages the model takes: flat regions larger than half a page one each, the others by their
/// area. O(n).
[[nodiscard]] double expected_pages(const Prepared& prepared, Vec2 printable);

/// Whether a person sees that a model was simplified.
enum class SeenMove {
  none,
  of_size,       ///< it moved by 3 % of its largest extent or more
  of_thickness,  ///< it moved by a tenth of its smallest extent or more, which a thin model looks otherwise
                 ///< by
};

/// `moved_mm`: how far a surface with these bounds (mm) moved at most. Of what is flat, only outlines have
/// moved: it has no thickness.
[[nodiscard]] SeenMove seen_move(double moved_mm, const Box3& bounds);
/// How far simplification may move the surface of a body with these bounds, so that it doesn't become another
/// thing: a tenth of its middle extent.
[[nodiscard]] double move_allowed(const Box3& bounds);

/// A hundred metres of paper model; beyond that a slip of the unit is certain, and the model is refused when
/// it is brought to its size.
inline constexpr double largest_size_mm = 1e5;

}  // namespace ridgecraft::prepare
