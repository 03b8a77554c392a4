// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/energy/forest_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "unfold/energy/forest_energy.hpp"
#include "unfold/energy/orbit.hpp"
#include "unfold/folding/folding_meetings.hpp"
#include "unfold/net/options.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/search/forest.hpp"
#include "unfold/search/forest_overlaps.hpp"
#include "unfold/tabs/trees/tabs_of_tree.hpp"

namespace ridgecraft::unfold {
namespace {

/// Steps between two looks at the clock.
constexpr std::uint64_t steps_per_look = 64;
/// A forest is better by more than this, mm: less is rounding.
constexpr double better_by = 1e-6;

/// Heats at the end of the quick half and at both ends of the exact one, mm.
constexpr double last_heat = 0.5;
constexpr double exact_first_heat = 1.0;
constexpr double exact_last_heat = 0.3;
/// Price of an overlap at last, mm, and how many times a piece's at least: it must be more than it costs to
/// cut any piece.
constexpr double least_last_overlap_price = 20'000.0;
constexpr double pieces_for_overlap = 4.0;
/// Price of two faces that meet while a piece is folded, mm, at first and at last.
constexpr double first_meeting_price = 10.0;
constexpr double last_meeting_price = 100.0;

/// Images count so many times as much in the quick half where the exact one follows, which gives up
/// what isn't worth it: a walk that begins hot comes to rest asymmetric where a symmetric net costs no more.
constexpr double images_times = 2.0;
/// Faces whose shapes are measured for each trial, at most: where more are, the walk is as much shorter.
constexpr double work_per_trial = 40.0;
/// A move whose cuts alone cost more than may be spent is looked at no closer, except for so much, mm, and so
/// many times the heat: the shapes of its pieces may make up for it.
constexpr double least_slack = 4.0;
constexpr double slack_of_heat = 2.0;
/// By so much, mm, may angles be wrong about tabs.
constexpr double exact_slack = 15.0;
/// Of moves that are made together those before the last may cost so much more, mm, than their share.
constexpr double slack_of_orbit = 4.0;

/// Moves that are tried at one cut.
constexpr int moves_per_cut = 8;
/// Share of the steps that begin at a cut without a tab, or without an image, if a few draws find one.
constexpr double chosen_share = 0.4;
constexpr int draws = 6;
/// Share of the moves at a cut between two pieces that join them, and of all steps that split a piece.
constexpr double join_share = 0.25;
constexpr double split_share = 0.05;
/// Share of the moves with images that are tried without them: of two flaps at one thread one may stay.
constexpr double single_share = 0.1;
/// Steps of the exact half for each move that it looks at, at most: most find none.
constexpr std::uint64_t exact_steps_per_trial = 10;

/// A set of edges, by their smaller sides, to draw from.
class EdgeSet {
 public:
  explicit EdgeSet(std::size_t sides) : at_(sides, no_index) {}
  void add(std::uint32_t edge) {
    at_[edge] = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back(edge);
  }
  void remove(std::uint32_t edge) {
    edges_[at_[edge]] = edges_.back();
    at_[edges_.back()] = at_[edge];
    edges_.pop_back();
    at_[edge] = no_index;
  }
  [[nodiscard]] bool empty() const { return edges_.empty(); }
  [[nodiscard]] std::uint32_t draw(Random& random) const {
    return edges_[random.below(static_cast<std::uint32_t>(edges_.size()))];
  }

 private:
  std::vector<std::uint32_t> edges_;
  std::vector<std::uint32_t> at_;
};

/// How many pairs more than none may come for so much, one too many: negative where some must go.
std::int64_t limit_of(double may_cost, double price) {
  constexpr double most = 1e9;
  return static_cast<std::int64_t>(std::floor(std::clamp(may_cost / price, -most, most))) + 1;
}

CutFacts facts_of(const ForestProblem& problem, const TabState* tabs) {
  CutFacts facts;
  if (tabs != nullptr) {
    facts = {tabs->candidates(), tabs->across(), tabs->seams(), problem.tabs.clearance_mm};
  }
  facts.images = problem.images;
  return facts;
}

/// A forest with all that is known of it.
struct State {
  State(const ForestProblem& problem, const Folds& folds)
      : forest(problem.patch),
        tabs(problem.tabs.wanted ? std::make_optional<TabState>(problem.surface, problem.panels,
                                                                problem.patch, forest, problem.tabs)
                                 : std::nullopt),
        energy((forest.set_folds(folds), forest), problem.part, facts_of(problem, tabs ? &*tabs : nullptr),
               problem.room, problem.weights),
        bare(problem.weights.bare) {}

  /// Mm, with the tabs as they are.
  [[nodiscard]] double exact_total() const {
    return energy.total_without_bare() + (tabs ? bare * tabs->bare_mm() : 0.0);
  }

  Forest forest;
  std::optional<TabState> tabs;
  ForestEnergy energy;
  double bare;
};

class Search {
 public:
  Search(const ForestProblem& problem, const Folds& start, const SearchRules& rules, std::uint64_t seed,
         const Context& context)
      : patch_(problem.patch),
        start_(start),
        rules_(rules),
        context_(context),
        tolerance_(net_tolerance(patch_.extent)),
        last_overlap_price_(std::max(least_last_overlap_price,
                                     pieces_for_overlap * (problem.weights.pieces + problem.weights.small))),
        random_(seed),
        state_(problem, start),
        forest_(state_.forest),
        energy_(state_.energy),
        overlaps_(forest_, tolerance_),
        cuts_(0),
        folds_(0) {
    if (rules.folds_together) {
      meetings_.emplace(patch_);
    }
    look_again();
  }

  Folds run() {
    walk_quickly();
    if (best_ && state_.tabs && rules_.exact_trials > 0) {
      forest_.set_folds(*best_);
      energy_.renew();
      look_again();
      walk_exactly();
    }
    // A walk counts by small steps, so only a layout of its own may call a forest clean in the end.
    return best_ && find_overlaps(lay_out(patch_, *best_), tolerance_).empty() ? *best_ : start_;
  }

 private:
  void look_again() {
    cuts_ = folds_ = EdgeSet(patch_.twin.size());
    for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
      const std::uint32_t twin = patch_.twin[side];
      if (twin != no_index && side < twin && patch_.frozen[side] == 0) {
        (forest_.folds()[side] == 0 ? cuts_ : folds_).add(side);
      }
    }
    overlaps_.find_all();
    if (meetings_) {
      meetings_->count(forest_.folds());
    }
  }

  [[nodiscard]] bool look_at_clock(std::uint64_t step) const {
    if (step % steps_per_look != 0) {
      return false;
    }
    context_.check();
    return context_.out_of_time();
  }

  /// Tabs by angles; overlaps and meetings have a price.
  void walk_quickly() {
    if (is_allowed() && energy_.all_fit()) {
      least_ = energy_.total();
      best_ = start_;
    }
    if (state_.tabs && rules_.exact_trials > 0) {
      energy_.weigh_images(images_times);
    }
    const auto trials = static_cast<double>(rules_.quick_trials);
    trials_ = 0;
    const auto spent = [&] {
      return std::max(static_cast<double>(trials_), static_cast<double>(energy_.work()) / work_per_trial) /
             trials;
    };
    for (std::uint64_t step = 0; rules_.quick_trials > 0 && spent() < 1.0 && !look_at_clock(step); ++step) {
      heat_ = between(rules_.first_heat, last_heat, spent());
      overlap_price_ = between(rules_.first_overlap_price, last_overlap_price_, spent());
      meeting_price_ = between(first_meeting_price, last_meeting_price, spent());
      if (make_step()) {
        remember(energy_.total());
      }
    }
    energy_.weigh_images(1.0);
    split_what_is_wrong();
  }

  /// What still overlaps, meets or doesn't fit comes apart where that costs least.
  void split_what_is_wrong() {
    for (;;) {
      const std::vector<std::uint32_t> folds = folds_of_a_fault();
      Move best;
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t fold : folds) {
        const double infinite = std::numeric_limits<double>::infinity();
        const double cost = energy_.rate({fold, no_index}, infinite).value_or(infinite) +
                            (energy_.rated_fits() ? 0.0 : last_overlap_price_);
        energy_.drop();
        if (cost < least) {
          least = cost;
          best.opened = fold;
        }
      }
      if (best.opened == no_index) {
        break;
      }
      static_cast<void>(energy_.rate(best, std::numeric_limits<double>::infinity()));
      if (meetings_) {
        static_cast<void>(meetings_after(best, std::numeric_limits<std::size_t>::max()));
        meetings_->keep(forest_.folds());
      }
      overlaps_.make(best);
      forest_.make(best);
      energy_.keep();
    }
    remember(energy_.total());
  }

  /// Folds of which one has to go: between two faces that overlap or meet, else of a piece that doesn't fit.
  std::vector<std::uint32_t> folds_of_a_fault() {
    if (overlaps_.total() > 0) {
      const std::uint32_t f = overlaps_.bad_faces().front();
      return forest_.folds_between(f, overlaps_.met_by(f).front());
    }
    for (const auto& [f, g] : meetings_ ? meetings_->pairs() : FacePairs()) {
      if (const std::vector<std::uint32_t>& way = forest_.folds_between(f, g); !way.empty()) {
        return way;
      }
    }
    std::vector<std::uint32_t> folds;
    const std::optional<std::uint32_t> tree = energy_.one_that_does_not_fit();
    for (std::uint32_t i = 1; tree && i < forest_.size_of(*tree); ++i) {
      const std::uint32_t fold = forest_.side_above(forest_.faces_of(*tree)[i]);
      if (patch_.frozen[fold] == 0) {
        folds.push_back(fold);
      }
    }
    return folds;
  }

  /// With the tabs as they are, and no new overlap.
  void walk_exactly() {
    exact_ = true;
    state_.tabs->renew_all();
    least_ = state_.exact_total();
    const std::uint64_t most_steps = exact_steps_per_trial * rules_.exact_trials;
    for (std::uint64_t step = 0;
         looked_at_ < rules_.exact_trials && step < most_steps && !look_at_clock(step); ++step) {
      heat_ = between(exact_first_heat, exact_last_heat,
                      static_cast<double>(looked_at_) / static_cast<double>(rules_.exact_trials));
      if (make_step()) {
        remember(state_.exact_total());
      }
    }
  }

  [[nodiscard]] bool is_allowed() const {
    return overlaps_.total() == 0 && (!meetings_ || meetings_->total() == 0);
  }

  void remember(double total) {
    if (is_allowed() && total < least_ - better_by && energy_.all_fit()) {
      least_ = total;
      best_ = forest_.folds();
    }
  }

  /// Tries moves at one cut, or a split, until one is made.
  bool make_step() {
    ++trials_;
    if (random_.unit() < split_share) {
      const std::optional<Move> split = draw_split();
      return split && propose(*split);
    }
    if (cuts_.empty()) {
      return false;
    }
    const std::uint32_t cut = draw_cut();
    for (int i = 0; i < moves_per_cut; ++i, ++trials_) {
      const std::optional<Move> move = draw_move(cut);
      if (move && propose(*move)) {
        return true;
      }
    }
    return false;
  }

  std::uint32_t draw_cut() {
    const CutCosts& costs = energy_.cut_costs();
    const auto is_good = [&](std::uint32_t cut) {
      return (exact_ ? state_.tabs->has_tab(cut) : !costs.lacks_tab(cut)) && !costs.is_asymmetric(cut);
    };
    std::uint32_t cut = cuts_.draw(random_);
    if (random_.unit() < chosen_share) {
      for (int draw = 0; draw < draws && is_good(cut); ++draw) {
        cut = cuts_.draw(random_);
      }
    }
    return cut;
  }

  /// Between two faces that overlap where there are any, else anywhere.
  std::optional<Move> draw_split() {
    if (overlaps_.total() > 0) {
      const std::uint32_t f = pick(overlaps_.bad_faces(), random_);
      const std::vector<std::uint32_t>& way = forest_.folds_between(f, pick(overlaps_.met_by(f), random_));
      if (!way.empty()) {
        return Move{pick(way, random_), no_index};
      }
    }
    return folds_.empty() ? std::nullopt : std::optional(Move{folds_.draw(random_), no_index});
  }

  /// What could be opened for a cut: a fold on the way round; between two pieces one of the piece that hands
  /// a branch over, or nothing, which joins them.
  std::optional<Move> draw_move(std::uint32_t cut) {
    std::uint32_t from = cut / 3;
    std::uint32_t to = patch_.twin[cut] / 3;
    if (forest_.tree_of(from) != forest_.tree_of(to)) {
      if (random_.unit() < join_share) {
        return Move{no_index, cut};
      }
      if (random_.below(2) == 0) {
        std::swap(from, to);
      }
      to = pick(forest_.faces_of(forest_.tree_of(from)), random_);
    }
    const std::vector<std::uint32_t>& way = forest_.folds_between(from, to);
    return way.empty() ? std::nullopt : std::optional(Move{pick(way, random_), cut});
  }

  bool propose(const Move& move) {
    const double may_cost = -heat_ * elementary::log(1.0 - random_.unit());
    if (!rules_.folds_together) {
      find_orbit(move, patch_, energy_.cut_costs(), orbit_);
      if (orbit_.size() > 1 && random_.unit() >= single_share) {
        return make_orbit(may_cost);
      }
    }
    if (!make(move, may_cost)) {
      return false;
    }
    note(move);
    return true;
  }

  [[nodiscard]] std::uint32_t edge_of(std::uint32_t side) const { return std::min(side, patch_.twin[side]); }

  void note(const Move& move) {
    if (move.closed != no_index) {
      cuts_.remove(edge_of(move.closed));
      folds_.add(edge_of(move.closed));
    }
    if (move.opened != no_index) {
      folds_.remove(edge_of(move.opened));
      cuts_.add(edge_of(move.opened));
    }
  }

  /// Makes a move that costs no more than `most`, mm, and says what it costs.
  std::optional<double> make(const Move& move, double most) {
    return exact_ ? make_exactly(move, most) : make_quickly(move, most);
  }

  /// Cuts that may cost more than may be spent: of a piece that is joined or split its shape decides.
  [[nodiscard]] static double slack_of_pieces(const Move& move) {
    return move.joins() || move.splits() ? std::numeric_limits<double>::infinity() : 0.0;
  }

  // What is cheap to ask is asked first: angles, shapes, overlaps, folding.
  std::optional<double> make_quickly(const Move& move, double most) {
    // No move wins back more than all pairs cost.
    const double meetings = meetings_ ? meeting_price_ * static_cast<double>(meetings_->total()) : 0.0;
    const double pairs = meetings + overlap_price_ * static_cast<double>(overlaps_.total());
    const std::optional<double> change =
        energy_.rate(move, most + least_slack + slack_of_heat * heat_ + pairs + slack_of_pieces(move));
    if (!change) {
      return std::nullopt;
    }
    const std::int64_t limit = limit_of(most + meetings - *change, overlap_price_);
    const std::int64_t added = limit <= 0 && overlaps_.total() == 0 ? limit : overlaps_.added(move, limit);
    double cost = *change + overlap_price_ * static_cast<double>(added);
    if (added >= limit || !add_meetings(move, most, cost)) {
      energy_.drop();
      return std::nullopt;
    }
    overlaps_.make(move);
    forest_.make(move);
    energy_.keep();
    return cost;
  }

  /// Adds what the move costs by faces that meet while the piece is folded; false where that is too much.
  bool add_meetings(const Move& move, double most, double& cost) {
    if (!meetings_) {
      return true;
    }
    const auto before = static_cast<std::int64_t>(meetings_->total());
    const std::int64_t limit = before + limit_of(most - cost, meeting_price_);
    if (limit <= 0) {
      return false;
    }
    const auto after = static_cast<std::int64_t>(meetings_after(move, static_cast<std::size_t>(limit)));
    if (after >= limit) {
      return false;
    }
    cost += meeting_price_ * static_cast<double>(after - before);
    meetings_->keep(forest_.folds());
    return true;
  }

  std::size_t meetings_after(const Move& move, std::size_t limit) {
    const Forest::Carried what = forest_.carried(move);
    moved_.clear();
    for (std::uint32_t i = 0; i < what.faces.count; ++i) {
      moved_.push_back(forest_.face_in(what.faces, i));
    }
    const std::span<const std::uint32_t> to =
        move.splits() ? std::span<const std::uint32_t>() : forest_.faces_of(what.to);
    return meetings_->after({moved_, to, move.closed}, limit);
  }

  std::optional<double> make_exactly(const Move& move, double most) {
    const std::optional<double> change = energy_.rate(move, most + exact_slack + slack_of_pieces(move));
    if (!change) {
      return std::nullopt;
    }
    if (*change > most + exact_slack || !overlaps_.is_clean(move) ||
        (meetings_ && meetings_after(move, meetings_->total() + 1) > meetings_->total())) {
      energy_.drop();
      return std::nullopt;
    }
    ++looked_at_;
    const double before = state_.tabs->bare_mm();
    state_.tabs->make(move);
    const double exact = *change - energy_.rated_bare() + state_.bare * (state_.tabs->bare_mm() - before);
    if (exact > most) {
      state_.tabs->take_back();
      energy_.drop();
      return std::nullopt;
    }
    energy_.keep();
    if (meetings_) {
      meetings_->keep(forest_.folds());
    }
    return exact;
  }

  void unmake(const Move& back) {
    static_cast<void>(energy_.rate(back, std::numeric_limits<double>::infinity()));
    if (exact_) {
      state_.tabs->make(back);
    } else {
      overlaps_.make(back);
      forest_.make(back);
    }
    energy_.keep();
  }

  /// All moves of orbit_, or none.
  bool make_orbit(double may_cost) {
    // Each costs its share and, until all are made, what makes the forest asymmetric.
    const CutCosts& costs = energy_.cut_costs();
    const Move& first = orbit_.front();
    const double uneven = (first.closed != no_index ? costs.asymmetry_price(first.closed) : 0.0) +
                          (first.opened != no_index ? costs.asymmetry_price(first.opened) : 0.0);
    const double share = may_cost / static_cast<double>(orbit_.size());
    double spent = 0.0;
    std::size_t made = 0;
    for (; made < orbit_.size(); ++made) {
      const auto unpaired = static_cast<double>(std::min(made + 1, orbit_.size() - made - 1));
      const double most = share * static_cast<double>(made + 1) - spent + unpaired * uneven +
                          (unpaired > 0.0 ? slack_of_orbit : 0.0);
      const std::optional<double> cost =
          made == 0 || forest_.is_legal(orbit_[made]) ? make(orbit_[made], most) : std::nullopt;
      if (!cost) {
        break;
      }
      spent += *cost;
    }
    trials_ += made;
    if (made < orbit_.size()) {
      while (made > 0) {
        unmake(orbit_[--made].inverse());
      }
      return false;
    }
    for (const Move& move : orbit_) {
      note(move);
    }
    return true;
  }

  const Patch& patch_;
  const Folds& start_;
  const SearchRules rules_;
  const Context& context_;
  const double tolerance_;
  const double last_overlap_price_;
  Random random_;
  State state_;
  Forest& forest_;
  ForestEnergy& energy_;
  ForestOverlaps overlaps_;
  std::optional<FoldingMeetings> meetings_;
  EdgeSet cuts_;
  EdgeSet folds_;
  std::vector<Move> orbit_;           ///< moves that are made together
  std::vector<std::uint32_t> moved_;  ///< space to work in
  bool exact_ = false;
  std::uint64_t trials_ = 0;     ///< moves of the quick half
  std::uint64_t looked_at_ = 0;  ///< moves of the exact half
  double heat_ = 0.0;
  double overlap_price_ = 0.0;
  double meeting_price_ = 0.0;
  double least_ = std::numeric_limits<double>::infinity();
  std::optional<Folds> best_;
};

/// Nets of so many faces get all trials for each; those of more get as many in all as this power of their
/// number: each trial takes longer there, too.
constexpr double ordinary_faces = 250.0;
constexpr double growth = 0.4;
/// Trials of the quick half for each one of the exact half.
constexpr double quick_for_exact = 80.0;

}  // namespace

SearchRules rules_for(double trials_per_face, std::uint32_t faces) {
  const double more = std::max(1.0, static_cast<double>(faces) / ordinary_faces);
  const double trials = trials_per_face * static_cast<double>(faces) * elementary::pow(more, growth - 1.0);
  return {static_cast<std::uint64_t>(trials), static_cast<std::uint64_t>(trials / quick_for_exact)};
}

Folds search_forest(const ForestProblem& problem, const Folds& start, const SearchRules& rules,
                    std::uint64_t seed, const Context& context) {
  return Search(problem, start, rules, seed, context).run();
}

std::optional<double> exact_cost(const ForestProblem& problem, const Folds& folds) {
  State state(problem, folds);
  if (!state.energy.all_fit()) {
    return std::nullopt;
  }
  if (state.tabs) {
    state.tabs->renew_all();
  }
  return state.exact_total();
}

}  // namespace ridgecraft::unfold
