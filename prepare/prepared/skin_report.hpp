// SPDX-License-Identifier: GPL-3.0-or-later
// What became of bodies that touch or run into each other.
#pragma once

#include <cstddef>

namespace ridgecraft::prepare {

/// Whether they become one skin.
enum class Bodies { unite, keep };

/// For the summary. Components are those of the surface, faces its triangles.
struct SkinReport {
  std::size_t united = 0;         ///< components that took part
  std::size_t united_into = 0;    ///< components that became of them
  std::size_t faces_hidden = 0;   ///< faces that nothing is left of: they lay inside others
  double hidden_share = 0.0;      ///< of the area of these components: how much lay inside others
  std::size_t left_crossing = 0;  ///< components that stay as they were, since no sound skin was found
  std::size_t gaps_closed = 0;    ///< corners that ended just before another body, and touch it now
  std::size_t unseen = 0;         ///< components that were left out, since nobody sees any of them
  std::size_t rims_closed = 0;    ///< flat openings that were closed for it and stay closed
};

}  // namespace ridgecraft::prepare
