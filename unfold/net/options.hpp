// SPDX-License-Identifier: GPL-3.0-or-later
// What nets may look like: rules of pieces, tabs, requested edges, and the tolerances of nets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/geometry.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/edge_constraints.hpp"

namespace ridgecraft::unfold {

// Every tolerance of unfold/, its unit and its reason.

/// Penetration depth of two faces in the finished nets, mm: a tenth of what verify/ and the contract allow.
inline constexpr double overlap_tolerance_mm = 1e-4;

/// Penetration depth during the search, as a share of the surface's largest extent. Rounding along the fold
/// tree stays near 1e-15 of it, so there are eight decades of room on one side and print accuracy on the
/// other.
inline constexpr double search_tolerance = 1e-7;

/// What a search takes for a surface of this largest extent, mm: half of what the finished nets may show,
/// whatever its size.
[[nodiscard]] constexpr double net_tolerance(double extent) {
  return std::min(search_tolerance * extent, 0.5 * overlap_tolerance_mm);
}

/// Two copies of an edge that lie this near to each other, mm, are one: a tenth of what the contract allows a
/// length to be off, a thousand times what rounding does.
inline constexpr double closing_tolerance_mm = 1e-6;

/// How far closing such an edge may move what lies a model's size away, when the edge belongs to a narrow
/// face, mm: a tenth of what the contract allows a model of 100 mm to be off when it is folded again.
inline constexpr double closing_lever_mm = 1e-4;

/// Faces that run into each other less deep than this while a piece is folded pass each other, mm: card bends
/// that far out of the way.
inline constexpr double fold_give_mm = 0.3;

// What pieces a user wants: how much the terms of their cost weigh (energy/ measures them), and limits.

/// What makes nets and pieces easy to build, in mm of seam that has to be glued: one energy, which all
/// searches share. Each term has a name that users can weigh (energy/cut_costs.hpp, energy/tree_shape.hpp).
struct Weights {
  double seam = 1.0;      ///< each mm of seam
  double bare = 6.0;      ///< each mm of seam without room for a tab that holds
  double slits = 3.0;     ///< each mm of seam that opens by less than 20 degrees
  double mirror = 1.5;    ///< each mm of seam whose image, mirrored or turned, is none
  double open = 0.1;      ///< each mm of seam on a smooth place; less on ridges and in hollows
  double borders = 0.7;   ///< each mm of fold where colours or names of the model meet
  double compact = 5.0;   ///< each cm2 of a piece's convex hull that is no paper
  double outline = 0.5;   ///< square of a piece's outline, over 1000 mm
  double thin = 0.5;      ///< necks: mm by which what hangs on one is wider than three times its own width
  double pieces = 360.0;  ///< each piece
  double parts = 50.0;    ///< each part beyond the first that a piece has faces of
  double small = 1200.0;  ///< pieces less than 30 mm wide: by the share that is missing
  double panels = 800.0;  ///< square of a piece's flat regions over 80
};

/// How a user wants the pieces.
enum class PieceMode {
  few,    ///< as few as overlap and paper allow
  parts,  ///< the parts of the model; crumbs join their neighbours
  small,  ///< small ones for short evenings
};

/// What a mode means.
struct PieceRules {
  PieceMode mode = PieceMode::parts;  ///< that these are the rules of, or began as
  Weights weights;
  std::size_t max_panels = 0;  ///< flat regions that one piece may have; 0: any number
  /// How long nets of less energy are searched for: moves that are tried for each face, fewer where there are
  /// many (energy/forest_search.hpp); 0: none.
  double trials_per_face = 1000.0;
  /// What an overlap costs at the beginning of that search, mm; it rises until none pays.
  double first_overlap_price = 20.0;
  /// Must every piece fold up with all creases together (folding/fold_order.hpp)? Those that don't are split.
  bool fold_linear = false;
};
[[nodiscard]] PieceRules rules_of(PieceMode mode);
/// Each part by itself, in as few pieces as overlap and paper allow.
[[nodiscard]] PieceRules rules_of_single_parts();

/// A term's weight by its name (all: term_names()); null where
/// there is no such term.
[[nodiscard]] double* weight_named(Weights& weights, std::string_view name);

/// The names of all terms, in the order of Weights.
[[nodiscard]] std::span<const std::string_view> term_names();

// Tabs as a user wants them on finished nets: on which sides, how high, edge by edge.

/// How high tabs are that are put into slits, mm.
inline constexpr double slot_tab_height_mm = 6.3;

/// Which side of a cut gives the tab.
enum class TabSides {
  best,       ///< that where it finds room, the smaller face rather than the larger one
  one_side,   ///< along a seam of two pieces always the same piece, where there is room
  alternate,  ///< along a seam one side after the other, where there is room
  both,       ///< both, to be glued to each other
  slots,      ///< one, put into slits of the face beyond instead of glued, where that has room for them
};

/// A value for edges from a length on.
struct FromLength {
  double length_mm = 0.0;
  double value = 0.0;  ///< mm for heights, radians for angles
};

/// What is asked for the edges with one number.
struct EdgeTab {
  std::uint32_t number = 0;
  std::string where;   ///< who asked, for messages: "tabs.txt, line 3"
  bool wanted = true;  ///< no tab otherwise
  bool both = false;
  std::string piece;  ///< the name of the piece that it has to grow from; empty: either
  std::optional<double> height_mm;
  std::optional<double> angle;  ///< radians
};

/// What is asked for the edge between two faces, whatever number it has.
struct TabAt {
  EdgeId edge;
  bool wanted = true;  ///< no tab otherwise
  /// Of mesh::Surface::sides(edge): 0 or 1, from which it grows where there is room; none: either.
  std::optional<std::uint8_t> side;
  bool no_other_side = false;  ///< rather no tab than one on the other side
  bool both = false;
  std::optional<double> height_mm;
  std::optional<double> angle;  ///< radians
};

/// Which tabs are asked for, in all and edge by edge.
struct TabChoice {
  TabSides sides = TabSides::best;
  bool borders = false;                ///< tabs at edges that are glued to nothing
  std::vector<FromLength> heights_mm;  ///< instead of TabOptions::height_mm; ascending, the first from 0 on
  std::vector<FromLength> angles;      ///< instead of TabOptions::angle, radians; the same
  std::vector<EdgeTab> edges;          ///< what is asked for some edges; the last one counts
  /// The same, and counts more; where there are several for an edge, each changes what those before it say.
  /// Nothing is asked for edges that aren't cut.
  std::vector<TabAt> at;

  /// Whether anything is asked beyond TabOptions.
  [[nodiscard]] bool any() const {
    return sides != TabSides::best || borders || !heights_mm.empty() || !angles.empty() || !edges.empty() ||
           !at.empty();
  }
};

// How parts become nets: values that users choose.

/// What every piece must fit with its tabs after some rotation, mm.
using Sheet = Rectangle;

/// Measures of glue tabs.
struct TabOptions {
  bool wanted = true;
  double height_mm = 5.0;
  double smallest_height_mm = 1.5;  ///< lower ones are left out
  double smallest_top_mm = 2.0;     ///< but half of the edge where that is shorter than twice this, and ...
  double narrowest_top_mm = 1.0;    ///< ... never less than this
  double angle = 0.78539816339744831;          ///< side angle at the base, radians (45 degrees)
  double steepest_angle = 1.3089969389957472;  ///< where the edge is short (75 degrees)
  double clearance_mm = 0.2;                   ///< distance kept from everything but the tab's own edge
  /// Must a tab lie inside the flat region that it is glued behind? Without that it may show beyond it.
  bool inside_target = true;
  /// Do bodies that stand on others get tabs at their bases (tabs_of_nets.hpp)?
  bool at_open_bases = true;
  /// May pieces be split until every edge that is wide enough has a usable tab (pieces/tab_split.hpp)?
  bool split_pieces = false;

  [[nodiscard]] bool on_all_edges() const { return wanted && split_pieces; }
};

/// What may be cut where a part has no single net with all its flat regions (panels) whole. It is asked in
/// PieceMode::few alone: no other mode looks for single nets.
enum class PanelCuts {
  only_if_too_large,  ///< a piece is added before a panel is cut: what makers want
  before_pieces,      ///< a panel is cut before a piece is added: the fewest pieces
};

/// What nets are wanted.
struct Options {
  std::optional<Sheet> sheet;  ///< none: a piece may be as large as it likes
  TabOptions tabs;
  PanelCuts panel_cuts = PanelCuts::only_if_too_large;
  PieceRules pieces = rules_of_single_parts();
  /// Per edge of the surface, or empty. Cuts are always made but inside flat regions; what is to be kept is a
  /// fold unless that would close a loop, overlap or fit no sheet (kept_edges.hpp); a note counts what
  /// couldn't be.
  EdgeConstraints constraints;
  /// Per face, or empty: what its author set it apart by, such as its object and its material. A fold where
  /// two of them meet costs something (Weights::borders), so nets rather end there.
  IdVector<FaceId, std::uint32_t> labels = {};
  /// Per edge, or empty: the band that it is a ruling of (prepare::Rolls::of_edge). Bands stay whole.
  IdVector<EdgeId, RollId> rolls = {};
  /// Bodies of the surface that get one net each, and copies of it (prepare::Prepared::twins).
  prepare::TwinBodies twins = {};
};

/// What a search is to go by: where tabs are wanted on every edge, one costs nearly any shape.
[[nodiscard]] Options with_prices(const Options& options);

/// A surface in parts, and how it is to be unfolded; a search over pieces gets a NetProblem
/// (patch/problem.hpp) made of it. The caller keeps what it refers to.
struct UnfoldProblem {
  const mesh::Surface& surface;
  /// The flat regions of the model. Finished nets go by them: where two sides of a cut inside a region lie on
  /// each other, the paper is whole, and a tab may be glued behind all of a region that one piece has.
  const prepare::Panels& panels;
  const IdVector<FaceId, PartId>& part;
  const Options& options;  ///< with all that was requested, be it possible or not
};

}  // namespace ridgecraft::unfold
