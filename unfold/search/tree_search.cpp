// SPDX-License-Identifier: GPL-3.0-or-later
// Choosing a move; tree_meetings.cpp tells what it would meet, tree_moves.cpp makes it.
#include "unfold/search/tree_search.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/random.hpp"

namespace ridgecraft::unfold {
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
    : patch_(patch), n_(patch.size()), tolerance_(tolerance), random_(seed) {
  order_.resize(n_);
  at_.resize(n_);
  size_.resize(n_);
  up_.resize(n_);
  place_.resize(n_);
  flat_.resize(n_);
  circle_.resize(n_);
  own_circle_.reserve(n_);
  own_edged_.reserve(n_);
  for (const Triangle& t : patch.shape) {
    own_circle_.push_back(smallest_circle(t[0], t[1], t[2]));
    own_edged_.push_back(edged(t));
  }
  meets_.resize(n_);
  bad_at_.assign(n_, nothing);
  tabu_until_.assign(3 * std::size_t{n_}, 0);
  path_pairs_.resize(n_);
  path_pairs_valid_at_.assign(n_, 0);
  moved_.resize(n_);
  moved_in_.assign(n_, 0);
}

void TreeSearch::set_tree(const Folds& folds) {
  folds_ = folds;
  for (auto& list : meets_) {
    list.clear();
  }
  bad_.clear();
  std::fill(bad_at_.begin(), bad_at_.end(), nothing);
  std::fill(tabu_until_.begin(), tabu_until_.end(), 0U);
  total_ = 0;
  tree_.reset(n_);
  traverse(0, nothing, 0, Rigid{});
  renew(0, n_);
  find_all_pairs();
  best_total_ = total_;
  best_folds_ = folds_;
  best_at_ = iteration_;
}

bool TreeSearch::run(const Budget& budget, const Context& context) {
  const std::uint64_t begin = iteration_;
  while (total_ > 0) {
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

bool TreeSearch::hopeless_after(std::uint64_t iterations) const {
  return iterations >= std::max<std::uint64_t>(iterations_to_judge, 2 * n_) &&
         static_cast<double>(best_total_) > hopeless_pairs_per_face * n_;
}

void TreeSearch::step() {
  ++iteration_;
  const std::uint32_t f = bad_[random_.below(static_cast<std::uint32_t>(bad_.size()))];
  find_path(f, meets_[f][random_.below(static_cast<std::uint32_t>(meets_[f].size()))]);
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
  const std::uint32_t removed = up_[chosen.move.below];
  tabu_until_[removed] = tabu_until_[patch_.twin[removed]] = iteration_ + tabu_tenure;
  apply(chosen.move);
  if (total_ < best_total_) {
    best_total_ = total_;
    best_folds_ = folds_;
    best_at_ = iteration_;
  }
}

/// The folds on the tree path from f to g: only removing one of them changes how f and g lie to each other.
void TreeSearch::find_path(std::uint32_t f, std::uint32_t g) {
  path_.clear();
  const auto climb = [this](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t v = from; !in_subtree(v, to); v = patch_.twin[up_[v]] / 3) {
      if (patch_.frozen[up_[v]] == 0) {
        path_.push_back({std::min(size_[v], n_ - size_[v]), v});
      }
    }
  };
  climb(f, g);
  climb(g, f);
}

/// Evaluates a move and keeps it if it is the best so far; among equals each has the same chance.
void TreeSearch::consider(const Move& move, std::uint32_t old_pairs, bool ties, Chosen& chosen) {
  std::int64_t limit = old_pairs + chosen.change + (ties ? 1 : 0);
  if (tabu_until_[move.side] > iteration_) {
    // Aspiration: a forbidden fold is allowed where it makes the best tree so far.
    limit = std::min(limit,
                     static_cast<std::int64_t>(old_pairs + best_total_) - static_cast<std::int64_t>(total_));
  }
  if (limit <= 0) {
    return;
  }
  const std::uint32_t added = new_pairs(move, static_cast<std::uint32_t>(limit));
  if (added >= limit) {
    if (!chosen.any() && tabu_until_[move.side] <= iteration_) {
      refused_.push_back({move, old_pairs});
    }
    return;
  }
  const std::int64_t change = static_cast<std::int64_t>(added) - old_pairs;
  if (change < chosen.change) {
    chosen = {move, change, 1};
    chosen_pairs_.swap(found_);
  } else if (change == chosen.change && random_.below(++chosen.ties) == 0) {
    chosen.move = move;
    chosen_pairs_.swap(found_);
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
    const std::uint32_t parent = patch_.twin[up_[v]] / 3;
    for (const std::uint32_t face : {v, parent}) {
      for (std::uint32_t side = 3 * face; side < 3 * face + 3; ++side) {
        const std::uint32_t twin = patch_.twin[side];
        if (twin == nothing || folds_[side] != 0 || patch_.frozen[side] != 0 ||
            in_subtree(v, twin / 3) == (face == v)) {
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
  const Span moved = moved_span(below);
  for (int draw = 0; draw < draws_per_sample; ++draw) {
    const std::uint32_t face = order_[wrap(moved.first + random_.below(moved.count))];
    const std::uint32_t side = 3 * face + random_.below(3);
    const std::uint32_t twin = patch_.twin[side];
    if (twin != nothing && folds_[side] == 0 && patch_.frozen[side] == 0 && !in_span(moved, twin / 3)) {
      return moves_subtree(below) ? side : twin;
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
