// SPDX-License-Identifier: GPL-3.0-or-later
// A patch as panels that stay whole and the edges between them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/geometry.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/problem.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/circle_tree.hpp"

namespace ridgecraft::unfold {

/// A panel: faces that never part.
struct Plate {
  std::vector<std::uint32_t> faces;
  std::vector<Rigid> place;         ///< of each face in the frame of the first one
  std::vector<EdgedTriangle> flat;  ///< there
  std::vector<Circle> circle;
};

/// An edge between two panels.
struct Arc {
  std::uint32_t side = nothing;
  std::uint32_t a = 0, b = 0;  ///< panels
  Rigid across;                ///< b's frame seen from a's
  bool open = true;            ///< neither cut nor folded yet
  bool fold = false;
};

/// What the frozen sides of a patch hold together, in the order of their first faces. O(n).
[[nodiscard]] std::vector<Plate> plates_of(const Patch& patch);

/// The edges between different ones, by their sides. O(n).
[[nodiscard]] std::vector<Arc> arcs_between(const Patch& patch, const std::vector<Plate>& plates);

/// Folds that hold each panel together: a tree, whatever loops its frozen sides make.
[[nodiscard]] Folds folds_of_plates(const Patch& patch, const std::vector<Plate>& plates);

// One net of one patch: start trees, searches, restarts, within a budget that is counted in iterations.

struct NetSearch {
  StartTree start = StartTree::short_cuts;  ///< later starts: the other kinds in turn
  double tolerance = 0.0;                   ///< mm
  int starts = 3;                           ///< start trees, at least 1: searched in turns
  std::uint64_t iterations = 0;             ///< of all starts together
  std::uint64_t idle = 0;  ///< a start ends after so many without a better tree; 0: idle_iterations
};

/// Iterations without a better tree after which a start is given up: enough that no good tree is thrown away.
[[nodiscard]] std::uint64_t idle_iterations(std::uint32_t faces);
/// A budget that solves every net of our measurements that is solved at all, but ends.
[[nodiscard]] std::uint64_t iteration_budget(std::uint32_t faces);

struct NetFound {
  Folds folds;                 ///< the best tree
  std::uint64_t overlaps = 0;  ///< of it; 0: a clean net, laid out afresh and checked
  std::uint64_t iterations = 0;
  int starts = 0;
  bool hopeless = false;  ///< what is left is far from a net: other starts won't find any either
};

/// Searches a connected patch for a tree without overlap. Deterministic for one seed but for the deadline,
/// with any number of threads.
[[nodiscard]] NetFound find_net(const Patch& patch, const NetSearch& options, std::uint64_t seed,
                                const Context& context);

// Can these faces be one piece? A quick search that is made for many unions of pieces.

struct OnePieceSearch {
  double tolerance = 0.0;  ///< mm
  int starts = 3;          ///< start trees
  std::uint64_t iterations_per_face = 2;
};

struct OnePieceFound {
  std::optional<Folds> tree;
  std::uint64_t cost = 0;  ///< faces times iterations: about four million a second
};

/// A tree of a connected patch, panels whole, that has no overlap and fits the room; none where the search
/// finds none. The first that is found is taken.
[[nodiscard]] OnePieceFound find_one_piece(const Patch& patch, const Room& room, const OnePieceSearch& search,
                                           std::uint64_t seed, const Context& context);

}  // namespace ridgecraft::unfold
