// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/guide_model.hpp"

#include <numbers>

namespace ridgecraft::paper {

const std::array<Side, 8>& guide_sides() {
  constexpr double degree = std::numbers::pi / 180.0;
  static constexpr std::array<Side, 8> sides{
      {{35.0 * degree, 22.0 * degree, "from the front"},
       {-55.0 * degree, 22.0 * degree, "from the front, other side"},
       {125.0 * degree, 22.0 * degree, "from behind"},
       {-145.0 * degree, 22.0 * degree, "from behind, other side"},
       {35.0 * degree, -28.0 * degree, "from the front, below"},
       {-55.0 * degree, -28.0 * degree, "from the front, other side, below"},
       {125.0 * degree, -28.0 * degree, "from behind, below"},
       {-145.0 * degree, -28.0 * degree, "from behind, other side, below"}}};
  return sides;
}

}  // namespace ridgecraft::paper
