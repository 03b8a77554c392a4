// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/ready_bodies.hpp"

#include "mesh/model/surface_distance.hpp"
#include "prepare/details/details.hpp"
#include "prepare/details/plain_bodies.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/sheets/double_skins.hpp"
#include "prepare/simplify/many_faces.hpp"
#include "prepare/simplify/simplify.hpp"
#include "prepare/walls/fold_figures.hpp"

namespace ridgecraft::prepare {
namespace {

/// Models of more faces are simplified before their bodies are united.
constexpr std::size_t fine_faces = 10000;
/// Details that are hard to fold go, too, where they have this share of the faces of a model with too many.
constexpr double busy_share = 0.2;
/// What takes the place of a busy body may be so many times as far from it as simplification may move the
/// surface: as far as that moves it where a model has too many faces.
constexpr double busy_may_move = 2.0;
/// Short edges have this share of the length of a busy body's edges, ...
constexpr double busy_body = 0.35;
/// ... and this one where too many faces would crumple bodies that could be folded.
constexpr double busy_among_many = 0.12;
/// Of the way that simplification may move the surface, the share that it may before (twice as far where
/// there are too many faces, as always).
constexpr double first_part = 0.25;

/// How many millimetres a unit of the model becomes, as far as is known before it has its size.
double judged_mm_per_unit(const mesh::Model& model, const SizeOptions& size) {
  const double largest = model.surface.bounds().largest_extent();
  return size.judged_at_mm  ? *size.judged_at_mm / largest
         : size.mm_per_unit ? *size.mm_per_unit * model.file_scale
                            : size.largest_extent_mm / largest;
}

}  // namespace

Details leave_out_details(mesh::Model& model, const SizeOptions& size, const SimplifyOptions& simplify,
                          const Context& context) {
  const double mm = judged_mm_per_unit(model, size);
  if (simplify.mode == Simplification::keep || !(mm > 0.0)) {
    return {};
  }
  // A relief that is lower than the shortest fold can't be built: what would be its face lies on the wall.
  // Where there is too much to be built, whole bodies that would be hard go before others are bent.
  Details left_out = leave_out_details(model, DetailLimits{simplify.tiny_edge_mm / mm, 0.0}, context);
  if (simplify.mode == Simplification::automatic && model.surface.face_count() > simplify.most_faces) {
    left_out += leave_out_details(model, DetailLimits{simplify.short_edge_mm / mm, busy_share}, context);
  }
  return left_out;
}

ReadyReport ready_bodies(mesh::Model& model, const SizeOptions& size, const SimplifyOptions& simplify,
                         const Context& context) {
  ReadyReport report;
  const double mm = judged_mm_per_unit(model, size);
  if (simplify.mode == Simplification::keep || !(mm > 0.0)) {
    return report;
  }
  report.sheets = leave_one_skin(model, simplify.skins, simplify.tiny_edge_mm / mm, context);
  report.sheets.thickness_mm *= mm;
  if (model.surface.component_count() < 2) {
    return report;
  }
  report.left_out = leave_out_details(model, size, simplify, context);
  if (simplify.mode != Simplification::automatic) {
    return report;
  }
  SimplifyOptions in_units = simplify;
  in_units.short_edge_mm /= mm;
  in_units.tiny_edge_mm /= mm;
  const bool too_many = model.surface.face_count() > simplify.most_faces;
  const double extent = model.surface.bounds().largest_extent();
  if (too_many || fold_figures(model.surface, in_units).brief_share() > simplify.short_edge_share) {
    report.plain = make_plain(
        model,
        {in_units.short_edge_mm, in_units.tiny_edge_mm, busy_may_move * simplify.largest_deviation * extent,
         too_many ? busy_among_many : busy_body, simplify.hidden_fold_angle},
        context);
    report.plain.moved_mm *= mm;
  }
  if (model.surface.face_count() <= fine_faces || model.surface.component_count() < 2) {
    return report;
  }
  SimplifyOptions first = in_units;
  first.splinter_mm = 0.0;  // the union makes others
  first.largest_deviation *= first_part;
  const std::size_t faces_before = model.surface.face_count();
  report.simplified = prepare::simplify(model, first, context);
  report.simplified.faces_before = faces_before;
  return report;
}

}  // namespace ridgecraft::prepare
