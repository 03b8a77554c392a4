// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/body.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include "mesh/model/surface_distance.hpp"
#include "prepare/collapses/collapse_sequence.hpp"
#include "prepare/collapses/quick_collapses.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
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

/// Collapses keep to this fraction of the deviation allowed, since they measure it at few points.
constexpr double bound = 0.9;
/// A body that can't become what the rules ask for is left as it is unless its share of short edges sinks by
/// this much, ...
constexpr double least_gain = 0.05;
/// ... or its work by this share.
constexpr double least_saved = 0.1;

/// The work that a body with its copies is.
class Judge {
 public:
  Judge(const BodyRules& rules, std::size_t copies)
      : rules_(rules), bodies_(static_cast<double>(1 + copies)) {}

  [[nodiscard]] Work work(const mesh::Surface& surface) const {
    return expected_work(surface, rules_.options);
  }
  [[nodiscard]] double minutes(const Work& work) const { return bodies_ * minutes_of(work); }
  [[nodiscard]] bool allows(const Work& work, std::size_t faces) const {
    return faces <= rules_.most_faces && work.short_share() <= rules_.options.budget.short_share &&
           work.weak_share() <= rules_.options.budget.weak_share && minutes(work) <= rules_.most_minutes;
  }

 private:
  const BodyRules& rules_;
  double bodies_;
};

/// A place in a sequence, and what the body is like there.
struct Candidate {
  FundamentalDomain domain;
  Work work;
  bool allowed = false;
};

/// Looks in a sequence for the largest number of faces that the rules allow.
class Search {
 public:
  Search(const Sequence& sequence, const mesh::SurfaceTree& original, const BodyRules& rules,
         const Judge& judge, const Context& context)
      : sequence_(sequence), original_(original), rules_(rules), judge_(judge), context_(context) {}

  [[nodiscard]] Candidate best() const {
    std::size_t count = fewest_allowed().value_or(sequence_.all());
    if (deviation(count) > rules_.largest_mm) {
      count = most_within(count);
    }
    Candidate candidate;
    candidate.domain = sequence_.domain(count);
    candidate.work = work(count);
    candidate.allowed = judge_.allows(candidate.work, sequence_.faces_after(count));
    return candidate;
  }

 private:
  [[nodiscard]] Work work(std::size_t count) const { return judge_.work(sequence_.after(count).surface); }
  [[nodiscard]] bool allowed(std::size_t count) const {
    return judge_.allows(work(count), sequence_.faces_after(count));
  }
  [[nodiscard]] double deviation(std::size_t count) const {
    const mesh::Model model = sequence_.after(count);
    return greatest_distance(mesh::SurfaceTree(model.surface, rules_.spacing_mm), original_,
                             rules_.largest_mm, context_);
  }

  /// Fewest collapses after which the rules allow the body, as bisection finds it (the share of short edges
  /// needn't be monotonous); none where none of the numbers tried helps.
  [[nodiscard]] std::optional<std::size_t> fewest_allowed() const {
    std::size_t too_few = 0;
    std::size_t enough = std::max<std::size_t>(1, sequence_.count_for(sequence_.faces_after(0) * 5 / 6));
    while (!allowed(enough)) {
      if (enough == sequence_.all()) {
        return std::nullopt;
      }
      too_few = enough;
      enough = std::max(enough + 1, sequence_.count_for(sequence_.faces_after(enough) * 5 / 6));
    }
    while (enough - too_few > 1 + sequence_.faces_after(enough) / 400) {
      const std::size_t middle = too_few + (enough - too_few) / 2;
      (allowed(middle) ? enough : too_few) = middle;
    }
    return enough;
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
  const Judge& judge_;
  const Context& context_;
};

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

}  // namespace

SimplifiedBody simplified_body(const FundamentalDomain& body, const BodyRules& of_model,
                               const Context& context) {
  const std::size_t faces_before = body.face_count();
  // The whole was remeshed before; what a cut at a mirror plane adds to so many faces doesn't count.
  const mesh::Model before = faces_before > very_many_faces ? as_it_is(body, of_model.model)
                                                            : model_of(body, of_model.model, context);
  BodyRules rules = of_model;
  rules.largest_mm = std::min(rules.largest_mm, move_allowed(before.surface.bounds()));
  const Judge judge(rules, body.copies.size());
  const Work work_before = judge.work(before.surface);
  SimplifiedBody result{body, false, judge.minutes(work_before)};
  if (judge.allows(work_before, faces_before)) {
    return result;
  }
  const mesh::SurfaceTree original(before.surface, rules.spacing_mm);
  const FundamentalDomain start = coarse_start(body, before.surface, original, rules, context);
  mesh::NearField field(original, bound * rules.largest_mm);
  const CollapseRules how{.short_edge = rules.options.short_edge_mm,
                          .field = &field,
                          .largest_deviation = bound * rules.largest_mm,
                          .faces = fewest_faces};
  const Sequence sequence(start, rules.model, *rules.walls, how, context);
  if (sequence.all() == 0) {
    return result;
  }
  Candidate best = Search(sequence, original, rules, judge, context).best();
  const bool pays = best.allowed || work_before.short_share() - best.work.short_share() >= least_gain ||
                    judge.minutes(best.work) <= (1.0 - least_saved) * result.minutes;
  if (pays) {
    result = {std::move(best.domain), true, judge.minutes(best.work)};
  }
  return result;
}

}  // namespace ridgecraft::prepare
