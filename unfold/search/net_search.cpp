// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/search/net_search.hpp"

#include <algorithm>
#include <cmath>

#include "base/elementary.hpp"
#include "unfold/patch/layout.hpp"

namespace ridgecraft::unfold {
namespace {

/// Share of the trials in which the new fold is a side of the faces at the removed one.
constexpr double local_share = 0.8;
/// Draws to find a cut across a fold anywhere.
constexpr int draws_for_a_cut = 12;
/// Trials between two looks at the clock and changes of the heat.
constexpr std::uint64_t trials_per_look = 512;

/// Heats of the first falls, in pairs of faces, and the trials of each for each face: nineteen of twenty
/// ordinary models have their nets after the first, most after a third of it.
constexpr double cool_first = 0.5;
constexpr double cool_last = 0.2;
constexpr std::uint64_t cool_trials_per_face = 50;
constexpr std::uint64_t least_cool_trials = 2000;
/// Bodies with long spikes need more: heats of 4.5 to 6.5 find their nets within a second, one of 3 or less
/// stays where it is, one of 10 never settles. So the walk falls through these again and again, and through
/// the first ones in between: large bodies of which a few pairs are left come to rest there.
constexpr double hot_first = 6.3;
constexpr double hot_last = 4.7;
constexpr std::uint64_t hot_trials_per_face = 500;
/// Trials after which a net is given up: those of spiky bodies that were found at all took fewer.
constexpr std::uint64_t most_trials_per_face = 4000;
constexpr std::uint64_t most_trials = 1'600'000;
/// After this many hot falls a walk that never had fewer pairs left than this for each face is given up:
/// bodies whose nets were found had a tenth of it left, rings of narrow walls twice as much.
constexpr std::uint64_t falls_to_judge = 2;
constexpr double most_pairs_per_face = 0.1;

}  // namespace

NetWalk::NetWalk(const Patch& patch, const WalkRules& rules, std::uint64_t seed)
    : patch_(patch), rules_(rules), random_(seed), forest_(patch), overlaps_(forest_, rules.tolerance) {
  if (rules.folds_together) {
    meetings_.emplace(patch);
  }
}

void NetWalk::set_tree(const Folds& folds) {
  forest_.set_folds(folds);
  overlaps_.find_all();
  if (meetings_) {
    meetings_->count(forest_.folds());
  }
  best_ = forest_.folds();
  least_ = pairs();
  longer_mm_ = 0.0;
}

std::uint64_t NetWalk::pairs() const {
  return overlaps_.total() + (meetings_ ? meetings_->total() : 0);
}

bool NetWalk::cool(const Fall& fall, const Context& context) {
  double heat = fall.first_heat;
  for (std::uint64_t trial = 0; trial < fall.trials && pairs() > 0; ++trial) {
    if (trial % trials_per_look == 0) {
      context.check();
      if (context.out_of_time()) {
        return false;
      }
      const double done = static_cast<double>(trial) / static_cast<double>(fall.trials);
      heat = fall.first_heat * elementary::pow(fall.last_heat / fall.first_heat, done);
    }
    ++trials_;
    try_swap(heat);
  }
  return pairs() == 0;
}

void NetWalk::try_swap(double heat) {
  const auto [f, g] = draw_pair();
  const std::vector<std::uint32_t>& way = forest_.folds_between(f, g);
  if (way.empty()) {
    return;
  }
  const std::uint32_t fold = pick(way, random_);
  const Move move{fold, draw_cut(fold)};
  if (move.closed == no_index) {
    return;
  }
  const double longer = patch_.length[move.opened] - patch_.length[move.closed];
  // What the heat allows is drawn first, so that counting ends as soon as it is passed.
  const double may_cost =
      -heat * elementary::log(std::max(random_.unit(), 1e-300)) - longer * rules_.pairs_per_mm;
  const auto limit = static_cast<std::int64_t>(std::floor(may_cost)) + 1;
  const std::int64_t met = meetings_ ? static_cast<std::int64_t>(meetings_->total()) : 0;
  const std::int64_t added = overlaps_.added(move, limit + met);
  if (added >= limit + met || (meetings_ && !keeps_folding(move, limit + met - added))) {
    return;
  }
  overlaps_.make(move);
  forest_.make(move);
  if (meetings_) {
    meetings_->keep(forest_.folds());
  }
  longer_mm_ += longer;
  if (pairs() < least_) {
    least_ = pairs();
    best_ = forest_.folds();
  }
}

/// Two faces that overlap or meet.
std::pair<std::uint32_t, std::uint32_t> NetWalk::draw_pair() {
  const auto met = static_cast<std::uint32_t>(meetings_ ? meetings_->total() : 0);
  if (met > 0 && random_.below(met + static_cast<std::uint32_t>(overlaps_.total())) < met) {
    return pick(meetings_->pairs(), random_);
  }
  const std::uint32_t f = pick(overlaps_.bad_faces(), random_);
  return {f, pick(overlaps_.met_by(f), random_)};
}

/// Whether fewer than `limit` pairs meet while folding after the move.
bool NetWalk::keeps_folding(const Move& move, std::int64_t limit) {
  if (limit <= 0) {
    return false;
  }
  const Forest::Span half = forest_.carried(move).faces;
  moved_.clear();
  for (std::uint32_t i = 0; i < half.count; ++i) {
    moved_.push_back(forest_.face_in(half, i));
  }
  const auto most = static_cast<std::size_t>(limit);
  return meetings_->after({moved_, forest_.faces_of(half.tree), move.closed}, most) < most;
}

bool NetWalk::may_close(std::uint32_t side) const {
  return patch_.twin[side] != no_index && forest_.folds()[side] == 0 && patch_.frozen[side] == 0;
}

/// A cut that leads from one half of the net to the other when this fold is opened; or nothing.
std::uint32_t NetWalk::draw_cut(std::uint32_t fold) {
  return random_.unit() < local_share ? cut_at(fold) : cut_across(fold);
}

/// A side of one of the two faces at the fold.
std::uint32_t NetWalk::cut_at(std::uint32_t fold) {
  const std::uint32_t below = forest_.below(fold);
  const bool lower = random_.below(2) == 0;
  const std::uint32_t face = lower ? below : forest_.parent(below);
  const std::uint32_t side = 3 * face + random_.below(3);
  return may_close(side) && forest_.in_subtree(below, patch_.twin[side] / 3) != lower ? side : no_index;
}

/// A side of any face of the smaller half.
std::uint32_t NetWalk::cut_across(std::uint32_t fold) {
  const Forest::Span half = forest_.carried({fold, no_index}).faces;
  for (int i = 0; i < draws_for_a_cut; ++i) {
    const std::uint32_t side = 3 * forest_.face_in(half, random_.below(half.count)) + random_.below(3);
    if (may_close(side) && !forest_.in_span(half, patch_.twin[side] / 3)) {
      return side;
    }
  }
  return no_index;
}

NetFound find_net(const Patch& patch, const Folds& start, double tolerance, std::uint64_t seed,
                  const Context& context) {
  NetWalk walk(patch, {tolerance}, seed);
  walk.set_tree(start);
  const std::uint64_t faces = patch.size();
  const std::uint64_t cool = std::max(cool_trials_per_face * faces, least_cool_trials);
  const std::uint64_t hot = hot_trials_per_face * faces;
  const std::uint64_t most = std::max(cool, std::min(most_trials_per_face * faces, most_trials));
  const auto hopeless = static_cast<std::uint64_t>(most_pairs_per_face * static_cast<double>(faces));
  bool found = walk.cool({cool_first, cool_last, cool}, context);
  while (!found && walk.trials() < most && !context.out_of_time() &&
         (walk.trials() < falls_to_judge * hot || walk.least() <= hopeless)) {
    found = walk.cool({hot_first, hot_last, std::min(hot, most - walk.trials())}, context) ||
            walk.cool({cool_first, cool_last, cool}, context);
  }
  NetFound net{walk.best(), walk.least(), walk.trials()};
  if (net.overlaps == 0) {
    // The walk counts by small steps; only a fresh layout and another routine may call a net clean.
    net.overlaps = find_overlaps(lay_out(patch, net.folds), tolerance).size();
  }
  return net;
}

}  // namespace ridgecraft::unfold
