// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/pieces/patch_nets.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/pieces/fewest_pieces.hpp"
#include "unfold/pieces/page_split.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::unfold {
namespace {

/// Pairs of faces that joining what was split may compare: about 0.1 s.
constexpr std::uint64_t joining_pairs = 4'000'000;

}  // namespace

std::size_t pieces_without_paper(const Patch& patch, const Folds& clean, const Room& room, double tolerance,
                                 Random random, const Context& context) {
  const Room any_paper{{}, room.strip, room.max_panels};
  if (all_fit(patch, clean, any_paper)) {
    return cost_of(patch, clean).pieces;
  }
  const Folds split = split_to_fit(patch, clean, any_paper, random, context);
  return cost_of(patch, merge_pieces(patch, split, any_paper, tolerance, joining_pairs, context)).pieces;
}

std::vector<PieceReason> piece_reasons(const Patch& patch, const Folds& folds, const PiecesWithout& without) {
  const Layout layout = lay_out(patch, folds);
  std::vector<std::size_t> by_size(layout.faces.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) {
    return layout.faces[a].size() > layout.faces[b].size();
  });
  std::vector<PieceReason> reason(layout.faces.size(), PieceReason::part);
  for (std::size_t i = 1; i < by_size.size(); ++i) {
    reason[by_size[i]] = i < without.limits  ? without.overlap
                         : i < without.paper ? PieceReason::faces
                                             : PieceReason::page;
  }
  return reason;
}

namespace {

/// Pairs of faces that one merge pass may compare: about 0.1 s.
constexpr std::uint64_t merge_budget = 4'000'000;

/// Start trees of the attempts: the compact kinds first.
constexpr std::array attempt_kinds{
    StartTree::short_cuts,  StartTree::breadth_first, StartTree::flat_folds,    StartTree::short_cuts,
    StartTree::depth_first, StartTree::breadth_first, StartTree::breadth_first, StartTree::short_cuts};

/// Attempts that are made although a net was found: to choose the best. Fewer where each takes long.
std::size_t attempts_for(std::uint32_t faces) {
  return faces <= 500 ? attempt_kinds.size() : faces <= 1500 ? 4 : faces <= 3000 ? 2 : 1;
}

/// Faces times iterations, about 0.5 s, after which no more of them are made: spiky solids take long each
/// time.
constexpr std::uint64_t attempts_cost = 2'000'000;

/// Rounds of taking pieces apart and joining them anew: fewer where each takes long.
int refine_rounds(std::uint32_t faces) {
  return faces <= 500 ? 30 : faces <= 1500 ? 15 : 5;
}

/// A forest that could be the result.
struct Proposal {
  Folds folds;
  SplitCost cost;
};

class PatchUnfolder {
 public:
  PatchUnfolder(const Patch& patch, const Room& room, PanelCuts cuts, double tolerance, std::uint64_t seed,
                Effort effort, const Context& context)
      : patch_(patch),
        room_(room),
        cuts_(cuts),
        tolerance_(tolerance),
        random_(seed),
        effort_(effort),
        context_(context),
        least_pieces_(least_pieces(patch, room)) {
    whole_panels_ = has_panels_ =
        std::any_of(patch.frozen.begin(), patch.frozen.end(), [](std::uint8_t f) { return f != 0; });
  }

  PatchNets run() {
    std::optional<NetFound> failed = try_nets(patch_, static_cast<std::uint32_t>(panel_count(patch_)));
    const Patch* searched = &patch_;
    Patch loose;
    if (failed && has_panels_ && cuts_ == PanelCuts::before_pieces && !context_.out_of_time()) {
      loose = patch_;
      std::fill(loose.frozen.begin(), loose.frozen.end(), std::uint8_t{0});
      searched = &loose;
      whole_panels_ = false;
      failed = try_nets(loose, loose.size());
    }
    if (failed) {
      cut_conflicts(*searched, *failed);
    }
    if (searched == &loose && clean_pieces_ == 1) {
      notes_.emplace_back("flat_regions_cut");
    }
    if (best_->cost.pieces > 1) {
      propose(merge_pieces(patch_, panel_folds(), room_, tolerance_, merge_budget, context_));
    }
    refine();
    insist_on_clean();
    note_pieces();
    return {best_->folds, piece_reasons(patch_, best_->folds, pieces_without()), std::move(notes_)};
  }

 private:
  /// Single nets from several start trees; keeps the best. Gives up when the first search fails with its full
  /// budget, and returns what it found; later ones may take twice as long as it took, since there is a net to
  /// fall back on.
  std::optional<NetFound> try_nets(const Patch& patch, std::uint32_t panels) {
    NetSearch options;
    options.tolerance = tolerance_;
    // Where a piece more is the alternative, whole panels are worth the trouble.
    options.starts *= has_panels_ && cuts_ == PanelCuts::only_if_too_large ? 2 : 1;
    options.iterations = iteration_budget(panels);
    options.idle = idle_iterations(panels);
    std::uint64_t cost = 0;
    for (std::size_t attempt = 0; attempt < attempts_for(patch.size()); ++attempt) {
      if (attempt > 0 && (cost > attempts_cost || context_.out_of_time())) {
        break;
      }
      options.start = attempt_kinds[attempt];
      NetFound found = find_net(patch, options, random_.next(), context_);
      cost += found.iterations * patch.size();
      if (found.overlaps == 0) {
        propose(found.folds);
      } else if (attempt == 0) {
        return found;
      }
      if (attempt == 0) {
        options.starts = 1;
        options.iterations = 2 * found.iterations + patch.size();
      }
    }
    return std::nullopt;
  }

  /// Makes a clean forest fit the room and keeps it if it is better than the best so far.
  void propose(const Folds& clean) {
    Folds folds = clean;
    if (!clean_ || cost_of(patch_, clean) < cost_of(patch_, *clean_)) {
      clean_ = clean;
      clean_pieces_ = cost_of(patch_, clean).pieces;
    }
    if (!all_fit(patch_, folds, room_)) {
      folds = split_to_fit(patch_, folds, room_, random_, context_);
      folds = merge_pieces(patch_, folds, room_, tolerance_, merge_budget, context_);
    }
    const SplitCost cost = cost_of(patch_, folds);
    if (!best_ || cost < best_->cost) {
      best_ = {std::move(folds), cost};
    }
  }

  /// Takes a random piece, and sometimes one beside it, apart into panels and joins what lies there anew in
  /// another order; keeps what isn't worse (ruin and recreate: G. Schrimpf et al., 2000).
  void refine() {
    const Folds panels = panel_folds();
    for (int round = 0; round < refine_rounds(patch_.size()); ++round) {
      if (best_->cost.pieces <= least_pieces_ || context_.out_of_time()) {
        return;
      }
      context_.check();
      Folds folds =
          merge_pieces(patch_, taken_apart(panels), room_, tolerance_, merge_budget, context_, &random_);
      const SplitCost cost = cost_of(patch_, folds);
      if (!(best_->cost < cost) && all_fit(patch_, folds, room_)) {
        best_->folds = std::move(folds);
        best_->cost = cost;
      }
    }
  }

  /// The best forest with one or two pieces broken into their panels.
  [[nodiscard]] Folds taken_apart(const Folds& panels) {
    const Layout layout = lay_out(patch_, best_->folds);
    std::vector<std::uint8_t> broken(layout.faces.size(), 0);
    // The smaller of two, since small pieces are the ones to get rid of.
    const auto count = static_cast<std::uint32_t>(layout.faces.size());
    const std::uint32_t a = random_.below(count);
    const std::uint32_t b = random_.below(count);
    const std::uint32_t chosen = layout.faces[a].size() <= layout.faces[b].size() ? a : b;
    broken[chosen] = 1;
    const auto& faces = layout.faces[chosen];
    const std::uint32_t side =
        3 * faces[random_.below(static_cast<std::uint32_t>(faces.size()))] + random_.below(3);
    if (patch_.twin[side] != nothing) {
      broken[layout.piece[patch_.twin[side] / 3]] = 1;
    }
    Folds folds = best_->folds;
    for (std::uint32_t s = 0; s < folds.size(); ++s) {
      // A panel may be cut between two pieces: a fold needs both of its faces taken apart.
      const std::uint32_t twin = patch_.twin[s];
      if (twin != nothing && broken[layout.piece[s / 3]] != 0 && broken[layout.piece[twin / 3]] != 0) {
        folds[s] = panels[s];
      }
    }
    return folds;
  }

  /// What is returned has passed the check in a fresh layout, whatever the steps before believed.
  void insist_on_clean() {
    while (!find_overlaps(lay_out(patch_, best_->folds), 2.0 * tolerance_).empty()) {
      best_->folds = split_overlaps(patch_, best_->folds, 2.0 * tolerance_);
    }
  }

  /// No single net was found so far. `searched`: the patch, or the same with loose panels.
  void cut_conflicts(const Patch& searched, const NetFound& failed) {
    if (effort_ == Effort::brief) {
      const Folds cut = split_overlaps(searched, failed.folds, tolerance_);
      propose(merge_pieces(searched, cut, Room(), tolerance_, merge_budget, context_));
      return;
    }
    const FewestPieces few = fewest_pieces(searched, failed, tolerance_, random_.next(), context_);
    proven_least_ = few.proven_least;
    out_of_time_ = effort_ == Effort::full && context_.out_of_time();
    propose(few.folds);
  }

  [[nodiscard]] Folds panel_folds() {
    Random random(1);
    Folds folds = start_tree(patch_, StartTree::short_cuts, random);
    for (std::size_t side = 0; side < folds.size(); ++side) {
      folds[side] = folds[side] != 0 && patch_.frozen[side] != 0 ? 1 : 0;
    }
    return folds;
  }

  void note_pieces() {
    const std::size_t pieces = std::min(clean_pieces_, cost_of(patch_, best_->folds).pieces);
    if (pieces == 1) {
      return;
    }
    const std::string no_net =
        std::string(whole_panels_ ? "no_whole_net_" : "no_net_") + (proven_least_ > 1 ? "proven"
                                                                    : out_of_time_    ? "in_time"
                                                                                      : "found");
    notes_.push_back(Message(proven_least_ == pieces ? "fewest_pieces" : "pieces_found",
                             {{"why", std::vector{Message(no_net)}}, {"n", pieces}}));
  }

  /// What there would be with other limits.
  [[nodiscard]] PiecesWithout pieces_without() {
    const std::size_t pieces = cost_of(patch_, best_->folds).pieces;
    PiecesWithout without;
    without.overlap = out_of_time_        ? PieceReason::time
                      : proven_least_ > 1 ? PieceReason::no_net
                                          : PieceReason::overlap;
    without.limits = room_.sheet || room_.max_panels > 0 ? std::min(pieces, clean_pieces_) : pieces;
    without.paper = pieces;
    if (room_.sheet && pieces > without.limits) {
      without.paper = pieces_without_paper(patch_, *clean_, room_, tolerance_, random_, context_);
    }
    return without;
  }

  const Patch& patch_;
  const Room& room_;
  PanelCuts cuts_;
  double tolerance_;
  Random random_;
  Effort effort_;
  const Context& context_;
  std::size_t least_pieces_;  ///< that no arrangement can do without
  bool has_panels_ = false;
  bool whole_panels_ = false;  ///< they stay whole in the search for a net that may be as large as it likes
  bool out_of_time_ = false;
  std::size_t proven_least_ = 1;  ///< no forest without overlap has fewer trees
  std::optional<Proposal> best_;
  std::optional<Folds> clean_;    ///< the fewest pieces without overlap, as large as they like
  std::size_t clean_pieces_ = 0;  ///< their number
  std::vector<Message> notes_;
};

}  // namespace

PatchNets unfold_patch(const Patch& patch, const Room& room, PanelCuts cuts, double tolerance,
                       std::uint64_t seed, Effort effort, const Context& context) {
  return PatchUnfolder(patch, room, cuts, tolerance, seed, effort, context).run();
}

}  // namespace ridgecraft::unfold
