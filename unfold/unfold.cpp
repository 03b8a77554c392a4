// SPDX-License-Identifier: GPL-3.0-or-later
// The stage as a whole: parts by themselves, then one set of pieces, then what belongs on each.
#include "unfold/unfold.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "unfold/copies.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/net/equal_pieces.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/best_pieces.hpp"
#include "unfold/pieces/better_trees.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/pieces/fewer_pieces.hpp"
#include "unfold/pieces/mirror_images.hpp"
#include "unfold/plan.hpp"
#include "unfold/requested_splits.hpp"
#include "unfold/tabs_of_nets.hpp"
#include "unfold/unfolded_parts.hpp"

namespace ridgecraft::unfold {
namespace {

/// All constraints count here, those that were dropped beforehand as well.
void note_broken_constraints(const EdgeConstraints& constraints, Nets& nets) {
  const std::size_t broken = count_broken(constraints, nets);
  nets.broken_constraints = broken;
  if (broken > 0) {
    nets.notes.push_back(Message("kept_edges_cut", {{"n", broken}}));
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

/// The pieces of a surface, from its parts to finished nets: each step takes the forest as the one before
/// left it. Of equal bodies one is unfolded.
class Unfolding {
 public:
  Unfolding(const UnfoldProblem& whole, const Context& context)
      : whole_(whole),
        context_(context),
        each_(one_of_each(whole)),
        asked_(each_ ? each_->problem() : whole),
        plan_(make_plan(asked_, context)),
        patch_(whole_patch(asked_, plan_)),
        problem_{asked_.surface, plan_.whole, patch_, asked_.part.items(), asked_.options, plan_.room} {}

  Nets run() {
    unfold_each_part();
    find_mirror_images();
    search_pieces();
    folds_ = better_trees(problem_, folds_, images_.edge, context_);
    split_for_requests();
    Nets nets = finished_nets();
    describe(nets);
    return nets;
  }

 private:
  void unfold_each_part() {
    UnfoldedParts parts = unfold_parts(asked_, plan_, context_);
    folds_ = std::move(parts.folds);
    causes_ = std::move(parts.causes);
    part_notes_ = std::move(parts.notes);
  }

  void find_mirror_images() {
    if (!context_.out_of_time()) {
      images_ = each_ ? mirror_images_of(whole_, *each_)
                      : mirror_images(whole_.surface, whole_.options.pieces.weights);
    }
  }

  /// Where as few pieces as possible are wanted, a body that became several is looked at once more.
  void search_pieces() {
    folds_ = best_pieces(problem_, folds_, images_.edge, context_);
    const PieceRules& rules = asked_.options.pieces;
    if (rules.merge && rules.mode == PieceMode::few && !context_.out_of_time()) {
      folds_ = best_pieces(problem_, fewer_pieces(problem_, folds_, context_), images_.edge, context_);
    }
  }

  void split_for_requests() {
    in_time_for_nets_ = !context_.out_of_time();
    split_ = wants_all_tabs(asked_.options) ? give_all_tabs(asked_, plan_, patch_, folds_, causes_, context_)
                                            : AllTabs{folds_, causes_};
    if (asked_.options.pieces.fold_linear) {
      LinearFolding linear = fold_together(plan_, patch_, split_.folds, std::move(split_.causes), context_);
      split_.folds = std::move(linear.folds);
      split_.causes = std::move(linear.causes);
      split_off_to_fold_ = linear.split_pieces;
    }
  }

  /// All nets, with everything that belongs on a piece.
  Nets finished_nets() {
    Nets nets = nets_of_folds(asked_.surface, asked_.part, patch_, split_.folds, split_.causes);
    close_flat_cuts(asked_.surface, asked_.panels, plan_.possible_constraints, nets);
    count_holes(asked_.surface, nets);
    insist_on_no_overlap(nets);
    do_in_parallel(nets.pieces.size(), context_, [&](std::size_t i, const Context& own) {
      nets.pieces[PieceId(i)].folding = find_fold_order(asked_.surface, nets, PieceId(i), own);
    });
    give_tabs({asked_.surface, asked_.panels, asked_.options}, nets, context_);
    if (each_) {
      const Nets originals = std::exchange(nets, with_copies(whole_, *each_, nets));
      split_.split_pieces += more_pieces(originals, nets, PieceReason::tabs);
      split_off_to_fold_ += more_pieces(originals, nets, PieceReason::folding);
    }
    add_base_tabs(whole_.surface, whole_.options, {}, nets, context_);
    nets.equal = find_equal_pieces(whole_.surface, nets);
    return nets;
  }

  /// Says what a user should know of the nets.
  void describe(Nets& nets) {
    nets.notes = plan_.notes;
    if (whole_.options.tabs.wanted && !in_time_for_nets_) {
      nets.notes.emplace_back("tabs_untried");
    }
    for (PartNote& note : part_notes_) {
      note.face = each_ ? each_->kept.face[note.face] : note.face;
    }
    const std::vector<Message> of_parts = messages(part_notes_, nets);
    nets.notes.insert(nets.notes.end(), of_parts.begin(), of_parts.end());
    note_broken_constraints(whole_.options.constraints, nets);
    if (whole_.options.pieces.fold_linear) {
      note_linear_folding(split_off_to_fold_, nets);
    }
    if (wants_all_tabs(whole_.options)) {
      note_all_tabs(whole_, split_, nets);
    }
  }

  const UnfoldProblem& whole_;
  const Context& context_;
  const std::optional<OneOfEach> each_;  ///< where bodies are equal
  const UnfoldProblem asked_;            ///< without the copies of equal bodies
  const Plan plan_;
  const Patch patch_;
  const NetProblem problem_;

  Folds folds_;
  Causes causes_;
  std::vector<PartNote> part_notes_;
  MirrorImages images_;
  AllTabs split_;  ///< the last forest
  std::size_t split_off_to_fold_ = 0;
  bool in_time_for_nets_ = true;
};

}  // namespace

Nets unfold(const mesh::Surface& surface, const prepare::Panels& panels, const IdVector<FaceId, PartId>& part,
            const Options& options, const Context& context) {
  context.check();
  context.report("unfold", 0.0);
  const UnfoldProblem asked{surface, panels, part, options};
  refuse_large_faces(asked);
  return Unfolding(asked, context).run();
}

}  // namespace ridgecraft::unfold
