// SPDX-License-Identifier: GPL-3.0-or-later
// Walls that go round stay strips.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/model/surface.hpp"
#include "prepare/prepared/panels.hpp"
#include "unfold/net/edge_wishes.hpp"
#include "unfold/net/piece_rules.hpp"

namespace ridgecraft::unfold {

/// What is wished for, and EdgeWish::band for the rungs of each band of the surface (energy/bands.hpp) that
/// is wide: by Weights::bands at least 1.1 times as wide as its regions are long on average. A narrower one
/// may as well hang on a disk in single flaps. Of a band that goes all the way round one rung stays free,
/// its seam: as near to the mirror plane as any lies, mirrored where bands are mirrored. Bands with a rung
/// that somebody has a wish for, or where labels (per face, or empty) meet, are left as they are. Nothing
/// is added where Weights::bands is 0. O(n log n).
[[nodiscard]] EdgeWishes with_bands_kept(const mesh::Surface& surface, const prepare::Panels& panels,
                                         std::span<const std::uint32_t> labels, const EdgeWishes& wishes,
                                         const Weights& weights);

}  // namespace ridgecraft::unfold
