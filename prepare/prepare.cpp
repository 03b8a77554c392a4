// SPDX-License-Identifier: GPL-3.0-or-later
// Which size a model gets where nobody asked for one, and which one it would need.
#include "prepare/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "prepare/at_size.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
#include "prepare/prepared/rolls.hpp"
#include "prepare/simplify/simplify.hpp"

namespace ridgecraft::prepare {
namespace {

/// Sizes that are tried grow by this factor, ...
constexpr double size_step = 1.25;
/// ... or this one where the model has so many faces that each try takes long; there are few then.
constexpr double large_size_step = 1.6;
constexpr std::size_t slow_faces = 10000;
constexpr int slow_tries = 2;
constexpr int most_tries = 16;
/// Of larger models other sizes aren't tried: they take too long, and too much memory.
constexpr std::size_t most_tried_faces = 200000;
/// Trying has at most this share of the time that there is.
constexpr double time_fraction = 0.3;
/// In whole centimetres, ...
constexpr double centimetre = 10.0;
/// ... from the smallest model of which anything can be folded to the largest that anybody builds.
constexpr double smallest_tried_mm = 50.0;
constexpr double largest_tried_mm = 1000.0;

/// Of a model that is so many times the hours larger sizes aren't tried: they take as long.
constexpr double hopeless = 5.0;
/// A larger size must lessen what is too much by this share to be worth its paper; so little of the budget
/// that is too much isn't worth any, such as rims that moved by a hundredth of what they may.
constexpr double worth_paper = 0.2;
constexpr double unnoticed = 0.05;

double allowed_slivers(const Prepared& prepared) {
  return prepared.simplified.at_its_size ? most_slivers : most_own_slivers;
}

double extent_of(const Prepared& prepared) {
  return prepared.model.surface.bounds().largest_extent();
}

double share_beyond(double value, double most) {
  return most > 0.0 ? std::max(0.0, value / most - 1.0) : 0.0;
}

class SizeSearch {
 public:
  SizeSearch(const mesh::Model& model, const SimplifyOptions& simplify, const PanelRoom& room,
             const Context& context)
      : model_(model), simplify_(simplify), room_(room), context_(until_deadline(context, time_fraction)) {}

  [[nodiscard]] double pages(const Prepared& prepared) const {
    return expected_pages(prepared, {room_.sheet.width, room_.sheet.height});
  }

  /// At the size that suits it best: a larger one where it would be too much of something at its own, a
  /// smaller one where it would take too many pages.
  [[nodiscard]] Prepared fitting(Prepared usual, const SizeOptions& size) {
    const double pages_now = pages(usual);
    const double extent = extent_of(usual);
    if (pages_now > size.most_pages) {
      const double fewer = std::sqrt(size.most_pages / pages_now);
      const double mm = std::max(size.smallest_mm, centimetre * std::floor(extent * fewer / centimetre));
      in_time([&] {
        Prepared found = at(mm);
        if (mm < extent && excess(found, simplify_) <= excess(usual, simplify_)) {
          usual = std::move(found);
          usual.size_reason = SizeReason::pages;
        }
      });
      return usual;
    }
    const SizeReason reason = can_be_folded(usual) ? SizeReason::shape : SizeReason::folds;
    double least = excess(usual, simplify_);
    in_time([&] {
      for_larger(extent, is_noticed(usual, least) && !is_hopeless(usual) ? size.largest_mm : 0.0,
                 [&](Prepared found) {
                   tried_.push_back({extent_of(found), can_be_folded(found)});
                   if (pages(found) > size.most_pages) {
                     return false;
                   }
                   const double now = excess(found, simplify_);
                   const bool better = now < (1.0 - worth_paper) * least;
                   if (better) {
                     least = now;
                     usual = std::move(found);
                     usual.size_reason = reason;
                   }
                   return is_noticed(usual, least) && (better || !can_be_folded(usual));
                 });
    });
    return usual;
  }

  /// The smallest size, mm, at which it can be folded; none if there is none that makes sense, or if the time
  /// given is too short to find it.
  [[nodiscard]] std::optional<double> foldable_mm(const Prepared& usual) const {
    std::optional<double> result;
    const double mm = extent_of(usual);
    if (is_hopeless(usual)) {
      return result;
    }
    const auto take = [&](const Tried& size) {
      if (size.mm > mm && size.can_be_folded && !result) {
        result = centimetre * std::round(size.mm / centimetre);
      }
    };
    double from = mm;
    for (const Tried& size : tried_) {
      take(size);
      from = std::max(from, size.mm);
    }
    in_time([&] {
      for_larger(from, result ? 0.0 : largest_tried_mm, [&](const Prepared& found) {
        take({extent_of(found), can_be_folded(found)});
        return !result;
      });
    });
    return result;
  }

 private:
  struct Tried {
    double mm = 0.0;
    bool can_be_folded = false;
  };

  template <class Work>
  static void in_time(const Work& work) {
    try {
      work();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::out_of_time) {
        throw;
      }
    }
  }

  [[nodiscard]] Prepared at(double mm) const {
    SizeOptions size;
    size.largest_extent_mm = mm;
    return prepare_at_size(model_, size, simplify_, room_, context_);
  }
  [[nodiscard]] bool is_hopeless(const Prepared& prepared) const {
    return minutes_of(prepared.work) > hopeless * 60.0 * simplify_.budget.hours;
  }
  [[nodiscard]] static bool is_noticed(const Prepared& prepared, double excess) {
    return excess > unnoticed || !can_be_folded(prepared);
  }
  /// Tries one larger size after another until `go_on`, which gets each, says false.
  template <class GoOn>
  void for_larger(double mm, double largest_mm, const GoOn& go_on) const {
    const bool slow = model_.surface.face_count() > slow_faces;
    const double factor = slow ? large_size_step : size_step;
    int left = slow ? slow_tries : most_tries;
    for (mm = std::max(mm * factor, smallest_tried_mm); mm <= largest_mm && left > 0; mm *= factor) {
      --left;
      mm = centimetre * std::ceil(mm / centimetre);
      context_.check();
      if (!go_on(at(mm))) {
        return;
      }
    }
  }

  const mesh::Model& model_;
  const SimplifyOptions& simplify_;
  const PanelRoom& room_;
  Context context_;
  std::vector<Tried> tried_;  ///< larger sizes than the usual one, ascending
};

}  // namespace

bool has_many_slivers(const Prepared& prepared) {
  return prepared.sliver_fraction > allowed_slivers(prepared);
}

bool is_too_fine(const Prepared& prepared) {
  return prepared.work.short_share() > Budget{}.short_share;
}

bool can_be_folded(const Prepared& prepared) {
  return !is_too_fine(prepared) && !has_many_slivers(prepared);
}

double excess(const Prepared& prepared, const SimplifyOptions& simplify) {
  const Budget budget = prepared.simplified.at_its_size ? aimed_at(simplify.budget) : own_budget(simplify);
  return excess(prepared.work, budget) + share_beyond(prepared.sliver_fraction, allowed_slivers(prepared)) +
         change_excess(prepared.simplified.deviation_mm, extent_of(prepared), simplify);
}

namespace {

/// Of the size that suits it best.
Prepared prepare_fitting(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                         const PanelRoom& room, const Context& context) {
  std::optional<mesh::Model> kept;
  if (model.surface.face_count() <= most_tried_faces) {
    kept = model;
  }
  Prepared prepared = prepare_at_size(std::move(model), size, simplify, room, context);
  if (!kept) {
    return prepared;
  }
  SizeSearch search(*kept, simplify, room, context);
  if (size.adapts) {
    prepared = search.fitting(std::move(prepared), size);
  }
  if (!can_be_folded(prepared)) {
    prepared.smallest_size_mm = search.foldable_mm(prepared);
  }
  return prepared;
}

/// What of a model could be rolled at so many millimetres a unit.
Rolls possible_rolls(mesh::Model model, const RollRules& rules, double mm, const Context& context) {
  remesh_panels(model, context);
  return find_rolls(model.surface, find_panels(model.surface), rules, mm);
}

/// Whether a model has bands that are rolled, and is less work than without. Sides along a rim are one seam
/// with one number, so it doesn't count how many of them there are.
bool is_less_work(const Prepared& rolled, const Prepared& folded) {
  Work work = rolled.work;
  work.joins = folded.work.joins;
  return !rolled.rolls.rolls.empty() && minutes_of(work) < minutes_of(folded.work) &&
         (can_be_folded(rolled) || !can_be_folded(folded));
}

/// Prepares a model without rolls, which also settles its size, and then with them, unless it is too large
/// for trials.
template <class Prepare>
Prepared rolled_or_folded(mesh::Model model, SizeOptions size, const SimplifyOptions& simplify,
                          const Context& context, const Prepare& prepare) {
  const RollRules& rules = simplify.rolls;
  SimplifyOptions without = simplify;
  without.rolls.which = Rolled::never;
  if (rules.which == Rolled::never ||
      (rules.which == Rolled::automatic && model.surface.face_count() > slow_faces)) {
    return prepare(std::move(model), size, without, false);
  }
  const double extent = model.surface.bounds().largest_extent();
  Prepared folded = prepare(mesh::Model(model), size, without, false);
  if (rules.which == Rolled::automatic) {
    const Rolls possible = possible_rolls(model, rules, extent_of(folded) / extent, context);
    folded.rolls.too_tight = possible.too_tight;
    if (possible.rolls.empty()) {
      return folded;
    }
  }
  if (size.adapts) {
    size.largest_extent_mm = extent_of(folded);
  }
  Prepared rolled = prepare(std::move(model), size, simplify, true);
  rolled.size_reason = folded.size_reason;
  rolled.smallest_size_mm = folded.smallest_size_mm;
  return rules.which == Rolled::always || is_less_work(rolled, folded) ? std::move(rolled)
                                                                       : std::move(folded);
}

}  // namespace

Prepared prepare(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                 const PanelRoom& room, const Context& context) {
  return rolled_or_folded(
      std::move(model), size, simplify, context,
      [&](mesh::Model&& from, const SizeOptions& at, const SimplifyOptions& with, bool settled) {
        return settled ? prepare_at_size(std::move(from), at, with, room, context)
                       : prepare_fitting(std::move(from), at, with, room, context);
      });
}

Prepared prepare_as_asked(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                          const PanelRoom& room, const Context& context) {
  return rolled_or_folded(std::move(model), size, simplify, context,
                          [&](mesh::Model&& from, const SizeOptions& at, const SimplifyOptions& with, bool) {
                            return prepare_at_size(std::move(from), at, with, room, context);
                          });
}

}  // namespace ridgecraft::prepare
