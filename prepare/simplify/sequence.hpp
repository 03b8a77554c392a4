// SPDX-License-Identifier: GPL-3.0-or-later
// A share, the collapses that can be made in it, and the model after any number of them. Private to prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/collapses/collapse_rules.hpp"
#include "prepare/shares/collapse.hpp"
#include "prepare/shares/share.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// A share without its copies as a model. `model` is the whole taken apart.
[[nodiscard]] mesh::Model as_it_is(const SymmetricShare& share, const mesh::LooseFaces& model);

/// The same with its panels remeshed.
[[nodiscard]] mesh::Model model_of(const SymmetricShare& share, const mesh::LooseFaces& model,
                                   const Context& context);

/// One sequence of collapses and the model after any number of them.
class Sequence {
 public:
  /// `walls` are those of the whole, `model` is the whole taken apart and must outlive it, as must the
  /// context. Collapses down to `faces` faces, O(n log n).
  Sequence(SymmetricShare start, const mesh::LooseFaces& model, const Walls& walls, std::size_t faces,
           const CollapseRules& rules, const Context& context);

  [[nodiscard]] std::size_t all() const { return collapses_.size(); }
  [[nodiscard]] std::size_t faces_after(std::size_t count) const {
    return count == 0 ? start_.face_count() : collapses_[count - 1].faces;
  }
  /// Fewest collapses that leave at most so many faces; all() where that can't be reached.
  [[nodiscard]] std::size_t count_for(std::size_t faces) const;
  [[nodiscard]] SymmetricShare share(std::size_t count) const {
    return collapsed(start_, std::span(collapses_).first(count));
  }
  /// Without copies. With its panels remeshed.
  [[nodiscard]] mesh::Model after(std::size_t count) const {
    return model_of(share(count), *model_, *context_);
  }

 private:
  SymmetricShare start_;
  const mesh::LooseFaces* model_;
  const Context* context_;
  std::vector<Collapse> collapses_;
};

}  // namespace ridgecraft::prepare
