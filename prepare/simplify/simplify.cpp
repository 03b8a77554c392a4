// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/simplify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/simplify/collapse_sequence.hpp"
#include "prepare/simplify/symmetric_share.hpp"
#include "prepare/simplify/walls.hpp"
#include "prepare/simplify/whole.hpp"

namespace ridgecraft::prepare {
namespace {

/// Nothing recognisable is left below this many faces.
constexpr std::size_t fewest_faces = 16;
/// Samples for the deviation are this share of the largest extent apart.
constexpr double sample_spacing = 0.015;
/// Down to this multiple of the faces that short edges would give, no care is needed.
constexpr double coarse = 3.0;
/// How strongly short edges are preferred; which is best depends on the model, so each is tried.
constexpr std::array<double, 2> powers{2.0, 6.0};
/// Collapses keep to this share of the deviation allowed, since they measure it at few points.
constexpr double bound = 0.9;
/// A component that is smaller than this share of the short edge in every direction vanishes when the model
/// is too fine: it could neither be cut nor held.
constexpr double speck = 0.5;
/// A model that is off its mirror image by no more than this share of its extent becomes symmetric: a fifth
/// of what simplification may move it.
constexpr double symmetric_within = 0.004;
/// Below this, as a share of the extent, sides are equal but for a file's digits.
constexpr double equal_sides = 1e-5;

/// Drops components that are specks unless all are; returns how many.
std::size_t drop_specks(mesh::Model& model, double smallest_mm) {
  const mesh::Surface& surface = model.surface;
  std::vector<Box3> boxes(surface.component_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    for (const VertexId v : surface.vertices(f)) {
      boxes[surface.component(f).value()].add(surface.point(v));
    }
  }
  const auto is_speck = [&](const Box3& box) { return box.largest_extent() < smallest_mm; };
  const auto specks = static_cast<std::size_t>(std::count_if(boxes.begin(), boxes.end(), is_speck));
  if (specks == 0 || specks == boxes.size()) {
    return 0;
  }
  const mesh::LooseFaces all = mesh::take_apart(model);
  mesh::LooseFaces kept;
  kept.points = all.points;
  for (std::size_t f = 0; f < all.faces.size(); ++f) {
    if (!is_speck(boxes[surface.component(FaceId(f)).value()])) {
      kept.add(all, f, all.faces[f], all.texture.empty() ? std::array<Vec2, 3>{} : all.texture[f]);
    }
  }
  mesh::put_together(model, std::move(kept));
  return specks;
}

/// A surface of equilateral triangles with the short edge has so many faces.
double faces_of_short_edges(const mesh::Surface& surface, double short_edge_mm) {
  const double small_face = 0.25 * std::numbers::sqrt3 * short_edge_mm * short_edge_mm;
  return std::clamp(mesh::total_area(surface) / small_face, double{fewest_faces}, 1e9);
}

/// One sequence of collapses and the model after any number of them.
class Sequence {
 public:
  /// `model` must outlive it.
  Sequence(SymmetricShare start, const mesh::LooseFaces& model, const Walls& walls, std::size_t faces,
           const CollapseRules& rules, const Context& context)
      : start_(std::move(start)),
        model_(model),
        context_(context),
        collapses_(collapse_sequence(start_.faces, start_.points, walls_of(walls, start_), faces, rules, context)) {}

  [[nodiscard]] std::size_t all() const { return collapses_.size(); }
  [[nodiscard]] std::size_t faces_after(std::size_t count) const {
    return count == 0 ? start_.face_count() : collapses_[count - 1].faces;
  }
  /// Fewest collapses that leave at most so many faces; all() where that can't be reached.
  [[nodiscard]] std::size_t count_for(std::size_t faces) const {
    if (start_.face_count() <= faces) {
      return 0;
    }
    const auto found = std::partition_point(collapses_.begin(), collapses_.end(),
                                            [&](const Collapse& c) { return c.faces > faces; });
    return std::min(static_cast<std::size_t>(found - collapses_.begin()) + 1, collapses_.size());
  }
  [[nodiscard]] SymmetricShare share(std::size_t count) const {
    return collapsed(start_, std::span(collapses_).first(count));
  }
  /// With its panels remeshed.
  [[nodiscard]] mesh::Model after(std::size_t count) const {
    mesh::Model result;
    mesh::put_together(result, whole(share(count), model_));
    remesh_panels(result, context_);
    return result;
  }

 private:
  SymmetricShare start_;
  const mesh::LooseFaces& model_;
  const Context& context_;
  std::vector<Collapse> collapses_;
};

/// A place in a sequence, and what the model is like there.
struct Candidate {
  mesh::Model model;
  double share = 1.0;      ///< of short folds
  double deviation = 0.0;  ///< mm
  bool foldable = false;
};

/// Looks in a sequence for the largest number of faces that can be folded.
class Search {
 public:
  Search(const Sequence& sequence, const mesh::SurfaceTree& original, const SimplifyOptions& options,
         double spacing, double largest_mm, const Context& context)
      : sequence_(sequence),
        original_(original),
        options_(options),
        spacing_(spacing),
        largest_mm_(largest_mm),
        context_(context) {}

  [[nodiscard]] Candidate best() const {
    std::size_t count = 0;
    Candidate candidate;
    if (const auto found = fewest_foldable()) {
      count = *found;
      candidate.foldable = true;
    } else {
      count = least_share();
    }
    candidate.model = sequence_.after(count);
    candidate.deviation = deviation(candidate.model);
    if (candidate.deviation > largest_mm_) {
      count = most_within(count);
      candidate.foldable = false;
      candidate.model = sequence_.after(count);
      candidate.deviation = deviation(candidate.model);
    }
    candidate.share = short_fold_share(candidate.model.surface, options_);
    return candidate;
  }

 private:
  [[nodiscard]] double share(std::size_t count) const {
    return short_fold_share(sequence_.after(count).surface, options_);
  }
  [[nodiscard]] bool foldable(std::size_t count) const { return share(count) <= options_.short_edge_share; }
  [[nodiscard]] double deviation(const mesh::Model& model) const {
    return greatest_distance(mesh::SurfaceTree(model.surface, spacing_), original_, largest_mm_, context_);
  }

  /// Fewest collapses after which the model is foldable, as bisection finds it (the share needn't be
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

  /// Where nothing is foldable: the smallest share of short folds that a few numbers of faces give.
  [[nodiscard]] std::size_t least_share() const {
    std::size_t best = 0;
    double least = share(0);
    for (std::size_t count = 1; count < sequence_.all();) {
      count = std::max(count + 1, sequence_.count_for(sequence_.faces_after(count) * 5 / 6));
      const double now = share(count);
      // A hair less is not worth losing a sixth of the faces for.
      if (now < least - 0.01) {
        least = now;
        best = count;
      }
    }
    return best;
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
      (deviation(sequence_.after(middle)) <= largest_mm_ ? fine : too_many) = middle;
    }
    return fine;
  }

  const Sequence& sequence_;
  const mesh::SurfaceTree& original_;
  const SimplifyOptions& options_;
  double spacing_;
  double largest_mm_;
  const Context& context_;
};

bool better(const Candidate& a, const Candidate& b) {
  if (a.foldable != b.foldable) {
    return a.foldable;
  }
  return a.foldable ? a.model.surface.face_count() > b.model.surface.face_count() : a.share < b.share;
}

void take_over(mesh::Model& model, mesh::Model&& simplified) {
  model.surface = std::move(simplified.surface);
  model.polygon = std::move(simplified.polygon);
  model.material = std::move(simplified.material);
  model.texture = std::move(simplified.texture);
}

/// How far the sides of a model were from being mirror images; 0 where no digit would tell.
double evened(const SymmetricShare& share, const mesh::Model& model) {
  return share.deviation > equal_sides * model.surface.bounds().largest_extent() ? share.deviation : 0.0;
}

void simplify_to_fold(mesh::Model& model, const SimplifyOptions& options, SimplifyReport& report,
                      const Context& context) {
  report.specks_dropped = drop_specks(model, speck * options.short_edge_mm);
  const double spacing = sample_spacing * model.surface.bounds().largest_extent();
  const double largest_mm = options.largest_deviation * model.surface.bounds().largest_extent();
  const mesh::SurfaceTree original(model.surface, spacing);
  const mesh::LooseFaces all = mesh::take_apart(model);
  const Walls walls = find_walls(model.surface, find_panels(model.surface), options.short_edge_mm);
  SymmetricShare start = symmetric_share(model, symmetric_within, context);
  const double evened_mm = evened(start, model);
  // Far from the aim the surface hardly moves: there the plain error is good and fast.
  const auto far =
      static_cast<std::size_t>(coarse * faces_of_short_edges(model.surface, options.short_edge_mm));
  if (start.face_count() > far) {
    const Sequence first(start, all, walls, far, {options.short_edge_mm}, context);
    mesh::Model coarser = first.after(first.all());
    if (greatest_distance(mesh::SurfaceTree(coarser.surface, spacing), original, largest_mm, context) <=
        largest_mm) {
      start = first.share(first.all());
    }
  }
  mesh::NearField field(original, bound * largest_mm);
  std::optional<Candidate> best;
  for (const double power : powers) {
    const CollapseRules rules{options.short_edge_mm, power, &field, bound * largest_mm};
    const Sequence sequence(start, all, walls, fewest_faces, rules, context);
    if (sequence.all() > 0) {
      Candidate candidate = Search(sequence, original, options, spacing, largest_mm, context).best();
      if (!best || better(candidate, *best)) {
        best = std::move(candidate);
      }
    } else if (!best) {
      // Nothing more can go: what the first sequence left is the result.
      best.emplace();
      best->model = sequence.after(0);
      best->share = short_fold_share(best->model.surface, options);
      best->foldable = best->share <= options.short_edge_share;
      best->deviation =
          greatest_distance(mesh::SurfaceTree(best->model.surface, spacing), original, INFINITY, context);
    }
  }
  if (best && best->model.surface.face_count() < report.faces_before) {
    report.deviation_mm = best->deviation;
    report.evened_mm = evened_mm;
    take_over(model, std::move(best->model));
  }
  report.still_too_fine = !best || !best->foldable;
}

void simplify_to_count(mesh::Model& model, const SimplifyOptions& options, SimplifyReport& report,
                       const Context& context) {
  const double spacing = sample_spacing * model.surface.bounds().largest_extent();
  const mesh::Surface before = model.surface;
  const mesh::LooseFaces all = mesh::take_apart(model);
  const Walls walls = find_walls(model.surface, find_panels(model.surface), options.short_edge_mm);
  SymmetricShare share = symmetric_share(model, symmetric_within, context);
  report.evened_mm = evened(share, model);
  const Sequence sequence(std::move(share), all, walls, options.faces, {options.short_edge_mm}, context);
  take_over(model, sequence.after(sequence.all()));
  report.deviation_mm = greatest_distance(mesh::SurfaceTree(model.surface, spacing),
                                          mesh::SurfaceTree(before, spacing), INFINITY, context);
}

}  // namespace

double short_fold_share(const mesh::Surface& surface, const SimplifyOptions& options) {
  const Panels panels = find_panels(surface);
  std::size_t folds = 0;
  std::size_t brief = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (d.valid() && panels.panel[mesh::face_of(c)] != panels.panel[mesh::face_of(d)] &&
        std::abs(surface.fold_angle(e)) >= options.hidden_fold_angle) {
      ++folds;
      brief += surface.length(e) < options.short_edge_mm ? 1U : 0U;
    }
  }
  return folds == 0 ? 0.0 : static_cast<double>(brief) / static_cast<double>(folds);
}

SimplifyReport simplify(mesh::Model& model, const SimplifyOptions& options, const Context& context) {
  SimplifyReport report;
  report.faces_before = model.surface.face_count();
  report.short_edges_before = short_fold_share(model.surface, options);
  if (options.mode == Simplification::automatic && report.short_edges_before > options.short_edge_share) {
    simplify_to_fold(model, options, report, context);
  }
  if (options.mode == Simplification::count && model.surface.face_count() > options.faces) {
    simplify_to_count(model, options, report, context);
  }
  report.faces_after = model.surface.face_count();
  report.short_edges_after = short_fold_share(model.surface, options);
  return report;
}

}  // namespace ridgecraft::prepare
