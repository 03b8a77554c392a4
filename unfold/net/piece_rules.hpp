// SPDX-License-Identifier: GPL-3.0-or-later
// What pieces a user wants: how much the terms of their cost weigh (objective.hpp measures them), and limits.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace ridgecraft::unfold {

/// What makes pieces easy to build, in the worth of one edge to be glued; each term is a name that users can
/// weigh (unfold/patch/objective.hpp).
struct Weights {
  double cut = 1.0;      ///< each 100 mm of cut edges
  double pieces = 6.0;   ///< each piece
  double parts = 8.0;    ///< each part beyond the first that a piece has faces of
  double compact = 4.0;  ///< each 100 cm2 of a piece's convex hull that are no paper
  double thin = 0.5;     ///< necks: width of what hangs on one over its length, beyond three times
  double small = 12.0;   ///< pieces less than 30 mm wide: by the share that is missing
  double panels = 8.0;   ///< square of a piece's flat regions over 80
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
  bool merge = false;          ///< join neighbouring pieces, of several parts too, where that costs less
  /// Must every piece fold up with all creases together (folding/fold_order.hpp)? Those that don't are split
  /// (pieces/linear_split.hpp).
  bool fold_linear = false;
};
[[nodiscard]] PieceRules rules_of(PieceMode mode);

/// A term's weight by its name ("cut", "pieces", "parts", "compact", "thin", "small", "panels"); null where
/// there is no such term.
[[nodiscard]] double* weight_named(Weights& weights, std::string_view name);

/// The names of all terms, in the order of Weights.
[[nodiscard]] std::span<const std::string_view> term_names();

}  // namespace ridgecraft::unfold
