// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles that run through each other are divided where they meet, exactly, and it is found out which
// bodies lie on either side of what results. Keeps CGAL out of headers. Private to prepare/.
#pragma once

#include <cstddef>
#include <optional>

#include "base/context.hpp"
#include "prepare/skin/facets.hpp"

namespace ridgecraft::prepare {

/// Divides all triangles of solids where they meet others of solids, and those of sheets where they meet
/// solids. Points are exact until the end (CGAL's lazy exact numbers), so nothing is missed and nothing
/// fails. None where more than `most_pairs` pairs of triangles meet: that would take too long. O(n log n) for
/// n triangles, and some 20 microseconds a pair that meets.
[[nodiscard]] std::optional<Arrangement> arrange(const BodySoup& soup, std::size_t most_pairs,
                                                 const Context& context);

}  // namespace ridgecraft::prepare
