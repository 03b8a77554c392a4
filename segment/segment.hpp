// SPDX-License-Identifier: GPL-3.0-or-later
// CoRiSe: a surface becomes nearly convex parts. Read this header first; docs/design/segmentation.md has the
// method.
//
// Source: G. Liu, Z. Xi, J.-M. Lien, "Nearly convex segmentation of polyhedra through convex ridge
// separation", Computer-Aided Design 78 (2016) 137-146.
#pragma once

#include <cstdint>
#include <span>

#include "base/context.hpp"
#include "mesh/model/surface.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::segment {

/// Segments each component of a surface by itself (or tied, all as one) until every part's concavity is at
/// most the tolerance. `polygon` gives each face the polygon that it belongs to (faces of one polygon stay in
/// one part); empty when every face is its own. `label` says what each face belongs to by the will of
/// whoever made the model, an object or a material; empty for none: cuts along borders between labels cost
/// less, so they are made there rather than next to them, but nothing is cut because of them. The result
/// doesn't depend on the number of threads. It depends on the seed with effort 2 and 3 alone, whose trials
/// are random. Throws Error(usage), Error(unusable_mesh) where pockets are asked for, and Error(interrupted).
[[nodiscard]] Segmentation segment(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                   const Options& options, const Context& context,
                                   std::span<const std::uint32_t> label = {});

/// The same for a surface that is given away: it is emptied as soon as nothing is read from it any more. Of
/// millions of faces that is a fifth of the memory.
[[nodiscard]] Segmentation segment(mesh::Surface&& surface, std::span<const std::uint32_t> polygon,
                                   const Options& options, const Context& context,
                                   std::span<const std::uint32_t> label = {});

/// Radius of the smallest ball around a surface, in its unit: concavity 1. O(n).
[[nodiscard]] double scale_of(const mesh::Surface& surface);

}  // namespace ridgecraft::segment
