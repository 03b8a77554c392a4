// SPDX-License-Identifier: GPL-3.0-or-later
// One function per promise or part of one (docs/reference/formats.md); each adds its faults and sets its
// figures.
#pragma once

#include "verify/file/model_surface.hpp"
#include "verify/relations/case.hpp"
#include "verify/report/findings.hpp"

namespace ridgecraft::verify {

/// Promise 1. O(k²) for a face with k corners: all its diagonals.
void check_lengths(const Case& given, Findings& findings);
/// Promise 2.
void check_overlap(const Case& given, Findings& findings);
/// Promise 3.
void check_coverage(const Case& given, Findings& findings);
/// Promise 4.
void check_bounds(const Case& given, Findings& findings);
/// Promise 5: edges of the nets, and pieces as discs with holes.
void check_patches(const Case& given, Findings& findings);
/// Promise 5: folds, cuts and joins against the model.
void check_joins(const Case& given, Findings& findings);
/// Promise 5: tabs.
void check_tabs(const Case& given, Findings& findings);
/// Promise 5: slits that tabs are put through. O(n log n) for slits of bounded number in a piece.
void check_slits(const Case& given, Findings& findings);
/// Promise 5: paper that tabs hang on.
void check_paper_behind_tabs(const Case& given, Findings& findings);
/// Promise 6.
void check_refold(const Case& given, Findings& findings);
/// Promise 7, where the file has a fold order. O(n log n).
void check_fold_order(const Case& given, Findings& findings);
/// The same in motion, where nothing is wrong with lengths, joins and order.
void check_fold_motion(const Case& given, Findings& findings);
/// Promise 8: what the file says of itself.
void check_statements(const Case& given, Findings& findings);
/// The same: pieces that are said to be equal are. O(n log n) for each.
void check_equal_pieces(const Case& given, Findings& findings);
/// The same: where the file has an order of assembly, it can be followed. O(n log n).
void check_assembly(const Case& given, Findings& findings);
/// The same: where separate bodies are glued to each other. O(n log n) for each body.
void check_glue(const Case& given, Findings& findings);
/// Promise 9.
void check_model(const Case& given, const ModelSurface& surface, Findings& findings);
/// Pieces that no knife cuts out, those left out that meet no other piece.
void count_narrow_pieces(const Case& given, Findings& findings);
/// Pieces that hang together by a thread. O(n log n), and for each corner of the outlines with the square of
/// the sides that come near it.
void count_thin_necks(const Case& given, Findings& findings);
/// What the knife cuts and what is folded.
void measure_cuts(const Case& given, Findings& findings);

}  // namespace ridgecraft::verify
