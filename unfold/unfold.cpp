// SPDX-License-Identifier: GPL-3.0-or-later
// The stage as a whole: parts by themselves, then one set of pieces, then what belongs on each.
#include "unfold/unfold.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "prepare/symmetry/rotations.hpp"
#include "unfold/copies.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/net/equal_pieces.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/better_borders.hpp"
#include "unfold/pieces/better_trees.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/pieces/even_pieces.hpp"
#include "unfold/pieces/fewer_pieces.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/pieces/moved_borders.hpp"
#include "unfold/pieces/part_merging.hpp"
#include "unfold/pieces/ragged_pieces.hpp"
#include "unfold/pieces/turned_pieces.hpp"
#include "unfold/pieces/twin_pieces.hpp"
#include "unfold/plan.hpp"
#include "unfold/requested_splits.hpp"
#include "unfold/tabs_of_nets.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {
namespace {

/// What searches for fewer pieces and better trees get: in a hurry a deadline that has passed, so that each
/// ends with what it begins with. It is no limit that anybody set, and nothing is told of it.
Context for_searches(const Plan& plan, const Context& context) {
  Context searching = context;
  if (plan.in_a_hurry) {
    searching.deadline = Deadline::in(0.0);
  }
  return searching;
}

/// All wishes count here, those that were dropped beforehand as well.
void note_broken_wishes(const EdgeWishes& wishes, Nets& nets) {
  const std::size_t broken = count_broken(wishes, nets);
  nets.broken_wishes = broken;
  if (broken > 0) {
    nets.notes.push_back(std::to_string(broken) + (broken == 1 ? " edge that was" : " edges that were") +
                         " to be kept are cut: as folds they would close a loop, overlap or fit no page");
  }
}

/// The promise of the header, checked on what is about to be returned.
void insist_on_no_overlap(const Nets& nets) {
  std::vector<Triangle> triangles;
  for (const Piece& piece : nets.pieces) {
    triangles.clear();
    for (const FaceId f : piece.faces) {
      triangles.push_back(nets.flat[f]);
    }
    if (!find_overlaps(triangles, overlap_tolerance_mm).empty()) {
      throw Error(ErrorKind::internal, "the net of piece " + piece.name + " overlaps itself");
    }
  }
}

/// How many pieces that are there for a reason came with copies of bodies.
std::size_t more_pieces(const Nets& originals, const Nets& all, PieceReason reason) {
  const auto count = [&](const Nets& nets) {
    return std::count_if(nets.pieces.begin(), nets.pieces.end(),
                         [&](const Piece& piece) { return piece.reason == reason; });
  };
  return static_cast<std::size_t>(count(all) - count(originals));
}

/// What is told of finished nets.
void note_result(const Asked& asked, const AllTabs& split, std::size_t split_off_to_fold, Nets& nets) {
  note_broken_wishes(asked.options.wishes, nets);
  if (asked.options.pieces.fold_linear) {
    note_linear_folding(split_off_to_fold, nets);
  }
  if (wants_all_tabs(asked.options)) {
    note_all_tabs(asked, split, nets);
  }
}

/// Which faces make a piece, and over which edges: first each part, then neighbours in one, then other trees
/// of the same faces.
struct Search {
  Folds folds;
  Causes causes;
  std::vector<PartNote> notes;
};

/// The parts with the borders between them moved where that makes fewer pieces, and notes of it.
void move_borders_of(const NetProblem& problem, const Asked& asked, const Context& context,
                     UnfoldedParts& parts) {
  std::vector<PieceReason> cause;
  for (const Cause& c : parts.causes) {
    cause.push_back(c.reason);
  }
  MovedBorders moved = move_borders(problem, parts.folds, cause, context);
  parts.folds = std::move(moved.folds);
  const std::set<PartId> parts_moved(moved.parts.begin(), moved.parts.end());
  // What was told of these is of faces that they no longer have, or not alone.
  std::erase_if(parts.notes,
                [&](const PartNote& note) { return parts_moved.contains(asked.part[note.face]); });
  for (const PartId part : parts_moved) {
    const auto face = std::find(asked.part.begin(), asked.part.end(), part);
    parts.notes.push_back({"moving the border with its neighbours saved pieces",
                           FaceId(static_cast<std::uint32_t>(face - asked.part.begin()))});
  }
}

/// `find_mirrored`, `find_turned`: which edges are mirror images of each other, and which lie on which after
/// a turn; asked for when it is needed.
template <class FindMirrored, class FindTurned>
Search search(const Asked& asked, const Plan& plan, const Patch& patch, const FindMirrored& find_mirrored,
              const FindTurned& find_turned, const Context& context) {
  const NetProblem problem{asked.surface, plan.whole, patch, asked.part.items(), asked.options, plan.room};
  UnfoldedParts parts = unfold_parts(asked, plan, context);
  const PieceRules& rules = asked.options.pieces;
  if (rules.merge) {
    move_borders_of(problem, asked, context, parts);
  }
  Folds merged = rules.merge ? merge_parts(problem, parts.folds, context) : std::move(parts.folds);
  if (rules.merge && rules.mode == PieceMode::few) {
    merged = fewer_pieces(problem, merged, context);
  }
  const MirrorImages images = context.out_of_time() ? MirrorImages() : find_mirrored();
  const std::optional<prepare::PartialRotation> turn = context.out_of_time() ? std::nullopt : find_turned();
  const IdVector<EdgeId, EdgeId> turned_edges = turn ? turn->edge : IdVector<EdgeId, EdgeId>();
  const auto evened = [&](const Folds& folds) {
    return even_pieces(problem, folds, images, turned_edges, context);
  };
  Folds even = evened(merged);
  if (turn) {
    Folds turned = turned_pieces(problem, even, *turn, images.edge, context);
    if (lay_out(patch, turned).faces.size() > lay_out(patch, even).faces.size()) {
      blame(patch, even, turned, PieceReason::shape, parts.causes);
    }
    even = std::move(turned);
  }
  const auto twins_of = [&](const Folds& folds) {
    return context.out_of_time() ? TwinPieces() : find_twin_pieces(asked.surface, patch, folds, context);
  };
  const auto bordered = [&](const Folds& folds, Start start) {
    const Patch apart = with_twins_apart(patch, folds, twins_of(folds));
    return better_borders(problem.with(apart), folds, images.edge, start, context);
  };
  Folds calm = bordered(even, Start::anywhere);
  if (rules.merge && !context.out_of_time()) {
    const Folds cut = with_ragged_pieces_cut(patch, asked.part.items(), calm, rules.weights, context);
    if (blame(patch, calm, cut, PieceReason::shape, parts.causes) > 0) {
      calm = bordered(cut, Start::near);
    }
  }
  calm = evened(calm);
  const Folds better = better_trees(problem, calm, images.edge, context);
  return {with_equal_twins(problem, better, twins_of(better)), std::move(parts.causes),
          std::move(parts.notes)};
}

/// Everything of a piece but its faces and folds.
void finish(const Asked& asked, const Plan& plan, const Context& context, Nets& nets) {
  close_flat_cuts(asked.surface, asked.panels, plan.possible_wishes, nets);
  count_holes(asked.surface, nets);
  insist_on_no_overlap(nets);
  do_in_parallel(nets.pieces.size(), context, [&](std::size_t i, const Context& own) {
    nets.pieces[PieceId(i)].folding = find_fold_order(asked.surface, nets, PieceId(i), own);
  });
  give_tabs(asked.surface, asked.panels, asked.options, nets, context);
}

}  // namespace

Nets unfold(const mesh::Surface& surface, const prepare::Panels& panels, const IdVector<FaceId, PartId>& part,
            const Options& options, const Context& context) {
  context.check();
  context.report("unfold", 0.0);
  const Asked whole{surface, panels, part, options};
  refuse_large_faces(whole);
  const std::optional<OneOfEach> each = one_of_each(whole);
  const Asked asked = each ? each->asked() : whole;
  const Plan plan = make_plan(asked, context);
  const Patch patch = whole_patch(asked, plan);
  const auto mirror_images_here = [&] {
    return each ? mirror_images_of(whole, *each) : mirror_images(surface, options.pieces.weights);
  };
  const auto turn_here = [&] {
    return each ? turn_of(whole, *each) : turn_of(surface, options.pieces.weights);
  };
  Search found = search(asked, plan, patch, mirror_images_here, turn_here, for_searches(plan, context));
  std::vector<std::string> notes = plan.notes;
  if (options.tabs.wanted && context.out_of_time()) {
    notes.emplace_back("the time given was up before all nets with more tabs were tried");
  }
  AllTabs split = wants_all_tabs(options)
                      ? give_all_tabs(asked, plan, patch, found.folds, found.causes, context)
                      : AllTabs{std::move(found.folds), std::move(found.causes)};
  std::size_t split_off_to_fold = 0;
  if (options.pieces.fold_linear) {
    LinearFolding linear = fold_together(plan, patch, split.folds, std::move(split.causes), context);
    split.folds = std::move(linear.folds);
    split.causes = std::move(linear.causes);
    split_off_to_fold = linear.split_pieces;
  }
  Nets nets = nets_of_folds(asked.surface, asked.part, patch, split.folds, split.causes);
  nets.notes = std::move(notes);
  finish(asked, plan, context, nets);
  if (each) {
    const Nets originals = std::exchange(nets, with_copies(whole, *each, nets));
    split.split_pieces += more_pieces(originals, nets, PieceReason::tabs);
    split_off_to_fold += more_pieces(originals, nets, PieceReason::folding);
  }
  for (PartNote& note : found.notes) {
    note.face = each ? each->kept.face[note.face] : note.face;
  }
  const std::vector<std::string> of_parts = sentences(found.notes, nets);
  nets.notes.insert(nets.notes.end(), of_parts.begin(), of_parts.end());
  add_foot_tabs(surface, options, {}, nets, context);
  nets.equal = find_equal_pieces(surface, nets);
  note_result(whole, split, split_off_to_fold, nets);
  return nets;
}

}  // namespace ridgecraft::unfold
