// SPDX-License-Identifier: GPL-3.0-or-later
// What a cut along an edge costs: concave and short edges are cheap (docs/design/segmentation.md,
// "Price of an edge").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/parts/rules.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace ridgecraft::segment {

/// Why it is cheap to cut along an edge; a byte, as millions of faces have three sides each.
enum class EdgeKind : std::uint8_t {
  rim,              ///< of the surface
  smooth,           ///< no reason
  hollow,           ///< concave
  drawn,            ///< the artist drew a border
  drawn_in_hollow,  ///< both
};

/// Per side, 3 f + k, of both facets of an edge alike; 0 at rims.
class EdgeWeights {
 public:
  /// As weigh_edges().
  EdgeWeights(const ScaledSurface& surface, const Rules& rules, std::span<const std::uint32_t> label);

  /// Theta: small on concave edges, 1 elsewhere.
  [[nodiscard]] double smoothness(std::size_t side) const {
    constexpr double in_hollow = 0.3;
    // Where the artist drew a border, a cut is as cheap as in a hollow, and in a hollow cheaper still.
    constexpr double on_border = 0.3;
    constexpr std::array theta{0.0, 1.0, in_hollow, on_border, in_hollow * on_border};
    return theta[static_cast<std::size_t>(kind_[side])];
  }
  /// w(e) in steps of 2^-20, at least 1: flows are exact in integers. Worked out where it is asked for, since
  /// it would be most of what is kept.
  [[nodiscard]] std::int64_t capacity(std::size_t side) const;

 private:
  const ScaledSurface* surface_;
  bool folds_by_length_;
  std::vector<EdgeKind> kind_;
  double mean_length_ = 1.0;
  double mean_smoothness_ = 1.0;
};

/// The surface must outlive it. `label`, as in segment(): edges between faces of different labels are cheap,
/// too. O(n).
[[nodiscard]] EdgeWeights weigh_edges(const ScaledSurface& surface, const Rules& rules = {},
                                      std::span<const std::uint32_t> label = {});

}  // namespace ridgecraft::segment
