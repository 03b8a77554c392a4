// SPDX-License-Identifier: GPL-3.0-or-later
// What concavity is left in the two halves when a valley is cut at a vertex (docs/design/segmentation.md,
// "Separators").
#pragma once

#include <span>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::segment {

/// prefix[k] = concavity of chain[0..k] under its own new bridges, the hull of the chain on the bridge's
/// side. Chain as project_valley makes it. O(n^2) at worst, nearly linear on real valleys.
void prefix_concavity(std::span<const Vec2> chain, std::vector<double>& prefix);

/// The same of the reversed chain: suffix[k] = concavity of chain[k..n-1].
void suffix_concavity(std::span<const Vec2> chain, std::vector<double>& suffix);

}  // namespace ridgecraft::segment
