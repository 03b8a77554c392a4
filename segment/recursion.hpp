// SPDX-License-Identifier: GPL-3.0-or-later
// How a run of segment() went on its way: for tests that are to reach its limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "segment/segment.hpp"

namespace ridgecraft::segment {

struct Recursion {
  int depth = 0;             ///< cuts that the most divided part came from
  std::size_t splits = 0;    ///< times that no cut made two pieces: facets went to the nearer end
  std::size_t halvings = 0;  ///< times that a part was halved because cutting it had gone on too long
};

/// segment(), telling how it went.
[[nodiscard]] Segmentation segment(const mesh::Surface& surface, std::span<const std::uint32_t> polygon,
                                   const Options& options, const Context& context, Recursion& recursion);

}  // namespace ridgecraft::segment
