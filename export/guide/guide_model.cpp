// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/guide_model.hpp"

#include <numbers>

namespace ridgecraft::paper {

const std::array<Viewpoint, 8>& guide_sides() {
  constexpr double degree = std::numbers::pi / 180.0;
  static constexpr std::array<Viewpoint, 8> sides{
      {{35.0 * degree, 22.0 * degree, "as on the first page"},
       {125.0 * degree, 22.0 * degree, "a quarter turn on"},
       {215.0 * degree, 22.0 * degree, "half a turn on"},
       {305.0 * degree, 22.0 * degree, "three quarters of a turn on"},
       {35.0 * degree, -28.0 * degree, "as on the first page, but from below"},
       {125.0 * degree, -28.0 * degree, "a quarter turn on, from below"},
       {215.0 * degree, -28.0 * degree, "half a turn on, from below"},
       {305.0 * degree, -28.0 * degree, "three quarters of a turn on, from below"}}};
  return sides;
}

}  // namespace ridgecraft::paper
