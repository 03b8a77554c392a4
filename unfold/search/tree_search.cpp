// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/tree_search.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/random.hpp"

namespace ridgecraft::unfold {

std::optional<Swap> draw_swap_between(std::uint32_t f, std::uint32_t g, RootedNet& net, Branch& branch,
                                      Random& random) {
  const std::vector<std::uint32_t>& path = net.removable_between(f, g);
  if (path.empty()) {
    return std::nullopt;
  }
  const std::uint32_t below = draw(path, random);
  branch.find(net.folds(), net.side_above(below), f);
  if (branch.places().empty()) {
    return std::nullopt;
  }
  return Swap{below, draw(branch.places(), random)};
}

namespace {

/// After two iterations for each face, and at least so many, searches that ended with a net had 0.013 pairs
/// of faces left for each face at most (an urchin of 696 faces; ordinary models none). The hopeless ones,
/// rings of narrow walls above all, have 0.2 and more.
constexpr std::uint64_t iterations_to_judge = 300;
constexpr double hopeless_pairs_per_face = 0.1;

/// A removed fold may not come back for this many iterations. 3 is too few, 10 to 30 are equal, 100 slightly
/// worse.
constexpr std::uint64_t tabu_tenure = 10;
/// Random moves that the wide stage looks at, and draws to find each.
constexpr int wide_samples = 40;
constexpr int draws_per_sample = 12;
/// Moves that add more overlaps than this are counted out only when there is no other: most of an iteration's
/// time would go into counting how bad its worst moves are.
constexpr std::int64_t first_cap = 1;
constexpr std::int64_t cap_growth = 5;
/// Iterations between two looks at the clock: well below 0.1 s at any size.
constexpr std::uint64_t iterations_per_look = 32;

}  // namespace

/// The best move so far. `change` is the number of overlaps it adds (negative: takes away).
struct TreeSearch::Chosen {
  Move move;
  std::int64_t change = first_cap;
  std::uint32_t ties = 0;
  [[nodiscard]] bool any() const { return move.side != nothing; }
};

TreeSearch::TreeSearch(const Patch& patch, double tolerance, std::uint64_t seed)
    : patch_(patch),
      random_(seed),
      net_(patch),
      pairs_(net_, tolerance),
      tabu_until_(3 * std::size_t{patch.size()}, 0),
      path_pairs_(patch.size()),
      path_pairs_valid_at_(patch.size(), 0) {}

void TreeSearch::set_tree(const Folds& folds) {
  net_.set_tree(folds);
  pairs_.find_all();
  std::fill(tabu_until_.begin(), tabu_until_.end(), 0U);
  best_total_ = pairs_.total();
  best_folds_ = net_.folds();
  best_at_ = iteration_;
}

bool TreeSearch::run(const Budget& budget, const Context& context) {
  const std::uint64_t begin = iteration_;
  while (pairs_.total() > 0) {
    if (iteration_ - begin >= budget.iterations || iteration_ - best_at_ >= budget.idle) {
      return false;
    }
    if (iteration_ % iterations_per_look == 0) {
      context.check();
      if (context.out_of_time()) {
        return false;
      }
    }
    step();
  }
  return true;
}

bool TreeSearch::hopeless() const {
  return iteration_ >= std::max<std::uint64_t>(iterations_to_judge, 2 * std::uint64_t{patch_.size()}) &&
         static_cast<double>(best_total_) > hopeless_pairs_per_face * patch_.size();
}

void TreeSearch::step() {
  ++iteration_;
  const std::vector<std::uint32_t>& bad = pairs_.bad_faces();
  const std::uint32_t f = bad[random_.below(static_cast<std::uint32_t>(bad.size()))];
  const std::vector<std::uint32_t>& met = pairs_.met_by(f);
  find_path(f, met[random_.below(static_cast<std::uint32_t>(met.size()))]);
  Chosen chosen;
  refused_.clear();
  local_stage(chosen);
  if (chosen.change >= 0) {
    wide_stage(chosen);
  }
  reconsider(chosen);
  if (!chosen.any()) {
    std::fill(tabu_until_.begin(), tabu_until_.end(), 0U);
    return;
  }
  const std::uint32_t removed = net_.side_above(chosen.move.below);
  tabu_until_[removed] = tabu_until_[patch_.twin[removed]] = iteration_ + tabu_tenure;
  pairs_.swap(chosen.move.below, chosen.move.side, chosen_pairs_);
  if (pairs_.total() < best_total_) {
    best_total_ = pairs_.total();
    best_folds_ = net_.folds();
    best_at_ = iteration_;
  }
}

void TreeSearch::find_path(std::uint32_t f, std::uint32_t g) {
  path_.clear();
  for (const std::uint32_t below : net_.removable_between(f, g)) {
    path_.push_back({net_.smaller_half(below), below});
  }
}

/// OverlapPairs::across, asked once in an iteration.
std::uint32_t TreeSearch::pairs_across(std::uint32_t below) {
  if (path_pairs_valid_at_[below] != iteration_) {
    path_pairs_[below] = pairs_.across(below);
    path_pairs_valid_at_[below] = iteration_;
  }
  return path_pairs_[below];
}

/// Evaluates a move and keeps it if it is the best so far; among equals each has the same chance.
void TreeSearch::consider(const Move& move, std::uint32_t old_pairs, bool ties, Chosen& chosen) {
  std::int64_t limit = old_pairs + chosen.change + (ties ? 1 : 0);
  if (tabu_until_[move.side] > iteration_) {
    // Aspiration: a forbidden fold is allowed where it makes the best tree so far.
    limit = std::min(limit, static_cast<std::int64_t>(old_pairs + best_total_) -
                                static_cast<std::int64_t>(pairs_.total()));
  }
  if (limit <= 0) {
    return;
  }
  SwapOverlaps& after = pairs_.after_swap();
  const std::uint32_t added = after.count(move.below, move.side, static_cast<std::uint32_t>(limit));
  if (added >= limit) {
    if (!chosen.any() && tabu_until_[move.side] <= iteration_) {
      refused_.push_back({move, old_pairs});
    }
    return;
  }
  const std::int64_t change = static_cast<std::int64_t>(added) - old_pairs;
  if (change < chosen.change) {
    chosen = {move, change, 1};
    chosen_pairs_.swap(after.found());
  } else if (change == chosen.change && random_.below(++chosen.ties) == 0) {
    chosen.move = move;
    chosen_pairs_.swap(after.found());
  }
}

/// Where every move adds more overlaps than was thought of, the least of them all is made, even if it is much
/// worse: refusing those was harmful.
void TreeSearch::reconsider(Chosen& chosen) {
  for (std::int64_t cap = cap_growth * (first_cap + 1); !chosen.any() && !refused_.empty();
       cap *= cap_growth) {
    chosen.change = cap;
    again_.swap(refused_);
    refused_.clear();
    for (const Refused& refused : again_) {
      consider(refused.move, refused.old_pairs, true, chosen);
    }
  }
}

/// Re-hangs at the ends of the removed fold, smallest moved side first; the first improvement is taken.
void TreeSearch::local_stage(Chosen& chosen) {
  const auto later = [](const Arc& a, const Arc& b) {
    return a.smaller != b.smaller ? a.smaller > b.smaller : a.below > b.below;
  };
  std::make_heap(path_.begin(), path_.end(), later);
  for (auto end = path_.end(); end != path_.begin(); --end) {
    std::pop_heap(path_.begin(), end, later);
    const std::uint32_t v = (end - 1)->below;
    const std::uint32_t old_pairs = pairs_across(v);
    const std::uint32_t parent = net_.parent(v);
    for (const std::uint32_t face : {v, parent}) {
      for (std::uint32_t side = 3 * face; side < 3 * face + 3; ++side) {
        const std::uint32_t twin = patch_.twin[side];
        if (twin == nothing || net_.folds()[side] != 0 || patch_.frozen[side] != 0 ||
            net_.in_subtree(v, twin / 3) == (face == v)) {
          continue;
        }
        consider({v, face == v ? side : twin}, old_pairs, true, chosen);
        if (chosen.change < 0) {
          return;
        }
      }
    }
  }
}

/// A random side of the smaller part that leads across the removed fold, as a side of the subtree; or
/// nothing.
std::uint32_t TreeSearch::draw_side(std::uint32_t below) {
  const RootedNet::Span moved = net_.moved_span(below);
  for (int draw = 0; draw < draws_per_sample; ++draw) {
    const std::uint32_t face = net_.face_in(moved, random_.below(moved.count));
    const std::uint32_t side = 3 * face + random_.below(3);
    const std::uint32_t twin = patch_.twin[side];
    if (twin != nothing && net_.folds()[side] == 0 && patch_.frozen[side] == 0 &&
        !net_.in_span(moved, twin / 3)) {
      return net_.moves_subtree(below) ? side : twin;
    }
  }
  return nothing;
}

/// Random moves anywhere along the path: they find what re-hanging at the fold's ends can't.
void TreeSearch::wide_stage(Chosen& chosen) {
  if (path_.empty()) {
    return;
  }
  for (int sample = 0; sample < wide_samples && chosen.change >= 0; ++sample) {
    const std::uint32_t below = path_[random_.below(static_cast<std::uint32_t>(path_.size()))].below;
    const std::uint32_t side = draw_side(below);
    if (side != nothing && tabu_until_[side] <= iteration_) {
      consider({below, side}, pairs_across(below), true, chosen);
    }
  }
}

}  // namespace ridgecraft::unfold
