// SPDX-License-Identifier: GPL-3.0-or-later
// Which size a model gets where nobody asked for one, and which one it would need.
#include "prepare/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "prepare/at_size.hpp"
#include "prepare/prepared/expected_pages.hpp"
#include "prepare/prepared/seen_move.hpp"

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
constexpr double time_share = 0.3;
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

/// Turned edges make slivers go, but not what made them: short sides, where tabs find no room. So for the
/// choice of a size they count as the slivers that they were.
bool suits(const Prepared& prepared) {
  const auto faces = static_cast<double>(prepared.model.surface.face_count());
  const double turned = static_cast<double>(prepared.simplified.edges_turned) / faces;
  return can_be_folded(prepared) && prepared.sliver_share + turned <= allowed_slivers(prepared);
}

bool is_cramped(const Prepared& prepared) {
  return prepared.simplified.cramped_share > most_cramped;
}

bool is_spoilt(const Prepared& prepared) {
  return seen_move(prepared.simplified.deviation_mm, prepared.model.surface.bounds()) != SeenMove::none;
}

/// Neither its folds nor its tabs and numbers lack room, and its shape is the file's.
bool is_roomy(const Prepared& prepared) {
  return suits(prepared) && !is_cramped(prepared) && !is_spoilt(prepared);
}

double extent_of(const Prepared& prepared) {
  return prepared.model.surface.bounds().largest_extent();
}

class SizeSearch {
 public:
  SizeSearch(const mesh::Model& model, const SimplifyOptions& simplify, const PanelRoom& room,
             const Context& context)
      : model_(model), simplify_(simplify), room_(room), context_(until_deadline(context, time_share)) {}

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
    double to_beat =
        is_cramped(usual) ? std::max(most_cramped, worth_paper * usual.simplified.cramped_share) : unbeaten;
    in_time([&] {
      for_larger(extent_of(usual), size.largest_mm, [&](Prepared found) {
        if (pages(found) > size.most_pages) {
          return false;
        }
        if (!suits(found)) {
          return true;
        }
        const double share = found.simplified.cramped_share;
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
      return suits(*found) ? std::move(found) : std::nullopt;
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

/// Coarser, where it can't be folded or lacks room as it is, and has room so.
std::optional<Prepared> roomy_if_coarser(const Prepared& usual, const SizeOptions& size,
                                         const SizeSearch& search) {
  if (can_be_folded(usual) && !is_cramped(usual)) {
    return std::nullopt;
  }
  return search.coarser(size, is_roomy);
}

/// Coarser, where it doesn't suit as it is.
Prepared foldable_at_its_size(Prepared usual, const SizeOptions& size, const SizeSearch& search) {
  if (suits(usual)) {
    return usual;
  }
  if (!can_be_folded(usual)) {
    if (std::optional<Prepared> coarser = search.coarser(size, can_be_folded)) {
      return std::move(*coarser);
    }
  }
  return usual;
}

/// As it is best at its size, the same whether somebody asked for that size or not.
Prepared best_at_its_size(Prepared usual, const SizeOptions& size, const SizeSearch& search) {
  if (std::optional<Prepared> coarser = roomy_if_coarser(usual, size, search)) {
    return std::move(*coarser);
  }
  return foldable_at_its_size(std::move(usual), size, search);
}

/// Of a size at which it can be folded, if there is one within the limits.
Prepared of_foldable_size(Prepared usual, const SizeOptions& size, const SizeSearch& search) {
  if (suits(usual)) {
    return usual;
  }
  if (std::optional<Prepared> coarser = roomy_if_coarser(usual, size, search)) {
    return std::move(*coarser);
  }
  std::optional<double> foldable_mm;
  std::optional<Prepared> larger = search.larger(extent_of(usual), suits, foldable_mm);
  if (larger && extent_of(*larger) <= size.largest_mm && search.pages(*larger) <= size.most_pages) {
    larger->size_reason = SizeReason::folds;
    return std::move(*larger);
  }
  Prepared best = foldable_at_its_size(std::move(usual), size, search);
  if (!can_be_folded(best)) {
    best.smallest_size_mm = foldable_mm;
  }
  return best;
}

/// Of the size that it has by default, or of another one between the limits that suits it better.
Prepared of_fitting_size(Prepared usual, const SizeOptions& size, const SizeSearch& search) {
  Prepared foldable = of_foldable_size(std::move(usual), size, search);
  if (!suits(foldable)) {
    return foldable;
  }
  const double pages = search.pages(foldable);
  const double fitting = std::max(
      size.smallest_mm,
      centimetre * std::floor(extent_of(foldable) * std::sqrt(size.most_pages / pages) / centimetre));
  if (pages > size.most_pages && fitting < extent_of(foldable)) {
    if (std::optional<Prepared> smaller = search.smaller(fitting)) {
      smaller->size_reason = SizeReason::pages;
      return std::move(*smaller);
    }
  } else if (is_cramped(foldable) || (search.simplifies() && is_spoilt(foldable))) {
    if (std::optional<Prepared> roomier = search.roomier(foldable, size)) {
      roomier->size_reason = foldable.size_reason != SizeReason::none ? foldable.size_reason
                             : is_cramped(foldable)                   ? SizeReason::room
                                                                      : SizeReason::shape;
      foldable = std::move(*roomier);
    }
  }
  SizeOptions same = size;
  same.largest_extent_mm = extent_of(foldable);
  const SizeReason reason = foldable.size_reason;
  foldable = best_at_its_size(std::move(foldable), same, search);
  foldable.size_reason = reason;
  return foldable;
}

}  // namespace

bool has_many_slivers(const Prepared& prepared) {
  return prepared.sliver_share > allowed_slivers(prepared);
}

bool can_be_folded(const Prepared& prepared) {
  return !prepared.simplified.still_too_fine && !has_many_slivers(prepared);
}

bool is_as_good(const Prepared& prepared, const Prepared& other) {
  return suits(prepared) && prepared.sliver_share <= other.sliver_share &&
         prepared.model.surface.component_count() <= other.model.surface.component_count() &&
         prepared.simplified.cramped_share <= std::max(hardly_cramped, other.simplified.cramped_share) &&
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
  if (size.adapts) {
    return of_fitting_size(std::move(prepared), size, search);
  }
  prepared = best_at_its_size(std::move(prepared), size, search);
  if (!can_be_folded(prepared)) {
    search.larger(extent_of(prepared), can_be_folded, prepared.smallest_size_mm);
  }
  return prepared;
}

Prepared prepare_as_asked(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                          const PanelRoom& room, const Context& context) {
  return prepare_at_size(std::move(model), size, simplify, room, context);
}

}  // namespace ridgecraft::prepare
