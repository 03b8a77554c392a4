// SPDX-License-Identifier: GPL-3.0-or-later
// What goes into a segmentation and what comes out of it: options, rules of the readings, parts.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/id.hpp"
#include "base/no_index.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::segment {

// What segment() may be asked for.

/// How the paper is read where it leaves a choice. All but `b` are for research: with effort 1, without
/// planes and pockets.
enum class Reading {
  literal,  ///< to the letter: every opening that a cut leaves is as concave as it is wide
  a,        ///< valleys run straight across such openings
  b         ///< and a vertex is no deeper than the hull is far from it; parts that can be one are joined
};

/// How nearly convex parts are to be, and how they are found.
struct Options {
  /// Largest concavity of a part, as a length in the scale where the model's smallest enclosing ball has
  /// radius 1. Finite and above 0, else Error(usage).
  double concavity = 0.1;
  /// 1: one pass. 2: also parts cut into smaller pieces that are put together again, and the cheapest of both
  /// in number of parts, volume and borders; about four times as long. 3: still smaller pieces and more
  /// trials, too; about 25 times as long.
  int effort = 1;
  /// The price of volume: how many parts more may be spent to lower the volume ratio (volume of the union of
  /// the parts' hulls over the volume that the surface encloses) by 1. At 5, a cut that lowers it by more
  /// than 0.2 is worth the part that it adds. 0: fewest parts whatever their hulls. None: 0 for effort 1
  /// without planes, else 5. At least 0, else Error(usage).
  std::optional<double> volume_weight = std::nullopt;
  /// Cut by planes, too, where that saves more volume than the pieces are worth: cups become sectors.
  bool planes = false;
  /// No part's hull has a pocket: a point outside the solid that lies deeper under it than `concavity`. Takes
  /// a surface without border edges, else Error(unusable_mesh). Cups become sectors.
  bool pockets = false;
  /// What holes in the surface are taken for.
  enum class Holes {
    automatic,  ///< `close` where the surface looks damaged (docs/design/segmentation.md, "Damaged models"),
                ///< else `keep`
    keep,       ///< holes are borders
    close       ///< small holes are closed while segmenting, and crumbs join the part that they touch
  };
  Holes holes = Holes::automatic;
  /// Whether a part may be made of several components.
  enum class Components {
    apart,  ///< each component for itself
    tied    ///< all together as one object: parts may hold faces of several components
  };
  Components components = Components::apart;
  Reading reading = Reading::b;
};

/// The weight that counts: the one that was asked for, else that of the effort and of planes.
[[nodiscard]] double volume_weight(const Options& options);

// What segment() gives: nearly convex parts.

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
  /// Largest concavity over the part's bridges, measured from scratch, in the scale of Options::concavity:
  /// the part's own, whatever tolerance it was found with.
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

// A segmentation as numbers of the polygons that a model was made from.

/// The part of each polygon of the file, or of the points and polygons that were repaired, in its order; or
/// no_index. `segmentation`: of the model's surface, with each polygon in one part. O(n).
[[nodiscard]] std::vector<std::uint32_t> polygon_labels(const mesh::Model& model,
                                                        const Segmentation& segmentation);

// What a reading of the paper means for each stage.

/// The rules that readings differ in (docs/design/segmentation.md, "Where this differs from the paper, and
/// from its plainest reading"); all of them hold for Reading::b.
struct Rules {
  bool jumps = true;            ///< a valley may run straight across the opening that a cut left
  bool cap = true;              ///< a vertex is no deeper than the hull is far along its normal
  bool derivation = true;       ///< what one bridge measured serves its neighbours
  bool folds_by_length = true;  ///< the price of a fold grows with its length; nearly flat ones are none
  bool merging = true;          ///< neighbours whose union is within the tolerance are joined
};

[[nodiscard]] constexpr Rules rules_of(Reading reading) {
  if (reading == Reading::b) {
    return {};
  }
  return {.jumps = reading == Reading::a,
          .cap = false,
          .derivation = false,
          .folds_by_length = false,
          .merging = false};
}

}  // namespace ridgecraft::segment
