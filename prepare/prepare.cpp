// SPDX-License-Identifier: GPL-3.0-or-later
// From a model in the file's unit to one that can be made of paper.
#include <utility>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "prepare/panels/divide_panels.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/prepared/narrow_faces.hpp"
#include "prepare/simplify/simplify.hpp"
#include "prepare/size.hpp"

namespace ridgecraft::prepare {

Prepared prepare(mesh::Model model, const SizeOptions& size, const SimplifyOptions& simplify,
                 const PanelRoom& room, const Context& context) {
  context.report("preparing", 0.0);
  Prepared prepared;
  prepared.model = std::move(model);
  prepared.mm_per_unit = resize(prepared.model, size);
  const std::size_t faces_before = prepared.model.surface.face_count();
  remesh_panels(prepared.model, context);
  prepared.simplified = prepare::simplify(prepared.model, simplify, context);
  prepared.simplified.faces_before = faces_before;
  if (prepared.simplified.faces_after < prepared.simplified.faces_before && !size.mm_per_unit) {
    // Collapses move the outermost points, too; the size that was asked for is the finished model's.
    const double factor = resize(prepared.model, size);
    prepared.mm_per_unit *= factor;
    prepared.simplified.deviation_mm *= factor;
    prepared.simplified.evened_mm *= factor;
    prepared.simplified.short_edges_after = short_fold_share(prepared.model.surface, simplify);
  }
  prepared.panels = find_panels(prepared.model.surface);
  prepared.divided_panels = divide_panels(prepared.model, prepared.panels, room, context);
  const mesh::Surface& surface = prepared.model.surface;
  if (count_narrow_faces(surface, prepared.panels, nothing_mm) == surface.face_count()) {
    throw Error(ErrorKind::no_nets, "every face is too narrow to be cut from paper at this size");
  }
  prepared.model.repairs.add(mesh::RepairKind::narrow_faces,
                             count_narrow_faces(surface, prepared.panels, narrow_mm));
  return prepared;
}

}  // namespace ridgecraft::prepare
