// SPDX-License-Identifier: GPL-3.0-or-later
// What pieces a user wants: how much the terms of their cost weigh (energy/ measures them), and limits.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace ridgecraft::unfold {

/// What makes nets and pieces easy to build, in mm of seam that has to be glued: one energy, which all
/// searches share. Each term has a name that users can weigh (energy/, energy/piece_cost.hpp).
struct Weights {
  double seam = 1.0;      ///< each mm of seam
  double bare = 2.0;      ///< each mm of seam without room for a tab that holds
  double slits = 2.0;     ///< each mm of seam that opens by less than 20 degrees
  double mirror = 1.5;    ///< each mm of seam whose mirror image is none
  double bands = 1.0;     ///< each mm of seam across a closed strip beyond one
  double open = 0.1;      ///< each mm of seam on a smooth place; less on ridges and in hollows
  double borders = 0.7;   ///< each mm of fold where colours or names of the model meet
  double compact = 4.0;   ///< each cm2 of a piece's convex hull that is no paper
  double outline = 0.5;   ///< square of a piece's outline, over 1000 mm
  double thin = 0.5;      ///< necks: mm by which what hangs on one is wider than three times its own width
  double pieces = 350.0;  ///< each piece
  double parts = 200.0;   ///< each part beyond the first that a piece has faces of
  double small = 1200.0;  ///< pieces less than 30 mm wide: by the share that is missing
  double panels = 800.0;  ///< square of a piece's flat regions over 80
};

/// How a user wants the pieces.
enum class PieceMode {
  few,    ///< as few as overlap and paper allow
  parts,  ///< the parts of the model; crumbs join their neighbours
  small,  ///< small ones for short evenings
};

/// "few", "parts" or "small".
[[nodiscard]] std::string_view name(PieceMode mode);

/// What a mode means.
struct PieceRules {
  PieceMode mode = PieceMode::parts;  ///< that these are the rules of, or began as
  Weights weights;
  std::size_t max_panels = 0;  ///< flat regions that one piece may have; 0: any number
  /// How long nets of less energy are searched for: swaps that are tried for each face, fewer where there are
  /// many (energy/anneal.hpp); 0: none.
  double trials_per_face = 400.0;
  bool merge = false;  ///< join neighbouring pieces, of several parts too, where that costs less
  /// Must every piece fold up with all creases together (folding/fold_order.hpp)? Those that don't are split
  /// (pieces/linear_split.hpp).
  bool fold_linear = false;
};
[[nodiscard]] PieceRules rules_of(PieceMode mode);

/// A term's weight by its name (all: term_names()); null where
/// there is no such term.
[[nodiscard]] double* weight_named(Weights& weights, std::string_view name);

/// The names of all terms, in the order of Weights.
[[nodiscard]] std::span<const std::string_view> term_names();

}  // namespace ridgecraft::unfold
