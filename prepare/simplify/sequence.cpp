// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/sequence.hpp"

#include <algorithm>
#include <utility>

#include "prepare/collapses/collapse_sequence.hpp"
#include "prepare/panels/remesh_panels.hpp"
#include "prepare/shares/whole.hpp"

namespace ridgecraft::prepare {

mesh::Model as_it_is(const SymmetricShare& share, const mesh::LooseFaces& model) {
  mesh::LooseFaces faces;
  if (share.copies.empty()) {
    faces = whole(share, model);
  } else {
    SymmetricShare alone = share;
    alone.copies.clear();
    faces = whole(alone, model);
  }
  mesh::Model result;
  mesh::put_together(result, std::move(faces));
  return result;
}

mesh::Model model_of(const SymmetricShare& share, const mesh::LooseFaces& model, const Context& context) {
  mesh::Model result = as_it_is(share, model);
  remesh_panels(result, context);
  return result;
}

Sequence::Sequence(SymmetricShare start, const mesh::LooseFaces& model, const Walls& walls, std::size_t faces,
                   const CollapseRules& rules, const Context& context)
    : start_(std::move(start)),
      model_(&model),
      context_(&context),
      collapses_(
          collapse_sequence(start_.faces, start_.points, walls_of(walls, start_), faces, rules, context)) {}

std::size_t Sequence::count_for(std::size_t faces) const {
  if (start_.face_count() <= faces) {
    return 0;
  }
  const auto found = std::partition_point(collapses_.begin(), collapses_.end(),
                                          [&](const Collapse& c) { return c.faces > faces; });
  return std::min(static_cast<std::size_t>(found - collapses_.begin()) + 1, collapses_.size());
}

}  // namespace ridgecraft::prepare
