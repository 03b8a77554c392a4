// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/heated_search.hpp"

#include <algorithm>

#include "base/elementary.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/overlap_pairs.hpp"
#include "unfold/search/rooted_net.hpp"
#include "unfold/search/tree_search.hpp"

namespace ridgecraft::unfold {
namespace {

/// Heat in pairs of faces. On bodies with long spikes one of 4.5 to 6.5 finds nets within a second, one of 3
/// or less stays where it is, one of 10 never settles. So it falls through these again and again.
constexpr double hottest = 6.3;
constexpr double coolest = 4.7;
/// Trials of one fall, for each face.
constexpr std::uint64_t trials_per_fall = 500;
/// Share of the trials in which the new fold is a side of the faces at the removed one.
constexpr double local_share = 0.8;
/// Draws to find a cut across a fold anywhere.
constexpr int draws_for_a_cut = 12;
/// Trials between two looks at the clock and changes of the heat.
constexpr std::uint64_t swaps_per_look = 512;

/// After these falls a walk that never had fewer pairs left than this for each face is given up, as in
/// tree_search.cpp.
constexpr std::uint64_t falls_to_judge = 2;
constexpr double most_pairs_per_face = 0.1;

constexpr std::uint64_t trials_per_face = 4000;
constexpr std::uint64_t most_trials = 1'600'000;

class HeatedWalk {
 public:
  HeatedWalk(const Patch& patch, const Folds& from, double tolerance, std::uint64_t seed)
      : patch_(patch), random_(seed), net_(patch), pairs_(net_, tolerance) {
    net_.set_tree(from);
    pairs_.find_all();
    best_ = net_.folds();
    least_ = pairs_.total();
  }

  /// Cools down once. True when nothing overlaps.
  bool cool(std::uint64_t trials, const Context& context) {
    double heat = hottest;
    for (std::uint64_t trial = 0; trial < trials && pairs_.total() > 0; ++trial) {
      if (trial % swaps_per_look == 0) {
        context.check();
        if (context.out_of_time()) {
          return false;
        }
        const double done = static_cast<double>(trial) / static_cast<double>(trials);
        heat = hottest * elementary::pow(coolest / hottest, done);
      }
      ++trials_;
      try_swap(heat);
    }
    return pairs_.total() == 0;
  }

  [[nodiscard]] const Folds& best() const { return best_; }
  [[nodiscard]] std::uint64_t least() const { return least_; }
  [[nodiscard]] std::uint64_t trials() const { return trials_; }

 private:
  void try_swap(double heat) {
    const std::uint32_t f = draw(pairs_.bad_faces(), random_);
    const std::uint32_t g = draw(pairs_.met_by(f), random_);
    const std::vector<std::uint32_t>& path = net_.removable_between(f, g);
    if (path.empty()) {
      return;
    }
    const std::uint32_t below = draw(path, random_);
    const std::uint32_t side = random_.unit() < local_share ? side_at(below) : side_across(below);
    if (side == nothing) {
      return;
    }
    // What the heat allows is drawn first, so that counting ends as soon as it is passed.
    const double allowed = -heat * elementary::log(std::max(random_.unit(), 1e-300));
    const auto limit = static_cast<std::int64_t>(allowed) + 1;
    if (pairs_.added(below, side, limit) >= limit) {
      return;
    }
    pairs_.swap(below, side, pairs_.after_swap().found());
    if (pairs_.total() < least_) {
      least_ = pairs_.total();
      best_ = net_.folds();
    }
  }

  [[nodiscard]] bool is_free_cut(std::uint32_t side) const {
    return patch_.twin[side] != nothing && net_.folds()[side] == 0 && patch_.frozen[side] == 0;
  }

  /// A side of one of the two faces at a fold that leads across it, as a side of the subtree; or nothing.
  [[nodiscard]] std::uint32_t side_at(std::uint32_t below) {
    const bool inner = random_.below(2) == 0;
    const std::uint32_t face = inner ? below : net_.parent(below);
    const std::uint32_t side = 3 * face + random_.below(3);
    if (!is_free_cut(side) || net_.in_subtree(below, patch_.twin[side] / 3) == inner) {
      return nothing;
    }
    return inner ? side : patch_.twin[side];
  }

  /// The same for a side of any face of the smaller half.
  [[nodiscard]] std::uint32_t side_across(std::uint32_t below) {
    const RootedNet::Span moved = net_.moved_span(below);
    for (int i = 0; i < draws_for_a_cut; ++i) {
      const std::uint32_t side = 3 * net_.face_in(moved, random_.below(moved.count)) + random_.below(3);
      if (is_free_cut(side) && !net_.in_span(moved, patch_.twin[side] / 3)) {
        return net_.moves_subtree(below) ? side : patch_.twin[side];
      }
    }
    return nothing;
  }

  const Patch& patch_;
  Random random_;
  RootedNet net_;
  OverlapPairs pairs_;
  Folds best_;
  std::uint64_t least_ = 0;
  std::uint64_t trials_ = 0;
};

}  // namespace

std::uint64_t heated_trials(std::uint32_t faces) {
  return std::min(trials_per_face * faces, most_trials);
}

HeatedFound heated_search(const Patch& patch, const Folds& from, const HeatedSearch& options,
                          std::uint64_t seed, const Context& context) {
  HeatedWalk walk(patch, from, options.tolerance, seed);
  const std::uint64_t fall = trials_per_fall * patch.size();
  const auto hopeless = static_cast<std::uint64_t>(most_pairs_per_face * patch.size());
  while (walk.trials() < options.trials && !context.out_of_time() &&
         (walk.trials() < falls_to_judge * fall || walk.least() <= hopeless)) {
    if (walk.cool(std::min(fall, options.trials - walk.trials()), context)) {
      break;
    }
  }
  HeatedFound found{walk.best(), walk.least(), walk.trials()};
  if (found.overlaps == 0) {
    // The walk counts by small steps; only a fresh layout and another routine may call a net clean.
    found.overlaps = find_overlaps(lay_out(patch, found.folds), options.tolerance).size();
  }
  return found;
}

}  // namespace ridgecraft::unfold
