// SPDX-License-Identifier: GPL-3.0-or-later
// Trees for pieces that are divided anew after others: as they were, as their images', or found.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/search/one_piece.hpp"

namespace ridgecraft::unfold {

/// What was given must outlive it. Faces are those of the patch, ascending, and connected.
class CarriedTrees {
 public:
  /// `folds`: of the pieces as they were.
  CarriedTrees(const NetProblem& problem, const Folds& folds, const Layout& layout, const Context& context);

  /// Whether these faces were one piece.
  [[nodiscard]] bool was_a_piece(const std::vector<std::uint32_t>& faces) const;

  /// A clean tree that fits the room, if one is found. A piece that was one keeps its tree.
  [[nodiscard]] std::optional<Folds> tree_of(const std::vector<std::uint32_t>& faces);

  /// The tree that `result` has of the original, carried over by the images of edges; another clean one where
  /// that isn't clean, for the image may be off by what the eye doesn't see, but a net may not.
  [[nodiscard]] std::optional<Folds> image_of(const std::vector<std::uint32_t>& original,
                                              const std::vector<std::uint32_t>& faces, const Folds& result,
                                              const IdVector<EdgeId, EdgeId>& images);

 private:
  const NetProblem problem_;
  const Folds& folds_;
  const Layout& layout_;
  OnePieceSearch search_;
  Random random_;
  const Context& context_;
};

}  // namespace ridgecraft::unfold
