// SPDX-License-Identifier: GPL-3.0-or-later
// What every packing has to keep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "export/packing/packing_shape.hpp"

namespace ridgecraft::test {

/// Where a point of a shape comes to lie.
using PackedPoint = std::function<Vec2(std::uint32_t shape, Vec2 point)>;

/// Corners off the page and pairs of shapes that are nearer to each other than the gap. All lie on `pages`
/// pages, each on the one that `page_of` says.
[[nodiscard]] std::size_t packing_faults(const export_::PackingTask& task, std::uint32_t pages,
                                         const std::function<std::uint32_t(std::uint32_t shape)>& page_of,
                                         const PackedPoint& placed);

}  // namespace ridgecraft::test
