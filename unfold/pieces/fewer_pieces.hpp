// SPDX-License-Identifier: GPL-3.0-or-later
// A few pieces searched together: for one tree fewer, or for trees of less energy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/tabs/trees/changing_net.hpp"

namespace ridgecraft::unfold {

/// A few pieces as one patch. The first of them is to be joined to another one.
struct PiecesTogether {
  std::vector<std::uint32_t> faces;  ///< of the whole, ascending
  Patch patch;
  Folds apart;
  std::size_t trees = 0;    ///< that it has
  std::uint32_t first = 0;  ///< one of the first piece's faces, of the patch
};

/// These pieces of a forest of the whole; the first of them comes first. `layout`: of the forest.
[[nodiscard]] PiecesTogether pieces_together(const Patch& whole, const Folds& folds, const Layout& layout,
                                             std::span<const std::uint32_t> pieces);

/// Trees, and what they cost as annealing counts it (NetEnergy), all cuts between them included, mm.
struct SettledTrees {
  Folds folds;
  double energy = 0.0;
};

/// Searches with a budget for all of them: about a second for trees, and one for the room.
class TreesTogether {
 public:
  /// All must outlive this.
  TreesTogether(const NetProblem& problem, const Context& context);

  /// Clean trees that fit the room, one fewer than they are: linked trees are searched for a net by heat
  /// (heated_search.hpp) and, where they don't fit the room, for borders at which they do
  /// (energy/anneal.hpp). What is proven to need as many (least_forest.hpp) isn't tried. Throws
  /// Error(interrupted).
  [[nodiscard]] std::optional<Folds> one_fewer(const PiecesTogether& pieces);

  /// As many trees, brought to less energy by a short search, so that what any net cost can be compared.
  [[nodiscard]] SettledTrees settled(const Patch& patch, const Folds& forest);

 private:
  [[nodiscard]] std::optional<Folds> parted(const Patch& patch, Folds tree,
                                            const std::vector<std::uint32_t>& links) const;
  [[nodiscard]] Folds fitted(const LinkedPatch& linked, const Folds& tree);
  [[nodiscard]] double cost_of_cuts(const Patch& patch, const Folds& forest, ChangingNet& net) const;

  static constexpr std::uint64_t heat_budget = 400'000;
  static constexpr std::uint64_t fit_budget = 400'000;

  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const Options& options_;
  const Room& room_;
  const Context& context_;
  double tolerance_;
  Random random_;
  std::uint64_t heat_work_ = heat_budget;
  std::uint64_t fit_work_ = fit_budget;
};

// As few pieces as paper and overlap allow, whatever the parts are.

/// The forest with fewer trees, where such are found: each connected body is unfolded as if it were one part
/// (patch_nets.hpp), and taken so if that makes fewer pieces; then two pieces that meet are searched together
/// for one net, three for two, and at last all of a body for one fewer, until nothing is
/// saved. What the area or a proof says to need as many isn't tried. The
/// forest stays clean and what fits still fits. Takes as long as unfolding all parts again, and two seconds.
/// Deterministic for one seed but for the deadline. Throws Error(interrupted).
[[nodiscard]] Folds fewer_pieces(const NetProblem& problem, const Folds& folds, const Context& context);

}  // namespace ridgecraft::unfold
