// SPDX-License-Identifier: GPL-3.0-or-later
// What a job's options mean to segmentation and unfolding.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/context.hpp"
#include "base/id.hpp"
#include "base/vector.hpp"
#include "job/options.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::job {

// Which faces are unfolded together.

/// What each face belongs to by its author's will: one number for each pair of object and material. Empty
/// where all faces have one. O(n log n).
[[nodiscard]] IdVector<FaceId, std::uint32_t> author_labels(const mesh::Model& model);

/// The parts of a surface.
struct Parts {
  IdVector<FaceId, PartId> of_face;
  bool given_up = false;  ///< there was no time to find them: each component is one part
};

/// Nearly convex parts that end at the borders of flat regions, or one part per component, as the options
/// say. Where segmentation takes more than half of the time that is left until the context's deadline, it is
/// given up. Throws Error(interrupted).
[[nodiscard]] Parts find_parts(const prepare::Prepared& prepared, const Options& options,
                               const Context& context);

/// Linear.
[[nodiscard]] std::size_t count_parts(const IdVector<FaceId, PartId>& part);

// What a job asks of unfold/.

/// What pieces must fit, mm: next to anything, where there is no paper.
[[nodiscard]] Vec2 room_for_pieces(const Options& options);

/// `constraints`: of each edge of the prepared surface, or none.
[[nodiscard]] unfold::Options unfold_options(const Options& options, const prepare::Prepared& prepared,
                                             unfold::EdgeConstraints constraints);

}  // namespace ridgecraft::job
