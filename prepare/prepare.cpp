// SPDX-License-Identifier: GPL-3.0-or-later
// Which size a model gets where nobody asked for one, and which one it would need.
#include "prepare/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "prepare/at_size.hpp"
#include "prepare/prepared/prepared.hpp"

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
/// Where a model can't be folded, folds that are by these factors longer are tried to be left only.
constexpr double coarser_step = 1.5;
constexpr double most_coarser = 3.5;
/// In whole centimetres, ...
constexpr double centimetre = 10.0;
/// ... from the smallest model of which anything can be folded to the largest that anybody builds.
constexpr double smallest_tried_mm = 50.0;
constexpr double largest_tried_mm = 1000.0;

/// Where edges below short_edge_mm have more than this share of the length of all, tabs and numbers have too
/// little room for most of the model, ...
constexpr double most_cramped = 0.07;
/// ... of less than this nobody takes notice, ...
constexpr double hardly_cramped = 0.035;
/// ... and a larger size that doesn't mend it all must lessen the share to this part of it to be worth its
/// paper.
constexpr double worth_paper = 0.8;

double allowed_slivers(const Prepared& prepared) {
  return prepared.simplified.at_its_size ? most_slivers : most_own_slivers;
}

bool is_cramped(const Prepared& prepared) {
  return prepared.simplified.cramped_fraction > most_cramped;
}

bool is_spoilt(const Prepared& prepared) {
  return seen_move(prepared.simplified.deviation_mm, prepared.model.surface.bounds()) != SeenMove::none;
}

/// Neither its folds nor its tabs and numbers lack room, and its shape is the file's.
bool is_roomy(const Prepared& prepared) {
  return can_be_folded(prepared) && !is_cramped(prepared) && !is_spoilt(prepared);
}

double extent_of(const Prepared& prepared) {
  return prepared.model.surface.bounds().largest_extent();
}

class SizeSearch {
 public:
  SizeSearch(const mesh::Model& model, const SimplifyOptions& simplify, const PanelRoom& room,
             const Context& context)
      : model_(model), simplify_(simplify), room_(room), context_(until_deadline(context, time_fraction)) {}

  /// Whether the program says how far, and not who asks for a number of faces.
  [[nodiscard]] bool simplifies() const { return simplify_.mode == Simplification::automatic; }
  [[nodiscard]] double pages(const Prepared& prepared) const {
    return expected_pages(prepared, {room_.sheet.width, room_.sheet.height});
  }
  /// The next larger size that is good enough; none if there is none that makes sense, or if the time given
  /// is too short to find it. Sets `foldable_mm` to the first size on the way at which the model can be
  /// folded.
  std::optional<Prepared> larger(double mm, bool (*good)(const Prepared&),
                                 std::optional<double>& foldable_mm) const {
    return in_time([&] { return next_larger(mm, good, foldable_mm); });
  }
  /// The next larger size within the limits at which the model is neither cramped nor spoilt. Or else, of a
  /// cramped one, the first at which it isn't, or at which it is so least, if that is worth its paper; spoilt
  /// there only where it is spoilt as it is.
  [[nodiscard]] std::optional<Prepared> roomier(const Prepared& usual, const SizeOptions& size) const {
    std::optional<Prepared> best;
    constexpr double unbeaten = -1.0;
    double to_beat = is_cramped(usual)
                         ? std::max(most_cramped, worth_paper * usual.simplified.cramped_fraction)
                         : unbeaten;
    in_time([&] {
      for_larger(extent_of(usual), size.largest_mm, [&](Prepared found) {
        if (pages(found) > size.most_pages) {
          return false;
        }
        if (!can_be_folded(found)) {
          return true;
        }
        const double share = found.simplified.cramped_fraction;
        const bool enough = !is_cramped(found) && !is_spoilt(found);
        const bool no_worse = !is_spoilt(found) || is_spoilt(usual);
        if (enough || (no_worse && share <= to_beat)) {
          to_beat = is_cramped(found) ? share : unbeaten;
          best = std::move(found);
        }
        return !enough;
      });
      return std::optional<Prepared>();
    });
    return best;
  }
  /// At the same size, but as coarse as it would be at a smaller one, if it is good enough so: most models
  /// lose details together, and fold badly where some of them stay.
  [[nodiscard]] std::optional<Prepared> coarser(const SizeOptions& size,
                                                bool (*good)(const Prepared&)) const {
    if (!simplifies() || model_.surface.face_count() > slow_faces) {
      return std::nullopt;
    }
    return in_time([&] {
      SimplifyOptions coarse = simplify_;
      for (double factor = coarser_step; factor <= most_coarser; factor *= coarser_step) {
        context_.check();
        coarse.short_edge_mm = factor * simplify_.short_edge_mm;
        coarse.tiny_edge_mm = factor * simplify_.tiny_edge_mm;
        std::optional<Prepared> found = prepare_at_size(model_, size, coarse, room_, context_);
        judge_folds(*found, simplify_);
        if (good(*found)) {
          return found;
        }
      }
      return std::optional<Prepared>();
    });
  }
  /// At a smaller size, if it can be folded there.
  [[nodiscard]] std::optional<Prepared> smaller(double mm) const {
    return in_time([&] {
      std::optional<Prepared> found = at(mm);
      return can_be_folded(*found) ? std::move(found) : std::nullopt;
    });
  }

 private:
  template <class Work>
  static std::optional<Prepared> in_time(const Work& work) {
    try {
      return work();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::out_of_time) {
        throw;
      }
      return std::nullopt;
    }
  }

  [[nodiscard]] Prepared at(double mm) const {
    SizeOptions size;
    size.largest_extent_mm = mm;
    return prepare_at_size(model_, size, simplify_, room_, context_);
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
  std::optional<Prepared> next_larger(double mm, bool (*good)(const Prepared&),
                                      std::optional<double>& foldable_mm) const {
    std::optional<Prepared> result;
    for_larger(mm, largest_tried_mm, [&](Prepared found) {
      if (!foldable_mm && can_be_folded(found)) {
        foldable_mm = centimetre * std::round(extent_of(found) / centimetre);
      }
      if (good(found)) {
        result = std::move(found);
      }
      return !result;
    });
    return result;
  }

  const mesh::Model& model_;
  const SimplifyOptions& simplify_;
  const PanelRoom& room_;
  Context context_;
};

/// A preparation that becomes better phase by phase.
class SizeChoice {
 public:
  SizeChoice(Prepared usual, const SizeOptions& size, const SizeSearch& search)
      : best_(std::move(usual)), size_(size), search_(search) {}

  /// As it is best at its size, the same whether a user asks for that size or not. Where it can't be folded,
  /// with the smallest size at which it can.
  Prepared at_its_size() {
    coarsen();
    if (!can_be_folded(best_)) {
      search_.larger(extent_of(best_), can_be_folded, best_.smallest_size_mm);
    }
    return std::move(best_);
  }

  /// Of the size that it has by default, or of another one between the limits that suits it better.
  Prepared at_fitting_size() {
    make_foldable();
    if (!can_be_folded(best_)) {
      return std::move(best_);
    }
    const double pages = search_.pages(best_);
    const double fitting_mm = std::max(
        size_.smallest_mm, whole_centimetres(extent_of(best_) * std::sqrt(size_.most_pages / pages)));
    if (pages > size_.most_pages && fitting_mm < extent_of(best_)) {
      if (replace(search_.smaller(fitting_mm))) {
        best_.size_reason = SizeReason::pages;
        return std::move(best_);
      }
    } else {
      make_roomy();
    }
    size_.largest_extent_mm = extent_of(best_);
    coarsen();
    return std::move(best_);
  }

 private:
  static double whole_centimetres(double mm) { return centimetre * std::floor(mm / centimetre); }

  /// Whether there is a better one; it is of the same size for the same reason.
  bool replace(std::optional<Prepared> better) {
    if (better) {
      better->size_reason = best_.size_reason;
      best_ = std::move(*better);
    }
    return better.has_value();
  }

  /// Where it can't be folded or lacks room as it is, and has room when it is coarser.
  bool coarsen_for_room() {
    return (!can_be_folded(best_) || is_cramped(best_)) && replace(search_.coarser(size_, is_roomy));
  }
  void coarsen_for_folds() {
    if (!can_be_folded(best_)) {
      replace(search_.coarser(size_, can_be_folded));
    }
  }
  void coarsen() {
    if (!coarsen_for_room()) {
      coarsen_for_folds();
    }
  }

  /// At a larger size within the limits where it can't be folded at its own.
  void make_foldable() {
    if (can_be_folded(best_) || coarsen_for_room()) {
      return;
    }
    std::optional<double> foldable_mm;
    std::optional<Prepared> larger = search_.larger(extent_of(best_), can_be_folded, foldable_mm);
    if (larger && extent_of(*larger) <= size_.largest_mm && search_.pages(*larger) <= size_.most_pages) {
      replace(std::move(larger));
      best_.size_reason = SizeReason::folds;
      return;
    }
    coarsen_for_folds();
    if (!can_be_folded(best_)) {
      best_.smallest_size_mm = foldable_mm;
    }
  }

  /// At a larger size where tabs and numbers lack room or simplification is seen.
  void make_roomy() {
    const bool cramped = is_cramped(best_);
    if (!cramped && !(search_.simplifies() && is_spoilt(best_))) {
      return;
    }
    if (replace(search_.roomier(best_, size_)) && best_.size_reason == SizeReason::none) {
      best_.size_reason = cramped ? SizeReason::room : SizeReason::shape;
    }
  }

  Prepared best_;
  SizeOptions size_;
  const SizeSearch& search_;
};

}  // namespace

bool has_many_slivers(const Prepared& prepared) {
  return prepared.sliver_fraction > allowed_slivers(prepared);
}

bool can_be_folded(const Prepared& prepared) {
  return !prepared.simplified.still_too_fine && !has_many_slivers(prepared);
}

bool is_as_good(const Prepared& prepared, const Prepared& other) {
  return can_be_folded(prepared) && prepared.sliver_fraction <= other.sliver_fraction &&
         prepared.model.surface.component_count() <= other.model.surface.component_count() &&
         prepared.simplified.cramped_fraction <=
             std::max(hardly_cramped, other.simplified.cramped_fraction) &&
         (!is_spoilt(prepared) || is_spoilt(other));
}

Prepared prepare(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                 const PanelRoom& room, const Context& context) {
  std::optional<mesh::Model> kept;
  if (model.surface.face_count() <= most_tried_faces) {
    kept = model;
  }
  Prepared prepared = prepare_at_size(std::move(model), size, simplify, room, context);
  if (!kept) {
    return prepared;
  }
  const SizeSearch search(*kept, simplify, room, context);
  SizeChoice choice(std::move(prepared), size, search);
  return size.adapts ? choice.at_fitting_size() : choice.at_its_size();
}

Prepared prepare_as_asked(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                          const PanelRoom& room, const Context& context) {
  return prepare_at_size(std::move(model), size, simplify, room, context);
}

}  // namespace ridgecraft::prepare
