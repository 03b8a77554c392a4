// SPDX-License-Identifier: GPL-3.0-or-later
// The model that nets are held against, as whoever read it hands it over.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

/// The surface that the nets are said to be of, in its own unit.
struct ModelSurface {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< indices into points
  double units_per_point_unit = 1.0;                ///< a point times this is in the unit of the model's file
  std::string digest;                               ///< hash of the file's bytes, or empty
};

}  // namespace ridgecraft::verify
