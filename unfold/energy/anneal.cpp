// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/anneal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/elementary.hpp"
#include "base/random.hpp"
#include "unfold/energy/net_energy.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/search/overlap_pairs.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {
namespace {

/// Nets of so many faces get all trials for each; those of more get as many in all as this power of their
/// number: each trial takes longer there, too.
constexpr double ordinary_faces = 250.0;
constexpr double growth = 0.4;
/// Trials of the quick half for each one of the exact half.
constexpr double quick_for_exact = 80.0;

}  // namespace

Annealing annealing_for(double trials_per_face, std::uint32_t faces) {
  const double more = std::max(1.0, static_cast<double>(faces) / ordinary_faces);
  const double trials = trials_per_face * static_cast<double>(faces) * elementary::pow(more, growth - 1.0);
  return {static_cast<std::uint64_t>(trials), static_cast<std::uint64_t>(trials / quick_for_exact)};
}

namespace {

// A walk through the trees of a net by swaps of a cut and a fold: what is drawn, and what is made together.

/// Paths between two looks at the clock.
inline constexpr std::uint64_t paths_per_look = 64;
/// A tree is better by more than this, mm: less is rounding.
inline constexpr double better_by = 1e-6;

/// A net that is walked through: how a swap is made, and what it then costs, is up to those that derive from
/// it.
class Walk {
 public:
  /// Net and energy must outlive this, and be of one tree.
  Walk(ChangingNet& net, NetEnergy& energy, std::uint64_t seed);
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;
  virtual ~Walk() = default;

 protected:
  /// Makes a swap that costs no more than `most`, mm, and says what it costs; nothing, and no change, where
  /// it costs more or can't be made.
  virtual std::optional<double> make(const Swap& swap, double most) = 0;
  /// Makes the swap that takes the last one back.
  virtual void unmake(const Swap& back) = 0;
  [[nodiscard]] virtual bool lacks_tab(std::uint32_t cut) = 0;

  /// Whether there is nothing to swap.
  [[nodiscard]] bool done() const { return cuts_.empty(); }

  /// Tries to make a cut a fold, until a swap is accepted: one that costs d, mm, is with probability
  /// exp(-d / heat).
  bool step(double heat, std::uint64_t& trials);

  const Patch& patch_;
  ChangingNet& net_;
  NetEnergy& energy_;

 private:
  [[nodiscard]] std::uint32_t draw_cut();
  [[nodiscard]] std::uint32_t join_of(std::uint32_t side) const;
  void exchange(std::uint32_t cut, std::uint32_t fold);
  [[nodiscard]] std::optional<Swap> mirror_image(const Swap& swap) const;
  [[nodiscard]] std::optional<Swap> swap_of(std::uint32_t fold, std::uint32_t cut) const;
  bool make_one(const Swap& swap, double may_cost);
  bool make_both(const Swap& swap, const Swap& image, double may_cost);

  std::vector<std::uint32_t> cuts_;   ///< the smaller side of each
  std::vector<std::uint32_t> place_;  ///< in cuts_, per smaller side
  std::vector<std::uint32_t> path_;   ///< space to work in
  Random random_;
};

/// Folds that are tried on one path: finding it takes as long as rating a few.
constexpr int folds_per_path = 8;
/// Share of the trials that begin at a cut without room for a tab, or without a mirror image, if a few draws
/// find one.
constexpr double chosen_share = 0.4;
constexpr int draws = 6;
/// The first of two swaps that are made together may cost so much more, mm, than both: the second may win it
/// back.
constexpr double slack_of_pair = 4.0;

/// One side of each cut that could be a fold.
std::vector<std::uint32_t> cuts_of(const Patch& patch, const Folds& folds) {
  std::vector<std::uint32_t> cuts;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    const std::uint32_t twin = patch.twin[side];
    if (twin != nothing && side < twin && folds[side] == 0 && patch.frozen[side] == 0) {
      cuts.push_back(side);
    }
  }
  return cuts;
}

Walk::Walk(ChangingNet& net, NetEnergy& energy, std::uint64_t seed)
    : patch_(net.patch()),
      net_(net),
      energy_(energy),
      cuts_(cuts_of(patch_, net.folds())),
      place_(patch_.twin.size(), nothing),
      random_(seed) {
  for (std::uint32_t i = 0; i < cuts_.size(); ++i) {
    place_[cuts_[i]] = i;
  }
}

bool Walk::step(double heat, std::uint64_t& trials) {
  const std::uint32_t cut = cuts_[draw_cut()];
  // As sides: a step that is taken back may leave the tree hung from another root.
  path_.clear();
  for (const std::uint32_t below : net_.tree().removable_between(cut / 3, patch_.twin[cut] / 3)) {
    path_.push_back(net_.tree().side_above(below));
  }
  const auto length = static_cast<std::uint32_t>(path_.size());
  ++trials;
  for (int i = 0; i < folds_per_path && length > 0; ++i, ++trials) {
    const Swap swap = *swap_of(path_[random_.below(length)], cut);
    const double may_cost = -heat * elementary::log(1.0 - random_.unit());
    const std::optional<Swap> mirrored = mirror_image(swap);
    if (mirrored ? make_both(swap, *mirrored, may_cost) : make_one(swap, may_cost)) {
      return true;
    }
  }
  return false;
}

std::uint32_t Walk::draw_cut() {
  const auto count = static_cast<std::uint32_t>(cuts_.size());
  std::uint32_t at = random_.below(count);
  if (random_.unit() < chosen_share) {
    for (int draw = 0; draw < draws && !lacks_tab(cuts_[at]) && !energy_.cut_costs().is_uneven(cuts_[at]);
         ++draw) {
      at = random_.below(count);
    }
  }
  return at;
}

std::uint32_t Walk::join_of(std::uint32_t side) const {
  return std::min(side, patch_.twin[side]);
}

void Walk::exchange(std::uint32_t cut, std::uint32_t fold) {
  const std::uint32_t at = place_[join_of(cut)];
  place_[join_of(cut)] = nothing;
  cuts_[at] = join_of(fold);
  place_[join_of(fold)] = at;
}

bool Walk::make_one(const Swap& swap, double may_cost) {
  const std::uint32_t fold = net_.tree().side_above(swap.below);
  if (!make(swap, may_cost)) {
    return false;
  }
  exchange(swap.side, fold);
  return true;
}

/// The mirror image of a swap, named as before that is made (its `below` is one of two faces still): where
/// both edges have one that is what they are, but not each other.
std::optional<Swap> Walk::mirror_image(const Swap& swap) const {
  const CutCosts& costs = energy_.cut_costs();
  const std::uint32_t fold = net_.tree().side_above(swap.below);
  const std::uint32_t cut_image = costs.mirror_of(swap.side);
  const std::uint32_t fold_image = costs.mirror_of(fold);
  if (cut_image == nothing || fold_image == nothing || !costs.is_cut(cut_image) || costs.is_cut(fold_image) ||
      patch_.frozen[fold_image] != 0 || join_of(cut_image) == join_of(swap.side) ||
      join_of(fold_image) == join_of(fold)) {
    return std::nullopt;
  }
  return Swap{fold_image, cut_image};
}

/// Of a fold and a cut the swap, if it may be made now.
std::optional<Swap> Walk::swap_of(std::uint32_t fold, std::uint32_t cut) const {
  const RootedNet& tree = net_.tree();
  const std::uint32_t f = fold / 3;
  const std::uint32_t g = patch_.twin[fold] / 3;
  const std::uint32_t below = tree.side_above(f) == fold ? f : g;
  const bool here = tree.in_subtree(below, cut / 3);
  const bool there = tree.in_subtree(below, patch_.twin[cut] / 3);
  return here == there ? std::nullopt : std::optional<Swap>({below, cut});
}

bool Walk::make_both(const Swap& swap, const Swap& image, double may_cost) {
  // Alone it costs what makes the net uneven; that is won back by its image.
  const std::uint32_t fold = net_.tree().side_above(swap.below);
  const double uneven = energy_.cut_costs().mirror_price(swap.side) + energy_.cut_costs().mirror_price(fold);
  const std::optional<double> first = make(swap, uneven + std::max(0.0, may_cost) + slack_of_pair);
  if (!first) {
    return false;
  }
  const std::optional<Swap> second = swap_of(image.below, image.side);
  if (!second || !make(*second, may_cost - *first)) {
    const std::optional<Swap> back = swap_of(join_of(swap.side), join_of(fold));
    unmake(*back);
    return false;
  }
  exchange(swap.side, fold);
  exchange(image.side, image.below);
  return true;
}

// The quick half of the search among trees: tabs are told by angles, overlaps and meetings have a price.

class QuickWalk : public Walk {
 public:
  /// `meetings`, where given, are of the net's patch: only trees without any are remembered.
  QuickWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, std::uint64_t seed);

  /// The best tree that it came to, mirror images counted twice where an exact walk follows; nothing where
  /// none is better than the one that it began with, if that was allowed. Throws Error(interrupted).
  [[nodiscard]] std::optional<Folds> run(const Annealing& rules, const Context& context);

 private:
  std::optional<double> make(const Swap& swap, double most) override;
  void unmake(const Swap& back) override;
  [[nodiscard]] bool lacks_tab(std::uint32_t cut) override;
  [[nodiscard]] bool is_allowed() const {
    return pairs_.total() == 0 && (meetings_ == nullptr || meetings_->total() == 0);
  }
  void remember();

  OverlapPairs pairs_;
  FoldingMeetings* meetings_;
  bool has_tabs_;
  double heat_ = 0.0;
  double overlap_price_ = 0.0;
  double meeting_price_ = 0.0;
  double least_ = HUGE_VAL;
  std::optional<Folds> best_;
};

/// Heat at the end, mm.
constexpr double last_heat = 0.5;
/// Cost of an overlap, mm, at first and at last.
constexpr double first_overlap_price = 20.0;
constexpr double last_overlap_price = 1000.0;
/// Most trials of an ordinary net end at the angles. Where all are measured, as while a spiky body has
/// overlaps, the walk is as much shorter: faces measured for each trial, at most.
constexpr double work_per_trial = 40.0;
/// Cost of two faces that meet while the piece is folded, mm, at first and at last.
constexpr double first_meeting_price = 10.0;
constexpr double last_meeting_price = 100.0;
/// Mirror images count so many times as much where the exact half follows, which gives up what isn't worth
/// it: a walk that begins hot comes to rest uneven where an even net costs no more.
constexpr double mirror_times = 2.0;
/// A swap whose cuts cost more than may be spent is looked at no closer, but for so much, mm, and so many
/// times the heat: its shape may make up for it.
constexpr double least_slack = 4.0;
constexpr double slack_of_heat = 2.0;

/// How many pairs more than none may come for so much, one too many: negative where some must go.
std::int64_t limit_of(double may_cost, double price) {
  return static_cast<std::int64_t>(std::floor(may_cost / price)) + 1;
}

QuickWalk::QuickWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, std::uint64_t seed)
    : Walk(net, energy, seed),
      pairs_(net.tree(), net.tolerance()),
      meetings_(meetings),
      has_tabs_(net.has_tabs()) {
  pairs_.find_all();
  if (meetings_ != nullptr) {
    meetings_->count(net.tree());
  }
}

std::optional<Folds> QuickWalk::run(const Annealing& rules, const Context& context) {
  if (has_tabs_ && rules.exact_trials > 0) {
    energy_.weigh_mirror(mirror_times);
  }
  if (is_allowed()) {
    least_ = energy_.total();
  }
  std::uint64_t paths = 0;
  const auto trials = static_cast<double>(rules.quick_trials);
  const auto spent = [&](std::uint64_t trial) {
    return std::max(static_cast<double>(trial), static_cast<double>(energy_.work()) / work_per_trial) /
           trials;
  };
  for (std::uint64_t trial = 0; rules.quick_trials > 0 && spent(trial) < 1.0 && !done();) {
    if (paths++ % paths_per_look == 0) {
      context.check();
      if (context.out_of_time()) {
        break;
      }
    }
    heat_ = between(rules.first_heat, last_heat, spent(trial));
    overlap_price_ = between(first_overlap_price, last_overlap_price, spent(trial));
    meeting_price_ = between(first_meeting_price, last_meeting_price, spent(trial));
    if (step(heat_, trial)) {
      remember();
      if (rules.until_it_fits && best_) {
        break;
      }
    }
  }
  energy_.weigh_mirror(1.0);
  return std::move(best_);
}

// What is cheap to ask is asked first: angles, shape, overlap, folding.
std::optional<double> QuickWalk::make(const Swap& swap, double most) {
  // No swap wins back more than all pairs cost.
  const double meetings =
      meetings_ != nullptr ? meeting_price_ * static_cast<double>(meetings_->total()) : 0.0;
  const double pairs = meetings + overlap_price_ * static_cast<double>(pairs_.total());
  const std::optional<double> change = energy_.rate(swap, most + least_slack + slack_of_heat * heat_ + pairs);
  if (!change) {
    return std::nullopt;
  }
  const std::int64_t overlaps = limit_of(most + meetings - *change, overlap_price_);
  const std::int64_t added =
      overlaps <= 0 && pairs_.total() == 0 ? overlaps : pairs_.added(swap.below, swap.side, overlaps);
  if (added >= overlaps) {
    energy_.drop();
    return std::nullopt;
  }
  double cost = *change + overlap_price_ * static_cast<double>(added);
  if (meetings_ != nullptr) {
    const auto before = static_cast<std::int64_t>(meetings_->total());
    const std::int64_t limit = before + limit_of(most - cost, meeting_price_);
    const auto after =
        limit <= 0
            ? limit
            : static_cast<std::int64_t>(meetings_->after(net_.tree(), swap, static_cast<std::size_t>(limit)));
    if (after >= limit) {
      energy_.drop();
      return std::nullopt;
    }
    cost += meeting_price_ * static_cast<double>(after - before);
    meetings_->keep(net_.tree());
  }
  pairs_.swap(swap.below, swap.side);
  energy_.keep();
  return cost;
}

void QuickWalk::unmake(const Swap& back) {
  static_cast<void>(energy_.rate(back, HUGE_VAL));
  if (meetings_ != nullptr) {
    static_cast<void>(meetings_->after(net_.tree(), back, std::numeric_limits<std::size_t>::max()));
    meetings_->keep(net_.tree());
  }
  pairs_.swap(back.below, back.side);
  energy_.keep();
}

bool QuickWalk::lacks_tab(std::uint32_t cut) {
  return energy_.cut_costs().lacks_tab(cut);
}

void QuickWalk::remember() {
  if (is_allowed() && energy_.total() < least_ - better_by && energy_.all_fit()) {
    least_ = energy_.total();
    best_ = net_.folds();
  }
}

// The exact half of the search among trees: tabs as they are, no overlap, no meeting that wasn't there.

class ExactWalk : public Walk {
 public:
  /// `bare`: what a millimetre of seam without a tab costs. `meetings`, where given, are of the net's patch:
  /// no swap makes more of them. The net must have tabs.
  ExactWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, double bare, std::uint64_t seed);

  /// The best tree that it came to. Throws Error(interrupted).
  [[nodiscard]] Folds run(const Annealing& rules, const Context& context);

 private:
  std::optional<double> make(const Swap& swap, double most) override;
  void unmake(const Swap& back) override;
  [[nodiscard]] bool lacks_tab(std::uint32_t cut) override;
  [[nodiscard]] double total() { return energy_.total_without_bare() - bare_ * net_.held_mm(); }
  [[nodiscard]] bool meets_no_more(const Swap& swap);
  void remember();

  FoldingMeetings* meetings_;
  double bare_;
  std::uint64_t made_ = 0;  ///< swaps that were looked at with their tabs
  double least_ = HUGE_VAL;
  Folds best_;
};

/// Paths for each trial, at most: most find no clean swap that is worth it.
constexpr std::uint64_t paths_per_trial = 10;
/// Angles may be wrong about the tabs by as much, mm: what costs more than may be spent and this isn't looked
/// at.
constexpr double exact_slack = 15.0;
/// Heats at the beginning and the end, mm.
constexpr double exact_first_heat = 1.0;
constexpr double exact_last_heat = 0.3;

ExactWalk::ExactWalk(ChangingNet& net, NetEnergy& energy, FoldingMeetings* meetings, double bare,
                     std::uint64_t seed)
    : Walk(net, energy, seed), meetings_(meetings), bare_(bare) {
  least_ = total();
  best_ = net_.folds();
  if (meetings_ != nullptr) {
    meetings_->count(net.tree());
  }
}

Folds ExactWalk::run(const Annealing& rules, const Context& context) {
  std::uint64_t paths = 0;
  made_ = 0;
  while (made_ < rules.exact_trials && paths < paths_per_trial * rules.exact_trials && !done()) {
    if (paths++ % paths_per_look == 0) {
      context.check();
      if (context.out_of_time()) {
        break;
      }
    }
    std::uint64_t trials = 0;
    const double spent = static_cast<double>(made_) / static_cast<double>(rules.exact_trials);
    if (step(between(exact_first_heat, exact_last_heat, spent), trials)) {
      remember();
    }
  }
  return std::move(best_);
}

bool ExactWalk::meets_no_more(const Swap& swap) {
  return meetings_ == nullptr ||
         meetings_->after(net_.tree(), swap, meetings_->total() + 1) <= meetings_->total();
}

std::optional<double> ExactWalk::make(const Swap& swap, double most) {
  const std::optional<double> change = energy_.rate(swap, most + exact_slack);
  if (!change) {
    return std::nullopt;
  }
  if (*change > most + exact_slack || !net_.is_clean(swap) || !meets_no_more(swap)) {
    energy_.drop();
    return std::nullopt;
  }
  ++made_;
  const double before = net_.held_mm();
  net_.make_with_tabs(swap);
  const double exact = *change - energy_.rated_bare() - bare_ * (net_.held_mm() - before);
  if (exact > most) {
    net_.take_back();
    energy_.drop();
    return std::nullopt;
  }
  net_.keep();
  energy_.keep();
  if (meetings_ != nullptr) {
    meetings_->keep(net_.tree());
  }
  return exact;
}

void ExactWalk::unmake(const Swap& back) {
  static_cast<void>(energy_.rate(back, HUGE_VAL));
  if (meetings_ != nullptr) {
    static_cast<void>(meetings_->after(net_.tree(), back, std::numeric_limits<std::size_t>::max()));
    meetings_->keep(net_.tree());
  }
  net_.make_with_tabs(back);
  net_.keep();
  energy_.keep();
}

bool ExactWalk::lacks_tab(std::uint32_t cut) {
  return !net_.tab_state().has_tab(cut);
}

void ExactWalk::remember() {
  if (total() < least_ - better_by && energy_.all_fit()) {
    least_ = total();
    best_ = net_.folds();
  }
}

/// With `meetings` only what has none counts; false where nothing such was found.
bool walk(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
          const Annealing& rules, FoldingMeetings* meetings, std::uint64_t seed, const Context& context) {
  Random random(seed);
  const Folds given = net.folds();
  NetEnergy energy(net.patch(), net.tree(), facts, room, weights);
  const std::optional<Folds> found = QuickWalk(net, energy, meetings, random.next()).run(rules, context);
  net.set_tree(found ? *found : given);
  if (!net.is_clean()) {
    net.set_tree(given);
  }
  if (meetings != nullptr) {
    meetings->count(net.tree());
    if (meetings->total() > 0) {
      net.set_tree(given);
      return false;
    }
  }
  if (!net.has_tabs() || rules.exact_trials == 0) {
    return true;
  }
  const Folds start = net.folds();
  energy.set_tree();
  net.set_tree(ExactWalk(net, energy, meetings, weights.bare, random.next()).run(rules, context));
  if (!net.is_clean()) {
    net.set_tree(start);
  }
  return true;
}

}  // namespace

CutFacts cut_facts(const ChangingNet& net, const TabOptions& options) {
  return net.has_tabs() ? cut_facts(net.tab_state(), options) : CutFacts();
}

CutFacts cut_facts(const TabState& tabs, const TabOptions& options) {
  return {tabs.candidates(), tabs.across(), tabs.seams(), options.clearance_mm};
}

void anneal(ChangingNet& net, const CutFacts& facts, const Room& room, const Weights& weights,
            const Annealing& rules, std::uint64_t seed, const Context& context) {
  walk(net, facts, room, weights, rules, nullptr, seed, context);
}

bool anneal_folding_together(ChangingNet& net, const CutFacts& facts, const Room& room,
                             const Weights& weights, const Annealing& rules, std::uint64_t seed,
                             const Context& context) {
  FoldingMeetings meetings(net.patch());
  return walk(net, facts, room, weights, rules, &meetings, seed, context);
}

}  // namespace ridgecraft::unfold
