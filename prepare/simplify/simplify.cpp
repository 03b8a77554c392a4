// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/simplify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/domains/find_domain.hpp"
#include "prepare/features/thin_rulings.hpp"
#include "prepare/features/trim_reliefs.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/simplify/body.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {
namespace {

/// Samples by which it is measured how far a surface moved are this share of its largest extent apart.
constexpr double sample_spacing = 0.015;
/// Where a model has too many faces, bodies with so few keep theirs.
constexpr std::size_t few_faces = 24;
/// What is tried there, one after the other: walls are what would be ones if the short edge were so many
/// times longer; and the surface may move by so many times as much, as nobody builds what has more faces.
struct Coarser {
  double walls = 1.0;
  double deviation = 1.0;
  bool of_fine = false;  ///< tried with models of very many faces, too, which take long
};
constexpr std::array<Coarser, 5> coarser{
    {{1.0, 1.0}, {1.6, 1.0, true}, {2.5, 1.0}, {1.6, 2.0, true}, {2.5, 2.0}}};
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

std::size_t face_count(const std::vector<FundamentalDomain>& bodies) {
  return std::accumulate(
      bodies.begin(), bodies.end(), std::size_t{0},
      [](std::size_t sum, const FundamentalDomain& body) { return sum + body.face_count(); });
}

bool has_few_faces(const FundamentalDomain& body) {
  return body.face_count() <= few_faces * (1 + body.copies.size());
}

/// Each as it needs; and where they have too many faces together, those that have many get fewer, only larger
/// walls stay, and in the end the surface may move farther. Returns whether anything changed.
bool simplify_bodies(const mesh::Model& model, std::vector<FundamentalDomain>& bodies, BodyRules rules,
                     const Context& context) {
  const SimplifyOptions& options = rules.options;
  const std::vector<FundamentalDomain> before = bodies;
  bool changed = false;
  const auto simplify = [&](std::size_t i, std::size_t most_faces) {
    rules.most_faces = most_faces;
    if (auto simplified = simplified_body(before[i], rules, context)) {
      bodies[i] = std::move(*simplified);
      changed = true;
    }
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    simplify(i, options.most_faces);
  }
  const mesh::Surface& surface = model.surface;
  const double largest_mm = rules.largest_mm;
  for (const Coarser& attempt : coarser) {
    const std::size_t all = face_count(bodies);
    if (all <= options.most_faces) {
      break;
    }
    if (surface.face_count() > fine_faces && !attempt.of_fine) {
      continue;
    }
    const Walls walls =
        find_walls(surface, find_panels(surface), attempt.walls * options.short_edge_mm, Slats::are_walls);
    rules.walls = &walls;
    rules.largest_mm = attempt.deviation * largest_mm;
    // What those with few faces keep is lacking to the others.
    const std::size_t keep = std::accumulate(bodies.begin(), bodies.end(), std::size_t{0},
                                             [](std::size_t sum, const FundamentalDomain& body) {
                                               return sum + (has_few_faces(body) ? body.face_count() : 0);
                                             });
    const std::size_t aim = options.most_faces * 19 / 20;  // bodies count their faces only nearly
    const std::size_t left = aim > keep ? aim - keep : 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!has_few_faces(bodies[i])) {
        simplify(i, bodies[i].face_count() * left / (all - keep));
      }
    }
  }
  return changed;
}

/// What is too shallow to be folded; and where there are too many faces, what is over-detailed and no higher
/// than a fold should be long. Returns how many went.
std::size_t flatten_reliefs(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                            const Context& context) {
  std::size_t removed = trim_reliefs(model, options, {std::min(largest_mm, options.tiny_edge_mm)}, context);
  if (model.surface.face_count() > options.most_faces) {
    const double height_mm = std::min(coarser.back().deviation * largest_mm, options.short_edge_mm);
    removed += trim_reliefs(model, options, {height_mm, true}, context);
  }
  return removed;
}

/// What is done to whole bodies and walls before edges collapse. Returns whether anything changed.
bool remove_details(mesh::Model& model, const SimplifyOptions& options, double largest_mm,
                    SimplifyReport& report, const Context& context) {
  report.features_removed = flatten_reliefs(model, options, largest_mm, context);
  report.rulings_removed = thin_rulings(model, options, largest_mm, context);
  return report.features_removed + report.rulings_removed > 0;
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

void simplify_to_fold(mesh::Model& model, const SimplifyOptions& options, SimplifyReport& report,
                      const Context& context) {
  const mesh::Surface before = model.surface;
  const double extent = before.bounds().largest_extent();
  const double largest_mm = options.largest_deviation * extent;
  const bool changed = remove_details(model, options, largest_mm, report, context);
  const mesh::LooseFaces all = mesh::take_apart(model);
  const Walls walls =
      find_walls(model.surface, find_panels(model.surface), options.short_edge_mm, Slats::are_walls);
  FundamentalDomain start = fundamental_domain(model, symmetric_within, context);
  const double asymmetry_mm = visible_asymmetry(start.deviation, model);
  const BodyRules rules{all, &walls, sample_spacing * extent, largest_mm, 0, options};
  std::vector<FundamentalDomain> bodies = divided(start);
  start = {};  // large
  const bool collapsed = simplify_bodies(model, bodies, rules, context);
  if (changed || collapsed) {
    report.asymmetry_mm = asymmetry_mm;
    take_over(model, expand(joined(bodies), all), before, report, context);
  }
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
        factor > 0.0 ? find_walls(model.surface, panels, factor * options.short_edge_mm, Slats::are_walls)
                     : Walls{};
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
  SimplifyOptions automatic = options;
  automatic.mode = Simplification::automatic;
  automatic.most_faces = options.faces;
  mesh::Model other = kept;
  SimplifyReport of_other = report;
  simplify_to_fold(other, automatic, of_other, context);
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

SimplifyReport simplify(mesh::Model& model, const SimplifyOptions& options, const Context& context) {
  SimplifyReport report;
  report.faces_before = model.surface.face_count();
  remesh_panels(model, context);
  report.short_edges_before = fold_figures(model.surface, options).short_fraction();
  if (options.mode == Simplification::automatic && (report.short_edges_before > options.short_edge_fraction ||
                                                    model.surface.face_count() > options.most_faces)) {
    simplify_to_fold(model, options, report, context);
  }
  if (options.mode == Simplification::count && model.surface.face_count() > options.faces) {
    simplify_to_count(model, options, report, context);
  }
  report.faces_after = model.surface.face_count();
  report.short_edges_after = fold_figures(model.surface, options).short_fraction();
  return report;
}

}  // namespace ridgecraft::prepare
