// SPDX-License-Identifier: GPL-3.0-or-later
// Nets that somebody changes by hand: an edge cut or joined, a piece unfolded again.
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/context.hpp"
#include "base/message.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::unfold {

// Finished nets with one fold less or one more, as a person asks for it edge by edge. All other pieces stay
// as they lie.

/// Why an edge can't become what was asked for.
struct Refusal {
  Message why;
  std::vector<FaceId> faces;  ///< where to look: those that would lie on each other, or have the edge
};

/// Nets without joins, tabs, kinds of equal pieces and notes: replace_tabs() gives them all but the notes,
/// which told of the search. Edges that were to be kept and are cut are counted anew.
using ChangedNets = std::variant<Nets, Refusal>;

/// The piece with this fold becomes two; both lie as they lay. Refused where nothing is to be cut: at
/// borders, at cuts, inside flat regions, and where the paper holds together around the edge. `part` and
/// `options`: as for unfold(). O(n log n) but for the order in which both are folded.
[[nodiscard]] ChangedNets cut_fold(const UnfoldProblem& problem, const Nets& nets, EdgeId edge,
                                   const Context& context);

/// The two pieces beside this cut become one; the larger one lies as it lay. Other edges between them that
/// lie flat on each other become folds, too, but for those that were to be cut. Refused where both faces lie
/// in one piece, where the two would overlap deeper than overlap_tolerance_mm, where the options' sheet
/// doesn't hold what would come out, and where it has to fold with all creases together
/// (PieceRules::fold_linear) and wouldn't. It may have more flat regions than the rules allow to a search
/// (PieceRules::max_panels). O(n log n) but for pairs of faces that are near each other and the order in
/// which the piece is folded.
[[nodiscard]] ChangedNets join_cut(const UnfoldProblem& problem, const Nets& nets, EdgeId edge,
                                   const Context& context);

// Other nets for the faces of some pieces; all other pieces stay as they lie.

/// Each of these pieces gets another net of its faces, found by the context's seed: the best one, or, where
/// it has that already, the best one of those in which one of its folds is a cut. Refused where no net is
/// found that keeps it in one piece and is another one. Takes the time of unfold() for each of them.
[[nodiscard]] ChangedNets retry_pieces(const UnfoldProblem& problem, const Nets& nets,
                                       std::span<const PieceId> pieces, const Context& context);

}  // namespace ridgecraft::unfold
