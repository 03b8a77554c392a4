// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets bent along parallel lines: whether they fold is a question of the plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/folding/fold_order.hpp"

namespace ridgecraft::test {

/// Looks at each motion.
inline constexpr int samples = unfold::samples_of_motion;

/// A sheet that is bent along parallel lines: its profile, pulled along z.
[[nodiscard]] mesh::Surface bent_sheet(const std::vector<Vec2>& profile, double width);

/// Whether the profile with each joint turned by its share of what it is turned by crosses itself, its
/// stretches shortened at both ends.
[[nodiscard]] bool crosses(const std::vector<Vec2>& profile, const std::vector<double>& share,
                           double shortened);

/// Stretches of 10 to 70 mm at sharp and blunt angles; where it would cross itself it stops.
[[nodiscard]] std::vector<Vec2> random_profile(Random& random);

/// Two hooks that hold each other, bent a little; straight where that would make them cross.
[[nodiscard]] std::vector<Vec2> random_hooks(Random& random);

/// Seven stretches that wind inwards, outwards or to and fro.
[[nodiscard]] std::vector<Vec2> random_spiral(Random& random);

[[nodiscard]] bool crosses_together(const std::vector<Vec2>& profile, double shortened);

[[nodiscard]] bool crosses_in_order(const std::vector<Vec2>& profile, const std::vector<std::size_t>& joints,
                                    double shortened);

/// Whether some order of the joints folds the profile up: all are tried.
[[nodiscard]] bool any_order_works(const std::vector<Vec2>& profile, double shortened);

/// The joints of a bent sheet in the order in which its creases are folded.
[[nodiscard]] std::vector<std::size_t> joints_of(const mesh::Surface& sheet,
                                                 const unfold::FoldOrder& folding);

}  // namespace ridgecraft::test
