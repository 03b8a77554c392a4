// SPDX-License-Identifier: GPL-3.0-or-later
// What unfolding makes: pieces of paper that lie flat without overlap, and how they are joined.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/geometry.hpp"
#include "base/id.hpp"
#include "base/message.hpp"
#include "base/vector.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/edge_constraints.hpp"

namespace ridgecraft::unfold {

/// What becomes of an edge of the surface.
enum class EdgeUse : std::uint8_t {
  fold,    ///< its two faces lie in one piece and share it
  cut,     ///< its two faces are glued together there: exactly one join
  border,  ///< one face only
};

/// Why a piece is a piece of its own. `no_net`: overlap, and that no net exists is proven.
enum class PieceReason { part, page, overlap, no_net, tabs, faces, time, request, component, folding, shape };
/// The words of `reason` in a FOLD file; `folding` is a request there, `no_net` an overlap, `shape` stands
/// among `faces`.
[[nodiscard]] std::string_view name(PieceReason reason);
/// Code of the message that states it of `n` pieces.
[[nodiscard]] std::string_view message_code(PieceReason reason);

/// How a piece can be folded without running through itself (unfold/folding/fold_order.hpp).
enum class FoldWay : std::uint8_t {
  together,      ///< all creases at a time
  leaves_first,  ///< one after the other, from the tips inwards
  middle_first,  ///< one after the other, from the middle outwards
  in_order,      ///< one after the other, in an order of its own
  with_care,     ///< no order was found: some face has to be bent out of the way
};
/// How a net is folded up without one face running through another.
struct FoldOrder {
  FoldWay way = FoldWay::together;
  /// Folds in the order in which they are made, those of one list together: a side of each folded edge.
  std::vector<std::vector<CornerId>> steps;
  /// Where none was found: two faces that were in each other's way where the search came farthest; none
  /// where it had no time.
  std::optional<std::array<FaceId, 2>> in_the_way = {};
};

/// One connected net. Its faces lie in a plane of its own: mm, y up, the printed side (the outside of the
/// model) seen, so each face is counterclockwise.
struct Piece {
  std::string name;           ///< as printed, unique: A, B, ... Z, AA, ...
  std::vector<FaceId> faces;  ///< ascending
  std::vector<PartId> parts;  ///< parts that it has faces of, ascending
  PartId main_part = {};      ///< that most of its area belongs to
  std::uint32_t holes = 0;    ///< holes of the patch its faces make
  PieceReason reason = PieceReason::part;
  FoldOrder folding = {};
};

/// Why a join has no tab.
enum class NoTab {
  has_tab,
  edge_too_short,    ///< no trapezoid of usable size stands on it
  no_room,           ///< any tab would lie over a face or another tab, on either side
  target_too_small,  ///< no tab fits inside the face that it would be glued behind
  too_little_paper,  ///< on either side a tab would hang on a strip or a point of paper
  beyond_sheet,      ///< the piece with this tab would not fit the sheet
  not_wanted,        ///< tabs are switched off
  time_up,           ///< the time given was up before a place was found
};
/// The contract's `why`: "edge_too_short"; with "no_tab_" before it the code of its message.
[[nodiscard]] std::string_view name(NoTab reason);

/// Two cut edges that are one edge of the surface.
struct Join {
  EdgeId edge;
  std::uint32_t number = 0;  ///< of its chain (chains.hpp), from 1
  TabId tab;                 ///< none: see no_tab
  NoTab no_tab = NoTab::not_wanted;
  /// It has no usable tab (tabs/shape/shapes.hpp) because neither flat region behind it is wide enough for
  /// one: it could have none however the model is cut.
  bool too_narrow = false;
};

/// A tab, in the plane of the piece that it grows from: glued behind the face beyond its edge or, where it
/// has a slit, laid on that face and put through the slit (unfold/tabs/place/slot_tabs.hpp).
struct Tab {
  CornerId side;  ///< side of a face that it grows from; its target is twin(side)
  JoinId join;
  /// First two corners on the side, in the order opposite to the face's; counterclockwise, simple, and convex
  /// but for tabs with a slit.
  std::vector<Vec2> polygon;
  /// Both ends of the cut that it is put through, in the plane of the target's piece.
  std::optional<std::array<Vec2, 2>> slit = {};
  /// It grows from a base, is folded inwards and lies on a face of another body (tabs_of_nets.hpp).
  bool of_base = false;
};

/// A piece that is equal on paper to the first of its kind, turned over where it is its mirror image.
struct EqualPiece {
  PieceId piece;
  bool mirrored = false;
  /// Its tabs, or the slits for them, aren't those of the first.
  bool other_tabs = false;
  /// Lays the first piece of its kind on this one, after x is -x for all of it where it is mirrored.
  Rigid motion = {};
};

/// The result: all pieces of a surface, how they are joined, and their tabs.
struct Nets {
  IdVector<EdgeId, EdgeUse> use;               ///< of each edge of the surface
  IdVector<FaceId, PieceId> piece;             ///< of each face
  IdVector<FaceId, std::array<Vec2, 3>> flat;  ///< corners of each face in its piece's plane, mm
  IdVector<PieceId, Piece> pieces;
  IdVector<JoinId, Join> joins;  ///< one for each cut edge, in the order of their numbers
  IdVector<TabId, Tab> tabs;
  /// Kinds of pieces that there are several of (equal_pieces.hpp).
  std::vector<std::vector<EqualPiece>> equal;
  /// Edges that were to be kept (EdgeConstraint::keep) and are cut: as folds they would close a loop, overlap
  /// or fit no page.
  std::size_t broken_constraints = 0;
  /// Facts about the search that a report has: seconds are kept out, so that two runs give the same bytes.
  std::vector<Message> notes;
};

/// Whether a tab is one beyond that of its join: a second one on the other side, one at an edge that is glued
/// to nothing (tabs/place/more_tabs.hpp), or a further one for a slit on a long edge.
[[nodiscard]] inline bool is_additional(const Nets& nets, TabId tab) {
  const JoinId join = nets.tabs[tab].join;
  return !join.valid() || nets.joins[join].tab != tab;
}

// How much paper some faces take.

/// In the surface's unit squared. Linear.
[[nodiscard]] inline double area_of(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  double area = 0.0;
  for (const FaceId f : faces) {
    area += surface.area(f);
  }
  return area;
}

// How many constraints for edges didn't come true.

/// How many edges that were to be kept are cut in these nets: Nets::broken_constraints. O(n).
[[nodiscard]] inline std::size_t count_broken(const EdgeConstraints& constraints, const Nets& nets) {
  std::size_t broken = 0;
  for (const EdgeId e : ids<EdgeId>(constraints.size())) {
    broken += constraints[e] == EdgeConstraint::keep && nets.use[e] == EdgeUse::cut ? 1U : 0U;
  }
  return broken;
}

/// A, B, ... Z, AA, AB, ... for 0, 1, ...
[[nodiscard]] std::string piece_name(std::size_t number);

}  // namespace ridgecraft::unfold
