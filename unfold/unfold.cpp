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
#include "base/random.hpp"
#include "unfold/copies.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/net/equal_pieces.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "unfold/nets_of_folds.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/pieces/best_pieces.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/pieces/foldable_trees.hpp"
#include "unfold/pieces/start_nets.hpp"
#include "unfold/pieces/symmetry.hpp"
#include "unfold/plan.hpp"
#include "unfold/reasons.hpp"
#include "unfold/requested_splits.hpp"
#include "unfold/tabs_of_nets.hpp"

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

std::size_t count_pieces(const Nets& nets, PieceReason reason) {
  return static_cast<std::size_t>(std::count_if(nets.pieces.begin(), nets.pieces.end(),
                                                [&](const Piece& piece) { return piece.reason == reason; }));
}

/// How far unfolding has come when all groups have their first nets.
constexpr double share_of_start = 0.3;

/// The first nets of each connected set of faces of one group (Plan::group), as folds of whole_patch.
Folds start_forest(const UnfoldProblem& problem, const Plan& plan, const Context& context) {
  std::uint32_t groups = 0;
  for (const PartId g : plan.group) {
    groups = std::max(groups, g.value() + 1);
  }
  IdVector<PartId, std::vector<FaceId>> faces(groups);
  for (const FaceId f : ids<FaceId>(problem.surface.face_count())) {
    faces[plan.group[f]].push_back(f);
  }
  std::vector<std::vector<FaceId>> tasks;
  for (const std::vector<FaceId>& group : faces) {
    for (std::vector<FaceId>& patch : connected(problem.surface, group, plan.possible_constraints.items())) {
      tasks.push_back(std::move(patch));
    }
  }
  Folds folds(problem.surface.corner_count(), 0);
  const PieceRules& pieces = problem.options.pieces;
  do_in_parallel(
      tasks.size(), context,
      [&](std::size_t i, const Context& own) {
        const Patch patch = make_patch(problem.surface, plan.whole, tasks[i],
                                       plan.possible_constraints.items(), problem.options.labels.items());
        const StartRules rules{net_tolerance(patch.extent), problem.options.panel_cuts,
                               pieces.mode == PieceMode::few};
        const Folds own_folds =
            start_nets(patch, plan.room, rules, Random::stream(context.seed, i).next(), own);
        for (std::uint32_t side = 0; side < own_folds.size(); ++side) {
          folds[3 * patch.face[side / 3].value() + side % 3] = own_folds[side];
        }
      },
      [&](std::size_t done) {
        context.report("unfold",
                       share_of_start * static_cast<double>(done) / static_cast<double>(tasks.size()));
      });
  return folds;
}

/// The pieces of a surface, from its parts to finished nets: each step takes the forest as the one before
/// left it. Of equal bodies one is unfolded.
class Unfolding {
 public:
  Unfolding(const UnfoldProblem& whole, const Context& context)
      : whole_(whole),
        context_(context),
        each_(one_of_each(whole)),
        options_(with_prices(each_ ? each_->options : whole.options)),
        asked_(each_ ? UnfoldProblem{each_->kept.surface, each_->panels, each_->part, options_}
                     : UnfoldProblem{whole.surface, whole.panels, whole.part, options_}),
        symmetry_(each_ ? symmetry_of(whole_, *each_, context)
                        : find_symmetry(whole_.surface, whole_.options.pieces.weights, context)),
        plan_(make_plan(asked_, symmetry_, context)),
        patch_(whole_patch(asked_, plan_)),
        problem_{asked_.surface, plan_.whole, patch_, asked_.part.items(), asked_.options, plan_.room} {}

  Nets run() {
    folds_ = start_forest(asked_, plan_, context_);
    folds_ = best_pieces(problem_, folds_, symmetry_.images, context_);
    folds_ = foldable_trees(problem_, folds_, symmetry_.images, context_);
    split_for_requests();
    Nets nets = finished_nets();
    describe(nets);
    return nets;
  }

 private:
  void split_for_requests() {
    in_time_for_nets_ = !context_.out_of_time();
    if (asked_.options.tabs.on_all_edges()) {
      folds_ = give_all_tabs(asked_, problem_, plan_.possible_constraints, folds_, context_);
      in_time_for_tabs_ = !context_.out_of_time();
    }
  }

  /// All nets, with everything that belongs on a piece.
  Nets finished_nets() {
    Nets nets = nets_of_folds(asked_.surface, asked_.part, patch_, folds_);
    close_flat_cuts(asked_.surface, asked_.panels, plan_.possible_constraints, nets);
    count_holes(asked_.surface, nets);
    insist_on_no_overlap(nets);
    find_reasons(problem_, folds_, nets, context_);
    do_in_parallel(nets.pieces.size(), context_, [&](std::size_t i, const Context& own) {
      nets.pieces[PieceId(i)].folding = find_fold_order(asked_.surface, nets, PieceId(i), own);
    });
    give_tabs({asked_.surface, asked_.panels, asked_.options}, nets, context_);
    if (each_) {
      nets = with_copies(whole_, *each_, nets);
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
    note_broken_constraints(whole_.options.constraints, nets);
    if (whole_.options.pieces.fold_linear) {
      note_linear_folding(count_pieces(nets, PieceReason::folding), nets);
    }
    if (whole_.options.tabs.on_all_edges()) {
      note_all_tabs(whole_, {count_pieces(nets, PieceReason::tabs), in_time_for_tabs_}, nets);
    }
  }

  const UnfoldProblem& whole_;
  const Context& context_;
  const std::optional<OneOfEach> each_;  ///< where bodies are equal
  const Options options_;                ///< with the prices that follow from what is asked
  const UnfoldProblem asked_;            ///< without the copies of equal bodies
  const Symmetry symmetry_;
  const Plan plan_;
  const Patch patch_;
  const NetProblem problem_;

  Folds folds_;
  bool in_time_for_nets_ = true;
  bool in_time_for_tabs_ = true;
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
