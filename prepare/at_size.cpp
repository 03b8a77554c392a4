// SPDX-License-Identifier: GPL-3.0-or-later
// From a model in the file's unit to one that can be made of paper.
#include "prepare/at_size.hpp"

#include <utility>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "prepare/features/standing_bodies.hpp"
#include "prepare/panels/divide_panels.hpp"
#include "prepare/prepared/narrow_faces.hpp"
#include "prepare/simplify/simplify.hpp"
#include "prepare/size.hpp"
#include "prepare/twins/twin_copies.hpp"
#include "prepare/walls/fold_figures.hpp"

namespace ridgecraft::prepare {
namespace {

/// Where all faces are kept, what makes equal bodies copies of each other moves no point by more than this
/// share of the model's largest extent: less than what verify/ allows, and more than files with six digits
/// are off.
constexpr double kept_share = 4e-5;

void add_to_way(Prepared& prepared, const Resized& resized) {
  prepared.from_model.factor *= resized.factor;
  prepared.from_model.shift = resized.factor * (prepared.from_model.shift - resized.centre);
}

/// Equal bodies become copies of one. The model stays of its size.
void copy_equal_bodies(Prepared& prepared, const SizeOptions& size, bool keeps_faces,
                       const Context& context) {
  mesh::Model& model = prepared.model;
  const double extent = model.surface.bounds().largest_extent();
  prepared.panels = find_panels(model.surface);
  const EqualBodies equal =
      find_equal_bodies(model, prepared.panels, keeps_faces ? kept_share * extent : extent, context);
  if (equal.kinds.empty()) {
    return;
  }
  prepared.twins = make_copies(model, equal);
  if (model.surface.bounds().largest_extent() != extent && !size.mm_per_unit) {
    const Resized resized = resize(model, size);
    prepared.mm_per_unit *= resized.mm_per_unit;
    add_to_way(prepared, resized);
  }
  prepared.panels = find_panels(model.surface);
  copy_panels(prepared.twins, prepared.panels);
}

/// Division of panels gives a body points that its twin may not have got, or at other places: bodies that are
/// no copies any more are none.
void renew_copies(Prepared& prepared, const Context& context) {
  const double extent = prepared.model.surface.bounds().largest_extent();
  prepared.twins = make_copies(
      prepared.model, find_equal_bodies(prepared.model, prepared.panels, kept_share * extent, context));
  copy_panels(prepared.twins, prepared.panels);
}

}  // namespace

void judge_folds(Prepared& prepared, const SimplifyOptions& simplify) {
  const FoldFigures folds = fold_figures(prepared.model.surface, simplify);
  SimplifyReport& report = prepared.simplified;
  report.short_edges_after = folds.brief_share();
  report.tiny_edges_after = folds.tiny_share();
  report.cramped_share = folds.cramped_share();
  report.still_too_fine = report.tiny_edges_after > simplify.short_edge_share;
}

Prepared prepare_at_size(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                         const PanelRoom& room, const Context& context) {
  context.report("preparing", 0.0);
  Prepared prepared;
  prepared.model = std::move(model);
  const Resized to_size = resize(prepared.model, size);
  prepared.mm_per_unit = to_size.mm_per_unit;
  add_to_way(prepared, to_size);
  const std::size_t faces_before = prepared.model.surface.face_count();
  prepared.simplified = prepare::simplify(prepared.model, simplify, context);
  prepared.simplified.faces_before = faces_before;
  prepared.simplified.at_its_size = prepared.simplified.faces_after < faces_before;
  if (prepared.simplified.faces_after < prepared.simplified.faces_before && !size.mm_per_unit) {
    // Collapses move the outermost points, too; the size that was asked for is the finished model's.
    const Resized resized = resize(prepared.model, size);
    const double factor = resized.mm_per_unit;
    add_to_way(prepared, resized);
    prepared.mm_per_unit *= factor;
    prepared.simplified.deviation_mm *= factor;
    prepared.simplified.evened_mm *= factor;
  }
  if (simplify.part_standing) {
    prepared.standing = part_standing_bodies(prepared.model, context);
  }
  judge_folds(prepared, simplify);
  copy_equal_bodies(prepared, size, simplify.mode == Simplification::keep, context);
  prepared.divided_panels = divide_panels(prepared.model, prepared.panels, room, context);
  if (prepared.divided_panels > 0 && !prepared.twins.empty()) {
    renew_copies(prepared, context);
  }
  const mesh::Surface& surface = prepared.model.surface;
  if (count_narrow_faces(surface, prepared.panels, nothing_mm) == surface.face_count()) {
    throw Error(ErrorKind::no_nets, "every face is too narrow to be cut from paper at this size");
  }
  prepared.sliver_share = static_cast<double>(count_narrow_faces(surface, prepared.panels, sliver_mm)) /
                          static_cast<double>(surface.face_count());
  prepared.model.repairs.add(mesh::RepairKind::narrow_faces,
                             count_narrow_faces(surface, prepared.panels, narrow_mm));
  return prepared;
}

}  // namespace ridgecraft::prepare
