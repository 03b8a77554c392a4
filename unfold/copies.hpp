// SPDX-License-Identifier: GPL-3.0-or-later
// Equal bodies are unfolded once: their nets are copies.
#pragma once

#include <optional>
#include <vector>

#include "base/id.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/pieces/symmetry.hpp"
#include "unfold/plan.hpp"

namespace ridgecraft::unfold {

// Of equal bodies one is unfolded, and the others get copies of its nets.

/// A body that gets the nets of another one.
struct CopiedBody {
  bool mirrored = false;
  std::vector<FaceId> from;  ///< of OneOfEach::kept
  std::vector<FaceId> to;    ///< of the whole surface: prepare::TwinBody::faces
};

/// What is asked for without copies: a surface of its own, as if there were none.
struct OneOfEach {
  prepare::PartOf kept;
  prepare::Panels panels;
  IdVector<FaceId, PartId> part;  ///< as in the whole: some numbers may not occur
  Options options;                ///< with the constraints for its edges
  std::vector<CopiedBody> copies;
};

/// Of the bodies that Options::twins names those can have the nets of another one that are divided into parts
/// as that one is, with faces of no other body in these parts, and of whose edges the same is requested.
/// Nothing where there are none. O(n log n).
[[nodiscard]] std::optional<OneOfEach> one_of_each(const UnfoldProblem& whole);

/// find_symmetry for the surface without copies: that of the whole surface, and in bodies with copies their
/// own, each in the place of the same kind. The plane is that of the whole surface.
[[nodiscard]] Symmetry symmetry_of(const UnfoldProblem& whole, const OneOfEach& each, const Context& context);

/// The nets of the whole surface, once those of one of each kind are finished (holes and folding too, and
/// tabs where they are wanted). A copy has its pieces with all that is on them, mirrored where it is. O(n log
/// n).
[[nodiscard]] Nets with_copies(const UnfoldProblem& whole, const OneOfEach& each, const Nets& nets);

/// The nets of the whole without copies, and the way back for new tabs alone; nothing where some copy has
/// other nets than its original. O(n log n).
[[nodiscard]] std::optional<Nets> without_copies(const UnfoldProblem& whole, const OneOfEach& each,
                                                 const Nets& nets);
/// Gives nets of the whole, whose joins are numbered, the tabs of those without copies. O(n log n).
void copy_tabs(const UnfoldProblem& whole, const OneOfEach& each, const Nets& tabbed, Nets& nets);

}  // namespace ridgecraft::unfold
