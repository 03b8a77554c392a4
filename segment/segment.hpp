// SPDX-License-Identifier: GPL-3.0-or-later
// CoRiSe: a surface becomes nearly convex parts. Read this header first; docs/segmentation.md has the method.
//
// Source: G. Liu, Z. Xi, J.-M. Lien, "Nearly convex segmentation of polyhedra through convex ridge
// separation", Computer-Aided Design 78 (2016) 137-146.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/context.hpp"
#include "base/id.hpp"
#include "mesh/model/surface.hpp"

namespace ridgecraft::segment {

/// How the paper is read where it leaves a choice. All but `b` are for research: with effort 1, without
/// planes and pockets.
enum class Reading {
  literal,  ///< to the letter: every opening that a cut leaves is as concave as it is wide
  a,        ///< valleys run straight across such openings
  b         ///< and a vertex is no deeper than the hull is far from it; parts that can be one are joined
};

struct Options {
  /// Largest concavity of a part, as a length in the scale where the model's smallest enclosing ball has
  /// radius 1. Finite and above 0, else Error(usage).
  double concavity = 0.1;
  /// 1: one pass. 2: also parts cut into smaller pieces that are put together anew, and the cheapest of both
  /// in number of parts, volume and borders; about four times as long. 3: still smaller pieces and more
  /// trials, too; about 25 times as long.
  int effort = 1;
  /// Parts that one would give for a volume ratio (volume of the union of the parts' hulls over the volume
  /// that the surface encloses) less by 1. 0: fewest parts whatever their hulls. None: 0 for effort 1
  /// without planes, else 5. At least 0, else Error(usage).
  std::optional<double> volume_weight = std::nullopt;
  /// Cut by planes, too, where that saves more volume than the pieces are worth: cups become sectors.
  bool planes = false;
  /// No part's hull has a pocket: a point outside the solid that lies deeper under it than `concavity`. Takes
  /// a surface without border edges, else Error(unusable_mesh). Cups become sectors.
  bool pockets = false;
  enum class Holes {
    automatic,  ///< `close` where the surface looks damaged (virtual_facets.hpp), else `keep`
    keep,       ///< holes are borders
    close       ///< small holes are closed while segmenting, and crumbs join the part that they touch
  };
  Holes holes = Holes::automatic;
  enum class Components {
    apart,  ///< each component for itself
    tied    ///< all together as one object: parts may hold faces of several components
  };
  Components components = Components::apart;
  Reading reading = Reading::b;
};

/// The weight that counts: the one that was asked for, else that of the effort and of planes.
[[nodiscard]] double volume_weight(const Options& options);

/// Why a part is a part of its own.
enum class PartReason {
  component,  ///< a whole connected component
  ridge,      ///< a cut separated its convex ridge from others, or a plane, or a finer cut
  split,      ///< the fallback split (no cut made two pieces)
  merged,     ///< several were joined
};

/// One word for machines: "component", "ridge", ...
[[nodiscard]] std::string_view name(PartReason reason);

struct Part {
  std::vector<FaceId> faces;  ///< ascending
  /// Largest concavity over the part's bridges, measured from scratch, in the scale of Options::concavity. It
  /// depends on that tolerance a little, since openings within it count as ways out (docs/segmentation.md).
  double concavity = 0.0;
  std::vector<VertexId> hull_vertices;  ///< ascending
  double hull_volume = 0.0;             ///< in the surface's own unit, cubed
  PartReason reason = PartReason::component;
};

struct Segmentation {
  IdVector<FaceId, PartId> part;  ///< of each face; numbered by their smallest face
  IdVector<PartId, Part> parts;

  /// Greatest concavity of a part; 0 when there is none.
  [[nodiscard]] double max_concavity() const;
};

/// Segments each component of a surface by itself (or tied, all as one) until every part's concavity is at
/// most the tolerance. `polygon` gives each face the polygon that it belongs to (faces of one polygon stay in
/// one part); empty when every face is its own. The result doesn't depend on the number of threads. Throws
/// Error(usage) and Error(interrupted).
[[nodiscard]] Segmentation segment(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                   const Options& options, const Context& context);

}  // namespace ridgecraft::segment
