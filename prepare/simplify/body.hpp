// SPDX-License-Identifier: GPL-3.0-or-later
// One component is made coarse enough to be folded by hand. Private to prepare/.
#pragma once

#include <cstddef>
#include <vector>

#include "base/context.hpp"
#include "mesh/model/model.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/collapses/collapse_sequence.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/walls/walls.hpp"

namespace ridgecraft::prepare {

/// A domain without its copies as a model, with its panels remeshed. `model` is the whole taken apart.
[[nodiscard]] mesh::Model model_of(const FundamentalDomain& domain, const mesh::LooseFaces& model,
                                   const Context& context);

/// One sequence of collapses and the model after any number of them.
class Sequence {
 public:
  /// `walls` are those of the whole, `model` is the whole taken apart and must outlive it, as must the
  /// context. O(n log n).
  Sequence(FundamentalDomain start, const mesh::LooseFaces& model, const Walls& walls,
           const CollapseRules& rules, const Context& context);

  [[nodiscard]] std::size_t all() const { return collapses_.size(); }
  [[nodiscard]] std::size_t faces_after(std::size_t count) const {
    return count == 0 ? start_.face_count() : collapses_[count - 1].faces;
  }
  /// Fewest collapses that leave at most so many faces; all() where that can't be reached.
  [[nodiscard]] std::size_t count_for(std::size_t faces) const;
  [[nodiscard]] FundamentalDomain domain(std::size_t count) const {
    return collapsed(start_, std::span(collapses_).first(count));
  }
  /// Without copies. With its panels remeshed.
  [[nodiscard]] mesh::Model after(std::size_t count) const {
    return model_of(domain(count), *model_, *context_);
  }

 private:
  FundamentalDomain start_;
  const mesh::LooseFaces* model_;
  const Context* context_;
  std::vector<Collapse> collapses_;
};

/// What a body is part of.
struct BodyRules {
  const mesh::LooseFaces& model;  ///< the whole, taken apart
  const Walls* walls;             ///< of the whole
  double spacing_mm = 0.0;        ///< of samples for the deviation
  double largest_mm = 0.0;        ///< how far the surface may move
  /// Of the body and its copies together.
  double most_minutes = 0.0;
  std::size_t most_faces = 0;
  const SimplifyOptions& options;
};

/// A body and the work that it is, with its copies.
struct SimplifiedBody {
  FundamentalDomain domain;
  bool changed = false;
  double minutes = 0.0;
};

/// One component as fine as the rules allow: it stays as it is where it keeps them, or where simplification
/// wouldn't help it enough. O(n log n).
[[nodiscard]] SimplifiedBody simplified_body(const FundamentalDomain& body, const BodyRules& rules,
                                             const Context& context);

}  // namespace ridgecraft::prepare
