// SPDX-License-Identifier: GPL-3.0-or-later
// From a model in the file's unit to one that can be made of paper.
#include <utility>

#include "mesh/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/remesh_panels.hpp"
#include "mesh/simplify.hpp"
#include "mesh/size.hpp"

namespace ridgecraft::mesh {

Prepared prepare(Model model, const SizeOptions& size, const SimplifyOptions& simplify, Vec2 largest_face_mm,
                 const Context& context) {
  static_cast<void>(largest_face_mm);
  context.report("preparing", 0.0);
  Prepared prepared;
  prepared.model = std::move(model);
  prepared.mm_per_unit = resize(prepared.model, size);
  prepared.simplified.faces_before = prepared.simplified.faces_after = prepared.model.surface.face_count();
  remesh_panels(prepared.model, context);
  prepared.simplified = mesh::simplify(prepared.model, simplify, context);
  prepared.panels = find_panels(prepared.model.surface);
  return prepared;
}

}  // namespace ridgecraft::mesh
