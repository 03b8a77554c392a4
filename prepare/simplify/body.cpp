// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "mesh/model/surface_distance.hpp"
#include "prepare/collapses/collapse_sequence.hpp"
#include "prepare/collapses/quick_collapses.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Nothing recognisable is left of a body below this many faces: a box.
constexpr std::size_t fewest_faces = 12;
/// Of bodies of more faces flat regions aren't remeshed, and the first collapses are made many at a time, ...
constexpr std::size_t very_many_faces = 100000;
/// ... down to this multiple of what needs no care.
constexpr std::size_t quick = 4;
/// They may move the surface by this fraction of what it may move.
constexpr double quick_fraction = 0.1;
constexpr double coarse = 3.0;
/// A surface of equilateral triangles with the short edge has so many faces.
double faces_of_short_edges(const mesh::Surface& surface, double short_edge_mm) {
  const double small_face = 0.25 * std::numbers::sqrt3 * short_edge_mm * short_edge_mm;
  return std::clamp(mesh::total_area(surface) / small_face, double{fewest_faces}, 1e9);
}

/// Down to so many faces of a surface in mm no care is needed: three times those that edges as long as the
/// short one would give. Linear.
std::size_t careless_faces(const mesh::Surface& surface, double short_edge_mm) {
  return static_cast<std::size_t>(coarse * faces_of_short_edges(surface, short_edge_mm));
}

/// A domain without its copies as a model. `model` is the whole taken apart.
mesh::Model as_it_is(const FundamentalDomain& domain, const mesh::LooseFaces& model) {
  mesh::LooseFaces faces;
  if (domain.copies.empty()) {
    faces = expand(domain, model);
  } else {
    FundamentalDomain alone = domain;
    alone.copies.clear();
    faces = expand(alone, model);
  }
  mesh::Model result;
  mesh::put_together(result, std::move(faces));
  return result;
}

}  // namespace

mesh::Model model_of(const FundamentalDomain& domain, const mesh::LooseFaces& model, const Context& context) {
  mesh::Model result = as_it_is(domain, model);
  remesh_panels(result, context);
  return result;
}

Sequence::Sequence(FundamentalDomain start, const mesh::LooseFaces& model, const Walls& walls,
                   const CollapseRules& rules, const Context& context)
    : start_(std::move(start)),
      model_(&model),
      context_(&context),
      collapses_(collapse_sequence(start_, walls_of(walls, start_), rules, context)) {}

std::size_t Sequence::count_for(std::size_t faces) const {
  if (start_.face_count() <= faces) {
    return 0;
  }
  const auto found = std::partition_point(collapses_.begin(), collapses_.end(),
                                          [&](const Collapse& c) { return c.faces > faces; });
  return std::min(static_cast<std::size_t>(found - collapses_.begin()) + 1, collapses_.size());
}

namespace {

/// How strongly short edges are preferred; which is best depends on the model, so each is tried.
constexpr std::array<double, 2> powers{2.0, 6.0};
/// Collapses keep to this fraction of the deviation allowed, since they measure it at few points.
constexpr double bound = 0.9;
/// Bodies of more faces than this are made coarser than they must be, where the surface hardly moves by it
/// ...
constexpr std::size_t many_faces = 400;
/// ... and so are smooth ones of more than this: no wall of theirs becomes crooked by it ...
constexpr std::size_t many_smooth_faces = 120;
/// ... as a fraction of what it may move, until their edges aren't crowded.
constexpr double hardly = 0.5;
/// A body that can't be made foldable is left as it is unless its fraction of short folds sinks by this much,
/// ...
constexpr double least_gain = 0.05;
/// ... or this fraction of the folds that are no use to anybody vanishes.
constexpr double least_gone = 0.2;

/// A place in a sequence, and what the body is like there.
struct Candidate {
  FundamentalDomain domain;
  FoldFigures folds;
  bool foldable = false;
  bool crowded = false;
  std::size_t faces = 0;
};

/// Looks in a sequence for the largest number of faces that can be folded.
class Search {
 public:
  /// `many`: faces above which crowded ones get fewer.
  Search(const Sequence& sequence, const mesh::SurfaceTree& original, const BodyRules& rules,
         std::size_t many, const Context& context)
      : sequence_(sequence), original_(original), rules_(rules), many_(many), context_(context) {}

  [[nodiscard]] Candidate best() const {
    std::size_t count = 0;
    Candidate candidate;
    if (const auto found = fewest_foldable()) {
      count = *found;
      candidate.foldable = true;
    } else {
      count = std::max(least_fraction(), sequence_.count_for(rules_.most_faces));
    }
    if (deviation(count) > rules_.largest_mm) {
      count = most_within(count);
      candidate.foldable = false;
    }
    count = uncrowded(count);
    candidate.domain = sequence_.domain(count);
    candidate.folds = folds(count);
    candidate.crowded = sequence_.faces_after(count) > many_ && candidate.folds.crowded();
    candidate.faces = sequence_.faces_after(count);
    return candidate;
  }

 private:
  [[nodiscard]] FoldFigures folds(std::size_t count) const {
    return fold_figures(sequence_.after(count).surface, rules_.options);
  }
  [[nodiscard]] double brief(std::size_t count) const { return folds(count).short_fraction(); }
  [[nodiscard]] bool foldable(std::size_t count) const {
    return sequence_.faces_after(count) <= rules_.most_faces &&
           brief(count) <= rules_.options.short_edge_fraction;
  }
  [[nodiscard]] double deviation(std::size_t count) const {
    const mesh::Model model = sequence_.after(count);
    return greatest_distance(mesh::SurfaceTree(model.surface, rules_.spacing_mm), original_,
                             rules_.largest_mm, context_);
  }

  /// Fewest collapses after which the model is foldable, as bisection finds it (the fraction needn't be
  /// monotonous); none where none of the numbers tried helps.
  [[nodiscard]] std::optional<std::size_t> fewest_foldable() const {
    std::size_t too_few = 0;
    std::size_t enough = std::max<std::size_t>(1, sequence_.count_for(sequence_.faces_after(0) * 5 / 6));
    while (!foldable(enough)) {
      if (enough == sequence_.all()) {
        return std::nullopt;
      }
      too_few = enough;
      enough = std::max(enough + 1, sequence_.count_for(sequence_.faces_after(enough) * 5 / 6));
    }
    while (enough - too_few > 1 + sequence_.faces_after(enough) / 400) {
      const std::size_t middle = too_few + (enough - too_few) / 2;
      (foldable(middle) ? enough : too_few) = middle;
    }
    return enough;
  }

  /// Where nothing is foldable: the smallest fraction of short folds that a few numbers of faces give.
  [[nodiscard]] std::size_t least_fraction() const {
    std::size_t best = 0;
    double least = brief(0);
    for (std::size_t count = 1; count < sequence_.all();) {
      count = std::max(count + 1, sequence_.count_for(sequence_.faces_after(count) * 5 / 6));
      const double now = brief(count);
      // A hair less is not worth losing a sixth of the faces for.
      if (now < least - 0.01) {
        least = now;
        best = count;
      }
    }
    return best;
  }

  /// More collapses of a body that has many faces, as long as these are crowded and the surface hardly moves.
  [[nodiscard]] std::size_t uncrowded(std::size_t count) const {
    while (sequence_.faces_after(count) > many_ && folds(count).crowded()) {
      const std::size_t next =
          std::max(count + 1, sequence_.count_for(std::max(many_, sequence_.faces_after(count) * 9 / 10)));
      if (next > sequence_.all() ||
          brief(next) > std::max(brief(count), rules_.options.short_edge_fraction) ||
          deviation(next) > hardly * rules_.largest_mm) {
        break;
      }
      count = next;
    }
    return count;
  }

  /// Most collapses that keep the surface within the deviation; 0 where the first ones don't.
  [[nodiscard]] std::size_t most_within(std::size_t too_many) const {
    std::size_t fine = 0;
    while (too_many - fine > 1 + sequence_.faces_after(too_many) / 100) {
      // By faces, not by collapses: the last few count most.
      const auto faces =
          static_cast<std::size_t>(std::sqrt(static_cast<double>(sequence_.faces_after(fine)) *
                                             static_cast<double>(sequence_.faces_after(too_many))));
      const std::size_t middle = std::clamp(sequence_.count_for(faces), fine + 1, too_many - 1);
      (deviation(middle) <= rules_.largest_mm ? fine : too_many) = middle;
    }
    return fine;
  }

  const Sequence& sequence_;
  const mesh::SurfaceTree& original_;
  const BodyRules& rules_;
  std::size_t many_;
  const Context& context_;
};

bool better(const Candidate& a, const Candidate& b) {
  if (a.foldable != b.foldable) {
    return a.foldable;
  }
  if (a.crowded != b.crowded) {
    return b.crowded;
  }
  return a.foldable ? a.faces > b.faces : a.folds.short_fraction() < b.folds.short_fraction();
}

/// Whether the body is worth what it lost.
bool pays(const Candidate& candidate, const FoldFigures& before, std::size_t faces_before,
          std::size_t most_faces) {
  const double tiny = static_cast<double>(before.tiny);
  return candidate.foldable || before.short_fraction() - candidate.folds.short_fraction() >= least_gain ||
         (before.tiny > 0 && static_cast<double>(candidate.folds.tiny) <= (1.0 - least_gone) * tiny) ||
         (faces_before > most_faces && candidate.faces < faces_before);
}

/// Far from the aim the surface hardly moves: there the plain error is good and fast.
FundamentalDomain coarse_start(const FundamentalDomain& body, const mesh::Surface& before,
                               const mesh::SurfaceTree& original, const BodyRules& rules,
                               const Context& context) {
  const std::size_t copies = std::max<std::size_t>(1, 1 + body.copies.size());
  const std::size_t far = copies * careless_faces(before, rules.options.short_edge_mm);
  if (body.face_count() <= far) {
    return body;
  }
  FundamentalDomain start = body;
  if (body.face_count() > std::max(very_many_faces, 2 * quick * far)) {
    start = collapsed(body, quick_collapses(body, walls_of(*rules.walls, body), quick * far,
                                            quick_fraction * rules.largest_mm, context));
  }
  const Sequence first(start, rules.model, *rules.walls,
                       {.short_edge = rules.options.short_edge_mm, .faces = far}, context);
  const mesh::Model coarser = first.after(first.all());
  const double distance = greatest_distance(mesh::SurfaceTree(coarser.surface, rules.spacing_mm), original,
                                            rules.largest_mm, context);
  return distance <= rules.largest_mm ? first.domain(first.all()) : body;
}

/// Faces above which crowded ones get fewer.
std::size_t many_faces_of(const FundamentalDomain& body, const Walls& of_model) {
  const Walls walls = walls_of(of_model, body);
  const bool smooth = std::all_of(walls.of_face.begin(), walls.of_face.end(),
                                  [](std::uint32_t wall) { return wall == Walls::none; });
  return smooth ? many_smooth_faces : many_faces;
}

/// What a sequence without any collapses leaves.
Candidate unchanged(const FundamentalDomain& start, const Sequence& sequence, const BodyRules& rules) {
  Candidate candidate;
  candidate.domain = start;
  candidate.faces = start.face_count();
  candidate.folds = fold_figures(sequence.after(0).surface, rules.options);
  candidate.foldable = candidate.folds.short_fraction() <= rules.options.short_edge_fraction &&
                       candidate.faces <= rules.most_faces;
  return candidate;
}

}  // namespace

std::optional<FundamentalDomain> simplified_body(const FundamentalDomain& body, const BodyRules& rules,
                                                 const Context& context) {
  const std::size_t faces_before = body.face_count();
  // The whole was remeshed before; what a cut at a mirror plane adds to so many faces doesn't count.
  const mesh::Model before =
      faces_before > very_many_faces ? as_it_is(body, rules.model) : model_of(body, rules.model, context);
  const FoldFigures folds_before = fold_figures(before.surface, rules.options);
  if (folds_before.short_fraction() <= rules.options.short_edge_fraction &&
      faces_before <= rules.most_faces) {
    return std::nullopt;
  }
  const mesh::SurfaceTree original(before.surface, rules.spacing_mm);
  const FundamentalDomain start = coarse_start(body, before.surface, original, rules, context);
  const std::size_t many = many_faces_of(body, *rules.walls);
  mesh::NearField field(original, bound * rules.largest_mm);
  std::optional<Candidate> best;
  for (const double power : powers) {
    const CollapseRules how{rules.options.short_edge_mm, power, &field, bound * rules.largest_mm,
                            fewest_faces};
    const Sequence sequence(start, rules.model, *rules.walls, how, context);
    Candidate candidate = sequence.all() > 0 ? Search(sequence, original, rules, many, context).best()
                                             : unchanged(start, sequence, rules);
    if (!best || better(candidate, *best)) {
      best = std::move(candidate);
    }
  }
  if (!pays(*best, folds_before, faces_before, rules.most_faces)) {
    return std::nullopt;
  }
  return std::move(best->domain);
}

}  // namespace ridgecraft::prepare
