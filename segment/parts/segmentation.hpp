// SPDX-License-Identifier: GPL-3.0-or-later
// What segment() gives: nearly convex parts.
#pragma once

#include <string_view>
#include <vector>

#include "base/id.hpp"

namespace ridgecraft::segment {

/// Why a part is a part of its own.
enum class PartReason {
  component,  ///< a whole connected component
  ridge,      ///< a cut separated its convex ridge from others, or a plane, or a finer cut
  split,      ///< the fallback split (no cut made two pieces)
  merged,     ///< several were joined
};

/// One word for machines: "component", "ridge", ...
[[nodiscard]] std::string_view name(PartReason reason);

/// One nearly convex part, and its figures.
struct Part {
  std::vector<FaceId> faces;  ///< ascending
  /// Largest concavity over the part's bridges, measured from scratch, in the scale of Options::concavity. It
  /// depends on that tolerance a little, since openings within it count as ways out
  /// (docs/design/segmentation.md).
  double concavity = 0.0;
  std::vector<VertexId> hull_vertices;  ///< ascending
  double hull_volume = 0.0;             ///< in the surface's own unit, cubed
  PartReason reason = PartReason::component;
};

/// A division of all faces into parts.
struct Segmentation {
  IdVector<FaceId, PartId> part;  ///< of each face; numbered by their smallest face
  IdVector<PartId, Part> parts;

  /// Greatest concavity of a part; 0 when there is none.
  [[nodiscard]] double max_concavity() const;
};

}  // namespace ridgecraft::segment
