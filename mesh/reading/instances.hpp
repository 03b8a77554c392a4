// SPDX-License-Identifier: GPL-3.0-or-later
// Formats in which a file may say once what it has many times: a few lines could make more faces than any
// memory holds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

/// So many triangles may come from repetitions alone; no paper model is near it.
inline constexpr std::uint64_t largest_repeated_count = 2'000'000;

/// Refuses a file whose objects, repeated, have more points or corners than its bytes could hold, and than
/// largest_repeated_count triangles have. `held` are the bytes, unpacked; `points` and `corners` what the
/// soup would have.
void check_repetitions(const Source& source, std::uint64_t held, std::uint64_t points, std::uint64_t corners);

/// Appends a triangle: indices into the points of the soup, and into its texture points where it has some.
void add_triangle(Soup& soup, std::array<std::uint32_t, 3> points,
                  const std::optional<std::array<std::uint32_t, 3>>& texture);

/// What a soup of triangles and names lacks at the end: texture corners of the last faces; names, where none
/// says anything, go.
void finish_triangles(Soup& soup);

}  // namespace ridgecraft::mesh
