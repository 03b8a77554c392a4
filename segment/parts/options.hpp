// SPDX-License-Identifier: GPL-3.0-or-later
// What segment() may be asked for.
#pragma once

#include <optional>

namespace ridgecraft::segment {

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
  /// 1: one pass. 2: also parts cut into smaller pieces that are put together anew, and the cheapest of both
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
    keep,  ///< holes are borders
    close  ///< small holes are closed while segmenting, and crumbs join the part that they touch
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

}  // namespace ridgecraft::segment
