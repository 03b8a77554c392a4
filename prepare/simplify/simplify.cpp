// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/simplify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/no_index.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/domains/find_domain.hpp"
#include "prepare/features/merge_rolls.hpp"
#include "prepare/features/round_rolls.hpp"
#include "prepare/features/thin_rulings.hpp"
#include "prepare/features/trim_reliefs.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/effort.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/rolls.hpp"
#include "prepare/simplify/body.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Samples by which it is measured how far a surface moved are this share of its largest extent apart.
constexpr double sample_spacing = 0.015;
/// Where a model is too much work, bodies with so few faces keep theirs.
constexpr std::size_t few_faces = 24;
/// What counts as a detail is so many times larger in each further attempt. The surface may move by the root
/// of that times as much: nobody builds a model that is too much work.
constexpr double detail_step = 1.5;
constexpr double most_detail = 12.0;
/// The step is taken twice at once where so much is left, and with models of more faces, whose attempts take
/// long.
constexpr double much_left = 1.0;
constexpr std::size_t fine_faces = 10000;
/// The same where a number of faces is asked for; 0: there are no walls.
constexpr std::array<double, 4> fewer_walls{1.0, 2.0, 4.0, 0.0};
/// A model that is off its mirror image by no more than this share of its extent becomes symmetric: a fifth
/// of what simplification may move it.
constexpr double symmetric_within = 0.004;
/// Below this, as a share of the extent, sides are equal but for a file's digits.
constexpr double equal_sides = 1e-5;

double deviation_between(const mesh::Surface& after, const mesh::Surface& before, const Context& context) {
  const double spacing_mm = sample_spacing * before.bounds().largest_extent();
  return measured_distance(mesh::SurfaceTree(after, spacing_mm), mesh::SurfaceTree(before, spacing_mm),
                           context);
}

/// How far the sides of a model were from being mirror images; 0 where no digit would tell.
double visible_asymmetry(double asymmetry, const mesh::Model& model) {
  return asymmetry > equal_sides * model.surface.bounds().largest_extent() ? asymmetry : 0.0;
}

bool has_few_faces(const FundamentalDomain& body) {
  return body.face_count() <= few_faces * (1 + body.copies.size());
}

/// Each as it needs; and where they are too much work together, those that have many faces get fewer. Returns
/// whether anything changed.
bool simplify_bodies(std::vector<FundamentalDomain>& bodies, BodyRules rules, const Context& context) {
  const double most_minutes = rules.most_minutes;
  const std::size_t most_faces = rules.most_faces;
  const std::vector<FundamentalDomain> before = bodies;
  std::vector<SimplifiedBody> now;
  double all = 0.0;  // minutes
  double of_few = 0.0;
  std::size_t faces = 0;
  std::size_t faces_of_few = 0;
  for (const FundamentalDomain& body : before) {
    now.push_back(simplified_body(body, rules, context));
    const FundamentalDomain& domain = now.back().domain;
    all += now.back().minutes;
    faces += domain.face_count();
    of_few += has_few_faces(domain) ? now.back().minutes : 0.0;
    faces_of_few += has_few_faces(domain) ? domain.face_count() : 0;
  }
  if (before.size() > 1 && (all > most_minutes || faces > most_faces)) {
    // What those with few faces keep is lacking to the others.
    const double of_minutes = std::max(0.0, most_minutes - of_few) / std::max(all - of_few, 1e-9);
    const double of_faces = static_cast<double>(most_faces - std::min(most_faces, faces_of_few)) /
                            static_cast<double>(std::max<std::size_t>(faces - faces_of_few, 1));
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (!has_few_faces(now[i].domain)) {
        rules.most_minutes = std::min(1.0, of_minutes) * now[i].minutes;
        rules.most_faces = static_cast<std::size_t>(std::min(1.0, of_faces) *
                                                    static_cast<double>(now[i].domain.face_count()));
        now[i] = simplified_body(before[i], rules, context);
      }
    }
  }
  bool changed = false;
  for (std::size_t i = 0; i < before.size(); ++i) {
    changed = changed || now[i].changed;
    bodies[i] = std::move(now[i].domain);
  }
  return changed;
}

/// What is done to whole bodies and walls before edges collapse. Returns whether anything changed.
bool remove_details(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                    SimplifyReport& report, const Context& context) {
  report.features_removed = trim_reliefs(model, options, std::min(largest_mm, options.tiny_edge_mm), context);
  const std::size_t rulings = thin_rulings(model, options, largest_mm, context);
  report.rulings_removed += rulings;
  return report.features_removed + rulings > 0;
}

/// Puts simplified faces in place of the model's surface; measures how far they are from the one before.
void take_over(mesh::Model& model, mesh::LooseFaces&& faces, const mesh::Surface& before,
               SimplifyReport& report, const Context& context) {
  mesh::Model simplified;
  mesh::put_together(simplified, std::move(faces));
  remesh_panels(simplified, context);
  report.deviation_mm = deviation_between(simplified.surface, before, context);
  model.surface = std::move(simplified.surface);
  model.polygon = std::move(simplified.polygon);
  model.material = std::move(simplified.material);
  model.object = std::move(simplified.object);
  model.texture = {};
}

/// What a model may be at most.
struct Most {
  double minutes = std::numeric_limits<double>::infinity();
  std::size_t faces = no_index;
};

/// Faces that a person builds in an hour.
constexpr double faces_per_hour = 70.0;

/// The short edge of which walls are multiples: no wall is smaller than the faces that the hours allow.
double wall_edge(const mesh::Surface& surface, const SimplifyOptions& options) {
  const double face_mm2 = mesh::total_area(surface) / (faces_per_hour * options.budget.hours);
  return std::max(options.short_edge_mm, std::sqrt(0.25 * face_mm2));
}

/// Flat regions between the rulings of what is rolled are walls, too, however low: work that costs nothing
/// needn't become less. Where their sides along the rims are short on average, they are details as others.
void add_rolled_walls(const mesh::Surface& surface, const Panels& panels, const SimplifyOptions& options,
                      Walls& walls) {
  for (const Roll& roll : find_rolls(surface, panels, options.rolls).rolls) {
    double area = 0.0;
    double rulings_mm = 0.0;
    std::vector<FaceId> faces;
    for (std::size_t i = 0; i < roll.rulings.size(); ++i) {
      rulings_mm += surface.length(roll.rulings[i]);
      if (i > 0 || roll.closed) {
        const std::vector<FaceId>& bay = panels.faces[roll.panels[i]];
        faces.insert(faces.end(), bay.begin(), bay.end());
      }
    }
    for (const FaceId f : faces) {
      area += surface.area(f);
    }
    if (area < options.short_edge_mm * rulings_mm) {
      continue;
    }
    for (const FaceId f : faces) {
      if (walls.of_face[f.value()] == Walls::none) {
        walls.of_face[f.value()] = static_cast<std::uint32_t>(walls.walls.size());
        const Vec3 normal = surface.normal(f);
        walls.walls.push_back({normal, dot(normal, surface.point(surface.vertices(f)[0]))});
      }
    }
  }
}

/// One attempt: what the options call details goes, and then edges until the model is no more than that.
void simplify_once(mesh::Model& model, const SimplifyOptions& options, const Most& most,
                   SimplifyReport& report, const Context& context) {
  const mesh::Surface before = model.surface;
  const double extent = before.bounds().largest_extent();
  const double largest_mm = options.largest_deviation * extent;
  const bool changed = remove_details(model, options, largest_mm, report, context);
  const mesh::LooseFaces all = mesh::take_apart(model);
  const Panels panels = find_panels(model.surface);
  Walls walls = find_walls(model.surface, panels, wall_edge(model.surface, options));
  add_rolled_walls(model.surface, panels, options, walls);
  FundamentalDomain start = fundamental_domain(model, symmetric_within, context);
  const double asymmetry_mm = visible_asymmetry(start.deviation, model);
  const BodyRules rules{all, &walls, sample_spacing * extent, largest_mm, most.minutes, most.faces, options};
  std::vector<FundamentalDomain> bodies = divided(start);
  start = {};  // large
  const bool collapsed = simplify_bodies(bodies, rules, context);
  if (changed || collapsed) {
    report.asymmetry_mm = asymmetry_mm;
    take_over(model, expand(joined(bodies), all), before, report, context);
  }
}

Work work_of(const mesh::Model& model, const SimplifyOptions& options) {
  return expected_work(model.surface, options);
}

/// The finest model that is not too much, as `too_much` tells by 0, or else the one that is so least, what
/// its surface moved counted in: what counts as a detail grows until then. The model stays where none is
/// less.
template <class TooMuch>
void simplify_by_details(mesh::Model& model, const SimplifyOptions& options, const Most& most,
                         SimplifyReport& report, const TooMuch& too_much, const Context& context) {
  const mesh::Model before = model;
  const SimplifyReport so_far = report;
  const double extent = before.surface.bounds().largest_extent();
  const bool fine = before.surface.face_count() > fine_faces;
  const double at_first = too_much(before);
  double least = std::numeric_limits<double>::infinity();
  double left = at_first;
  for (double scale = 1.0; scale < most_detail && left > 0.0;
       scale *= fine || left > much_left ? detail_step * detail_step : detail_step) {
    SimplifyOptions coarser = options;
    coarser.short_edge_mm *= scale;
    coarser.tiny_edge_mm *= scale;
    coarser.largest_deviation *= std::sqrt(scale);
    mesh::Model attempt = before;
    SimplifyReport of_attempt = so_far;
    simplify_once(attempt, coarser, most, of_attempt, context);
    left = too_much(attempt);
    const double now = left + change_excess(of_attempt.deviation_mm, extent, options);
    if (left < at_first && now < least) {
      least = now;
      model = std::move(attempt);
      report = of_attempt;
    }
  }
}

void simplify_to_budget(mesh::Model& model, const SimplifyOptions& options, SimplifyReport& report,
                        const Context& context) {
  // Bodies count their work only nearly.
  constexpr double nearly = 1.05;
  Budget budget = options.budget;
  budget.hours *= nearly;
  simplify_by_details(
      model, options, {60.0 * options.budget.hours, options.most_faces}, report,
      [&](const mesh::Model& attempt) {
        const auto faces = static_cast<double>(attempt.surface.face_count());
        return excess(work_of(attempt, options), budget) +
               std::max(0.0, faces / (nearly * static_cast<double>(options.most_faces)) - 1.0);
      },
      context);
}

void collapse_to_count(mesh::Model& model, const SimplifyOptions& options, SimplifyReport& report,
                       const Context& context) {
  const mesh::Surface before = model.surface;
  const mesh::LooseFaces all = mesh::take_apart(model);
  const Panels panels = find_panels(model.surface);
  const FundamentalDomain domain = fundamental_domain(model, symmetric_within, context);
  report.asymmetry_mm = visible_asymmetry(domain.deviation, model);
  FundamentalDomain simplified;
  // The number counts more than walls.
  for (const double factor : fewer_walls) {
    const Walls walls =
        factor > 0.0 ? find_walls(model.surface, panels, factor * options.short_edge_mm) : Walls{};
    const Sequence sequence(domain, all, walls, {.short_edge = options.short_edge_mm, .faces = options.faces},
                            context);
    simplified = sequence.domain(sequence.all());
    if (sequence.faces_after(sequence.all()) <= options.faces) {
      break;
    }
  }
  take_over(model, expand(simplified, all), before, report, context);
}

/// By collapses alone, which keep each hole and each body; where that leaves more faces than are asked for,
/// holes, knobs and reliefs go first as they do where nobody asks for a number.
void simplify_to_count(mesh::Model& model, const SimplifyOptions& options, SimplifyReport& report,
                       const Context& context) {
  const mesh::Model kept = model;
  collapse_to_count(model, options, report, context);
  if (model.surface.face_count() <= options.faces) {
    return;
  }
  mesh::Model other = kept;
  SimplifyReport of_other = report;
  simplify_by_details(
      other, options, {.faces = options.faces}, of_other,
      [&](const mesh::Model& attempt) {
        return attempt.surface.face_count() > options.faces
                   ? static_cast<double>(attempt.surface.face_count())
                   : 0.0;
      },
      context);
  if (other.surface.face_count() > options.faces) {
    collapse_to_count(other, options, of_other, context);
    of_other.deviation_mm = deviation_between(other.surface, kept.surface, context);
  }
  if (other.surface.face_count() < model.surface.face_count()) {
    model = std::move(other);
    report = of_other;
  }
}

}  // namespace

double change_excess(double moved_mm, double extent_mm, const SimplifyOptions& options) {
  // A surface that moved as far as it may is as bad as a quarter as much work again, one that moved twice as
  // far as twice the work.
  constexpr double weight = 0.25;
  const double share = moved_mm / (options.largest_deviation * extent_mm);
  return weight * share * share;
}

SimplifyReport simplify(mesh::Model& model, const SimplifyOptions& options, const Context& context) {
  SimplifyReport report;
  report.faces_before = model.surface.face_count();
  const mesh::Surface before = options.rolls.which == Rolled::never ? mesh::Surface() : model.surface;
  remesh_panels(model, context);
  const bool merged = options.mode == Simplification::automatic && merge_rolls(model, options, context) > 0;
  if (merged) {
    report.rulings_removed = thin_rulings(
        model, options, options.largest_deviation * model.surface.bounds().largest_extent(), context);
  }
  if (options.mode == Simplification::automatic &&
      (model.surface.face_count() > options.most_faces ||
       excess(work_of(model, options), own_budget(options)) > 0.0)) {
    SimplifyOptions surely = options;
    surely.budget = aimed_at(options.budget);
    simplify_to_budget(model, surely, report, context);
  }
  if (options.mode == Simplification::count && model.surface.face_count() > options.faces) {
    simplify_to_count(model, options, report, context);
  }
  report.at_its_size = model.surface.face_count() < report.faces_before;
  if ((options.mode == Simplification::automatic && round_rolls(model, options, context) > 0) || merged) {
    report.deviation_mm = deviation_between(model.surface, before, context);
  }
  report.faces_after = model.surface.face_count();
  return report;
}

}  // namespace ridgecraft::prepare
